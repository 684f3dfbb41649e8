# SPDX-License-Identifier: GPL-3.0-or-later
"""packing-layers, bad input: exit code 2 (or 3), one line that names the option, nothing
written."""
from cli import BAD_INPUT, SYSTEM, Folder, main, refuses

SMALL = ["--domain", "rect:0.3,0.2", "--psd", "mono:0.02"]
EXAMPLE = ["--example", "5.1"]


def option(*arguments, words, start=SMALL, name=None):
    return (name or " ".join(arguments), refuses([*start, *arguments], words))


def domain(spec, *words):
    return ("domain " + spec,
            refuses(["--domain", spec, "--psd", "mono:0.02"], ["--domain", *words]))


def output(name, *arguments, words, code=BAD_INPUT):
    return (name, refuses([*SMALL, *arguments], words, code, out=False))


def real(name, *bad):
    """Each bad value is refused with the name of the option."""
    return [option(name, value, words=[name, value.lstrip("+")]) for value in (*bad, "nan", "x")]


TESTS = [
    ("nothing asked", refuses([], ["--domain", "--example", "missing"])),
    ("no sizes", refuses(SMALL[:2], ["--psd", "missing"])),
    ("no container", refuses(SMALL[2:], ["--domain", "missing"])),
    option("--example", "5.5", words=["--example", "'5.5'", "5.4"]),
    option("--dim", "4", words=["--dim"]),
    option("--dim", "3", words=["--dim", "rect"]),
    domain("rect:1,1+periodic", "+periodic", "floor"),
    domain("box:1,1,1+periodic:xyz", "+periodic", "floor"),
    domain("cylinder:1,2,axis=x+open:top", "+open", "fall out"),
    domain("sphere:1+open:top", "+open", "sphere"),
    domain("box:1,1", "LZ is missing"),
    ("psd", refuses([*SMALL[:2], "--psd", "mono:0"], ["--psd"])),
    ("particles larger than the container",
     refuses(["--domain", "rect:0.3,2", "--psd", "mono:0.2"], ["--psd", "0.2"])),
    ("height of a sphere",
     refuses(["--domain", "sphere:1", "--psd", "mono:0.1", "--height", "1"],
             ["--height", "sphere"])),
    option("--layer-height", "0.039", words=["--layer-height", "0.039", "0.04"]),
    option("--layer-density", "1", words=["--layer-density"]),
    option("--layer-density", "0", words=["--layer-density"]),
    *real("--height", "0", "-1"),
    *real("--layer-height", "0", "-1"),
    *real("--layer-time", "0", "-1"),
    *real("--layer-time-max", "0", "-1"),
    *real("--rest-tolerance", "0", "-1"),
    *real("--friction", "-0.1"),
    *real("--slip-velocity", "0", "-1"),
    *real("--young", "0", "-1"),
    *real("--poisson", "-1", "0.51"),
    *real("--density", "0", "-1"),
    *real("--damping", "-0.1"),
    *real("--drag", "-1"),
    *real("--dt", "0", "-1"),
    option("--layer-time", "2", "--layer-time-max", "1", words=["--layer-time-max"]),
    option("--rotations", "maybe", words=["--rotations", "'maybe'", "on"]),
    option("--pull", "1", words=["--pull", "'1'"]),
    option("--disc-mass", "yes", words=["--disc-mass", "'yes'"]),
    ("disc mass of spheres",
     refuses(["--domain", "box:1,1,1", "--psd", "mono:0.1", "--disc-mass", "on"],
             ["--disc-mass"])),
    option("--arm", "long", words=["--arm", "'long'", "contact", "radius"]),
    option("--walls", "soft", words=["--walls", "'soft'", "rigid", "material"]),
    option("--layer-height", "0.04", words=["--layer-height", "diameter", "0.04"]),
    option("--gravity", "1e308", words=["--gravity"]),
    option("--young", "1e308", words=["--young"]),
    option("--slip-velocity", "1e308", words=["--slip-velocity"]),
    option("--dt", "1e-12", words=["--dt", "steps"]),
    ("more particles than can be", refuses(["--domain", "box:1e6,1e6,1e6", "--psd", "mono:1"],
                                           ["--psd", "particles"])),
    ("a layer beyond all memory",
     refuses(["--domain", "box:0.4,0.4,0.2", "--psd", "mono:0.04", "--layer-height", "1e300"],
             ["memory"], SYSTEM)),
    ("gravity along a period",
     refuses(["--domain", "rect:0.3,0.2+periodic:x", "--psd", "mono:0.02", "--gravity",
              "0.3,-2"], ["--gravity", "periodic"])),
    ("a pack that blows up",
     refuses(["--domain", "box:0.3,0.3,0.15", "--psd", "mono:0.03", "--friction", "5",
              "--threads", "1"], ["--dt", "no longer finite after step", "--slip-velocity"])),
    option("--layer-start", "floor", words=["--layer-start", "'floor'", "highest", "bed"]),
    option("--full", "half", words=["--full", "'half'", "bed", "highest"]),
    option("--layer-end", "never", words=["--layer-end", "'never'", "rest", "time"]),
    option("--gravity", "0", words=["--gravity"]),
    option("--gravity", "-2", words=["--gravity"]),
    option("--gravity", "0,2", words=["--gravity", "downwards"]),
    option("--gravity", "1,0", words=["--gravity", "downwards"]),
    option("--gravity", "0,0,-2", words=["--gravity", "GX,GY"]),
    option("--gravity", "0,-x", words=["--gravity", "'-x'"]),
    option("--near-field", "1,2,3,4", words=["--near-field", "CUTOFF"]),
    option("--near-field", "1,2,3,4,0", words=["--near-field", "cutoff"]),
    option("--near-field", "1,2,3,4,nan", words=["--near-field", "'nan'"]),
    option("--packs", "0", words=["--packs"]),
    option("--packs", "1001", words=["--packs"]),
    option("--sets", "1.5", words=["--sets"]),
    option("--max-layers", "0", words=["--max-layers"]),
    option("--stream", "4503599627370496", words=["--stream"]),
    option("--count", "5", words=["--count"]),
    option("loose", words=["'loose'"]),
    option("--dt", "0.1", words=["--dt", "advised"], start=EXAMPLE),
    ("periodic and narrower than two particles",
     refuses(["--domain", "rect:0.05,0.3+periodic:x", "--psd", "mono:0.02"],
             ["--domain", "periodic"])),
    output("unknown extension", "--out", "pack.doc", words=["--out", "'pack.doc'"]),
    output("unknown extension of the sheet", "--sheet", "a.pdf", words=["--sheet", "a.pdf"]),
    output("two sheets", "--sheet", "a.png", "--sheet", "b.png",
           words=["--sheet", "twice"]),
    output("sheet over a pack", "--packs", "2", "--out", "a.png", "--sheet", "a-2.png",
           words=["a-2.png", "twice"]),
    output("device for two packs", "--packs", "2", "--out", "csv:/dev/null",
           words=["--out", "/dev/null", "2 packs"]),
    output("folder that is not there", "--out", "no/pack.csv",
           words=["--out", "no/pack.csv"], code=SYSTEM),
    output("disk full", "--max-layers", "1", "--out", "pack.vtp", "--out", "csv:/dev/full",
           "--layer-end", "time", "--layer-time", "0.001", words=["--out", "/dev/full"],
           code=SYSTEM),
]
main(TESTS)
