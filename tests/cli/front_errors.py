# SPDX-License-Identifier: GPL-3.0-or-later
"""packing-front, bad input: exit code 2 (or 3), one line that names the option, nothing
written."""
from cli import BAD_INPUT, SYSTEM, main, refuses

BOX = ["--domain", "box:8,8,8"]
SMALL = [*BOX, "--psd", "mono:1"]
PAPER = [*SMALL, "--mode", "paper"]
STANDING = ("p.csv", "x,y,z,r\n2,2,2,1\n")


def option(*arguments, words, start=SMALL, name=None):
    return (name or " ".join(arguments), refuses([*start, *arguments], words))


def domain(spec, *words):
    return ("domain " + spec,
            refuses(["--domain", spec, "--psd", "mono:0.5"], ["--domain", *words]))


def output(name, *arguments, words, code=BAD_INPUT):
    return (name, refuses([*SMALL, *arguments], words, code, out=False))


def listed(name, text, *words):
    return ("list " + name, refuses([*BOX, "--list", "l.csv"], ["--list: l.csv", *words],
                                    files=[("l.csv", text)]))


def standing(name, *arguments, words, text=STANDING[1], start=SMALL):
    return (name, refuses([*start, "--in", "p.csv", *arguments], words,
                          files=[("p.csv", text)]))


def without_settling(*arguments):
    return option(*arguments, words=[arguments[0], "--settle"])


TESTS = [
    ("nothing asked", refuses([], ["--psd", "--list", "missing"])),
    ("no container", refuses(["--psd", "mono:1"], ["--domain", "missing"])),
    ("no sizes", refuses(BOX, ["--psd", "missing"])),
    ("psd", refuses([*BOX, "--psd", "mono:0"], ["--psd"])),
    ("particles larger than the container", refuses([*BOX, "--psd", "mono:5"], ["5"])),
    domain("box:8,8", "LZ is missing"),
    domain("box:8,8,0", "size"),
    domain("cylinder:5,10+periodic", "+periodic"),
    option("--mode", "slow", words=["--mode", "'slow'", "dense", "fast", "paper"]),
    option("--direction", "up", words=["--direction", "'up'", "outward", "inward"]),
    option("--contact", "glue", words=["--contact", "'glue'", "wrappers", "direct"],
           start=PAPER),
    option("--contact", "direct", words=["--contact", "dense", "paper"]),
    option("--mode", "fast", "--contact", "direct", words=["--contact", "fast", "paper"]),
    option("--select", "last", words=["--select", "'last'", "random", "fifo", "lifo"],
           start=PAPER),
    option("--select", "fifo,", words=["--select", "''"], start=PAPER),
    option("--select", "fifo,lifo,fifo", words=["--select", "two"], start=PAPER),
    option("--select", "fifo", words=["--select", "dense", "paper"]),
    option("--stock", "9", words=["--stock", "paper"], start=PAPER),
    option("--stock", "0", words=["--stock"]),
    option("--stock", "4097", words=["--stock", "4096"]),
    option("--count", "0", words=["--count"]),
    option("--count", "-3", words=["--count"]),
    option("--count", "3", "--mass", "4", words=["--count", "--mass", "only one"]),
    option("--target-porosity", "0", words=["--target-porosity"]),
    option("--target-porosity", "1", words=["--target-porosity"]),
    option("--target-porosity", "nan", words=["--target-porosity"]),
    option("--mass", "1e9", words=["--mass", "512"]),
    option("--loosen", "melt", words=["--loosen", "'melt'", "shrink", "remove"]),
    option("--loosen", "shrink", words=["--loosen", "--target-porosity"]),
    option("--settle", "compression", words=["--settle", "walls that move"]),
    option("--settle", "hope", words=["--settle", "'hope'", "gravity"]),
    without_settling("--gravity", "9"),
    without_settling("--friction", "0.3"),
    without_settling("--settle-time", "3"),
    without_settling("--rest-tolerance", "1e-3"),
    option("--settle", "gravity", "--gravity", "1,0,0", words=["--gravity", "downwards"]),
    option("--settle", "gravity", "--friction", "-1", words=["--friction"]),
    option("--settle", "gravity", "--settle-time", "0", words=["--settle-time"]),
    option("--settle", "gravity", "--dt", "1e-12", "--count", "5", words=["--dt", "steps"]),
    ("settling without a floor",
     refuses(["--domain", "box:8,8,8+periodic", "--psd", "mono:1", "--settle", "gravity"],
             ["--gravity", "periodic"])),
    option("--grade", "mono:1", words=["--grade", "SIZES@CONTAINER"]),
    option("--grade", "@box:1,1,1", words=["--grade", "SIZES@CONTAINER"]),
    option("--grade", "mono:1@", words=["--grade", "SIZES@CONTAINER"]),
    option("--grade", "mono:1@ball:3", words=["--grade", "'ball'"]),
    option("--grade", "mono:-1@box:3,3,3", words=["--psd"]),
    option("--grade", "mono:1@rect:3,3", words=["--grade", "dimensions"]),
    ("grade beside a list",
     refuses([*BOX, "--list", "l.csv", "--grade", "mono:1@box:3,3,3"], ["--list", "--grade"],
             files=[("l.csv", "radius,count\n1,2\n")])),
    ("list beside sizes", refuses([*SMALL, "--list", "l.csv"], ["--list", "--psd"])),
    ("count beside a list", refuses([*BOX, "--list", "l.csv", "--count", "3"],
                                    ["--list", "--count"])),
    ("mass beside a list", refuses([*BOX, "--list", "l.csv", "--mass", "3"],
                                   ["--list", "--mass"])),
    ("two lists", refuses([*BOX, "--list", "a.csv", "--list", "b.csv"], ["--list", "twice"])),
    ("list that is not there", refuses([*BOX, "--list", "none.csv"],
                                       ["--list", "none.csv"], SYSTEM)),
    listed("empty", "", "no particles"),
    listed("with a header only", "radius,count\n", "no particles"),
    listed("without a header", "1,2\n", "line 1", "'1'"),
    listed("with a column too many", "radius,count,mass\n1,2,3\n", "line 1", "3 columns"),
    listed("of radii alone", "radius,diameter\n1,2\n", "line 1", "count"),
    listed("of unknown columns", "radius,number\n1,2\n", "line 1", "'number'"),
    listed("with a field too few", "radius,count\n\n1\n", "line 3"),
    listed("with a word", "radius,count\n1,two\n", "line 2", "'two'"),
    listed("with half a particle", "radius,count\n1,2.5\n", "line 2", "'2.5'"),
    listed("with none", "radius,count\n1,0\n", "line 2", "0"),
    listed("with a negative radius", "radius,count\n-1,3\n", "line 2", "above 0"),
    listed("with NaN", "diameter,count\nnan,3\n", "line 2", "'nan'"),
    listed("with too little mass", "# grains\nradius,mass\n1,3\n", "line 3", "half a particle"),
    listed("with too much mass", "radius,mass\n1e-9,1e9\n", "line 2", "more than can be"),
    standing("particles that leave too little", "--target-porosity", "0.999",
             words=["--target-porosity", "--in"]),
    standing("loosening around particles", "--loosen", "shrink", "--target-porosity", "0.9",
             words=["--loosen", "--in"]),
    standing("a pack that tells no container", words=["--domain", "p.csv"],
             start=["--psd", "mono:1"]),
    standing("a broken pack", words=["--in", "p.csv", "line 2"], text="x,y,z,r\n1,1\n"),
    standing("a pack in space for a flat container", words=["--domain", "flat"],
             start=["--domain", "rect:8,8", "--psd", "mono:1"]),
    ("a pack that is not there", refuses([*SMALL, "--in", "none.csv"],
                                         ["--in", "none.csv"], SYSTEM)),
    option("loose", words=["'loose'"]),
    output("frames without a picture", "--frames", "grow.csv", words=["--frames", "grow.csv"]),
    output("frames in no number", "--frames", "0:grow.png", words=["--frames", "0"]),
    output("too many frames", "--frames", "65:grow.png", words=["--frames", "65", "64"]),
    output("frames twice", "--frames", "a.png", "--frames", "b.png",
           words=["--frames", "twice"]),
    output("frames over the pack", "--frames", "a.png", "--out", "a.png",
           words=["a.png", "twice"]),
    output("unknown extension", "--out", "pack.doc", words=["--out", "'pack.doc'"]),
    output("folder that is not there", "--frames", "no/grow.png",
           words=["--frames", "no/grow.png"], code=SYSTEM),
    output("disk full", "--count", "5", "--out", "pack.vtp", "--out", "csv:/dev/full",
           words=["--out", "/dev/full"], code=SYSTEM),
]
main(TESTS)
