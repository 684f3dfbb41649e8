# SPDX-License-Identifier: GPL-3.0-or-later
"""Bad input: exit code 2 (or 3), one line that names the option or field, nothing written."""
import os
import subprocess
from cli import BAD_INPUT, SYSTEM, Folder, equal, main, refuses

BOX = ["--domain", "box:10,10,10"]
SMALL = ["--psd", "mono:0.5", "--count", "10"]
CURVE = "diameter,percent_passing\n"


def domain(spec, *words):
    return ("domain " + spec, refuses(["--domain", spec, *SMALL], ["--domain", *words]))


def sizes(spec, *words, files=(), name=None):
    return ("psd " + (name or spec),
            refuses([*BOX, "--psd", spec, "--count", "5"], ["--psd", *words], files=files))


def option(*arguments, words, name=None):
    return (name or " ".join(arguments), refuses([*BOX, *SMALL, *arguments], words))


def curve(name, text, *words):
    return sizes("curve:c.csv", "c.csv", *words, files=[("c.csv", text)],
                 name="curve " + name)


def output(name, *arguments, words, code=BAD_INPUT, files=()):
    return (name, refuses([*BOX, *SMALL, *arguments], words, code, files, out=False))


TESTS = [
    ("no domain", refuses(SMALL, ["--domain", "missing"])),
    ("no psd", refuses(BOX, ["--psd", "missing"])),
    domain("", "unknown container ''", "cylinder"),
    domain("ball:1", "unknown container 'ball'", "sphere", "silo"),
    domain("torus:1,2", "unknown container 'torus'", "box"),
    domain("box", "LX is missing"),
    domain("box:", "LX is missing"),
    domain("box:1,2", "LZ is missing"),
    domain("box:1,,3", "LY", "a number is missing"),
    domain("box:1,2,3,4", "'4'", "too many"),
    domain("box:1,2,3x", "LZ", "'3x' is not a number"),
    domain("box: 1,2,3", "LX", "' 1' is not a number"),
    domain("box:nan,1,1", "LX", "'nan' is not a number"),
    domain("box:inf,1,1", "LX", "'inf' is not a number"),
    domain("box:0x10,1,1", "LX", "'0x10' is not a number"),
    domain("box:1e999,1,1", "LX", "'1e999' is too large"),
    domain("box:1;5,1,1", "LX", "'1;5' is not a number"),
    domain("box:-10,10,10", "size"),
    domain("box:0,10,10", "size"),
    domain("rect:10,-1", "size_y"),
    domain("cylinder:-5,10", "radius"),
    domain("cylinder:5,0", "height"),
    domain("cylinder:5", "H is missing"),
    domain("tube:5,4,10", "radius"),
    domain("cone:0,0,10", "radius"),
    domain("silo:5,10,1,20", "height"),
    domain("annulus:5,4", "radius"),
    domain("box:1,1,1,axis=x", "axis", "box"),
    domain("cylinder:5,10,axis=w", "axis", "'w' is not x, y or z"),
    domain("cylinder:5,10+periodic", "+periodic", "cylinder"),
    domain("box:9,9,9+periodic:xa", "+periodic", "'xa'"),
    domain("box:9,9,9+periodic:", "+periodic"),
    domain("rect:9,9+periodic:z", "+periodic", "'z'"),
    domain("box:9,9,9+open:side", "+open", "'side' is not top"),
    domain("box:9,9,9+open", "+open"),
    domain("sphere:9+open:top", "+open", "sphere"),
    domain("box:9,9,9+periodic+open:top", "open_top"),
    domain("box:9,9,9+at:1,2", "+at", "X,Y,Z"),
    domain("box:9,9,9+at:1,2,z", "+at", "'z' is not a number"),
    domain("rect:9,9+at:1,2,3", "+at", "Z"),
    domain("box:9,9,9+scale:0", "+scale", "above 0"),
    domain("box:9,9,9+scale:-2", "+scale", "above 0"),
    domain("box:9,9,9+turn:2", "unknown modifier '+turn'"),
    sizes("", "unknown size distribution ''", "lognormal"),
    sizes("dirac:1", "unknown size distribution 'dirac'", "mono"),
    sizes("mono", "mono", "R is missing"),
    sizes("mono:", "mono", "R is missing"),
    sizes("mono:0.5,1", "mono", "'1' is one field too many"),
    sizes("mono:-0.5", "r"),
    sizes("mono:0", "r"),
    sizes("mono:nan", "R", "'nan' is not a number"),
    sizes("uniform:0.5", "MAX is missing"),
    sizes("uniform:0.5,0.1", "max_r"),
    sizes("normal:0.5,-1,0.1,1", "sd_r"),
    sizes("lognormal:0.5,0,0.1,1", "sigma"),
    sizes("weibull:0.5,0,0.1,1", "shape"),
    sizes("gamma:0,2,0.1,1", "scale_r"),
    sizes("exponential:0.5,0,1", "min_r"),
    sizes("discrete:0.5", "'0.5' is not RADIUS=SHARE"),
    sizes("discrete:0.5=", "share", "a number is missing"),
    sizes("discrete:0.5=1,0.4=1", "r"),
    sizes("discrete:0.5=-1", "share"),
    sizes("mono:0.5,by=volume", "by", "'volume' is not mass or number"),
    sizes("0*mono:0.5+0.5*mono:0.2", "share", "above 0"),
    sizes("0.5*mono:0.5+0.5*", "unknown size distribution ''"),
    sizes("curve:", "FILE is missing"),
    ("curve that is not there",
     refuses([*BOX, "--psd", "curve:none.csv"], ["--psd", "none.csv"], SYSTEM)),
    curve("empty", ""),
    curve("without rows", CURVE),
    curve("truncated", CURVE + "0.1,0\n0.2,50\n0.3,80\n", "line 4"),
    curve("descending in passing", CURVE + "0.1,0\n0.2,50\n0.3,40\n0.4,100\n", "line 4"),
    curve("descending in diameter", CURVE + "0.1,0\n0.3,50\n0.2,100\n", "line 4"),
    curve("not from 0", CURVE + "0.1,10\n0.2,100\n", "line 2"),
    curve("with a word", CURVE + "# sieve\n0.1,0\n0.2,half\n0.3,100\n", "line 4"),
    curve("with a field too many", CURVE + "0.1,0,7\n0.2,100\n", "line 2"),
    curve("with NaN", CURVE + "0.1,0\nnan,100\n", "line 3"),
    curve("without a header", "0.1,0\n0.2,100\n", "line 1"),
    sizes("sample:s.txt", "s.txt", "line 2", files=[("s.txt", "0.1\n-0.2\n")],
          name="sample with a negative radius"),
    ("particle larger than the container",
     refuses([*BOX, "--psd", "mono:6", "--count", "1"], ["rsa"])),
    ("particle just larger than the container",
     refuses([*BOX, "--psd", "mono:5.0000001", "--count", "1"], ["rsa", "5.0000001"])),
    ("density that equal spheres cannot reach at random in a periodic cell",
     refuses(["--domain", "box:10,10,10+periodic", "--psd", "mono:0.5",
              "--target-porosity", "0.5"], ["volume_fraction"])),
    ("lattice that a periodic cell does not hold",
     refuses(["--domain", "box:10,10,10.3+periodic", "--psd", "mono:0.5", "--method",
              "lattice:sc"], ["lattice:sc"])),
    ("lattice of another dimension",
     refuses(["--domain", "rect:10,10", "--psd", "mono:0.5", "--method", "lattice:fcc"],
             ["lattice:fcc", "kind"])),
    option("--count", "0", words=["--count"]),
    option("--count", "-5", words=["--count", "'-5'"]),
    option("--count", "1e3", words=["--count", "'1e3'"]),
    option("--count", "99999999999999999999", words=["--count"]),
    option("--mass", "1", words=["only one"], name="count and mass"),
    ("mass 0", refuses([*BOX, "--psd", "mono:1", "--mass", "0"], ["--mass", "above 0"])),
    ("mass NaN", refuses([*BOX, "--psd", "mono:1", "--mass", "nan"], ["--mass"])),
    ("mass above the container",
     refuses([*BOX, "--psd", "mono:1", "--mass", "1e9"], ["--mass", "container"])),
    ("density -1",
     refuses([*BOX, "--psd", "mono:1", "--density", "-1"], ["--density", "above 0"])),
    ("porosity 1",
     refuses([*BOX, "--psd", "mono:1", "--target-porosity", "1"], ["--target-porosity"])),
    ("porosity 0",
     refuses([*BOX, "--psd", "mono:1", "--target-porosity", "0"], ["--target-porosity"])),
    option("--method", "dem", words=["--method", "'dem'"]),
    option("--method", "lattice:diamond", words=["--method", "'diamond'"]),
    option("--method", "lattice:sc", "--order", "drawn", words=["--order", "lattice"]),
    option("--order", "random", words=["--order", "'random'"]),
    option("--max-failures", "0", words=["--max-failures"]),
    ("descending without an amount",
     refuses([*BOX, "--psd", "uniform:0.1,0.2", "--order", "descending"], ["order"])),
    option("--seed", "-1", words=["--seed", "'-1'"]),
    option("--seed", "18446744073709551616", words=["--seed"]),
    option("--stream", "x", words=["--stream", "'x'"]),
    option("--threads", "0", words=["--threads"]),
    option("--threads", "1025", words=["--threads"]),
    option("--isa", "sse9", words=["--isa", "'sse9'"]),
    option("--max-overlap", "1", words=["--max-overlap"]),
    option("--max-overlap", "nan", words=["--max-overlap"]),
    option("--colour", "mood", words=["--colour", "'mood'"]),
    option("--domain", "sphere:3", words=["--domain", "twice"], name="two domains"),
    option("--frobnicate", words=["--frobnicate"]),
    option("loose", words=["'loose'"]),
    output("option without its value", "--out", words=["--out"]),
    output("unknown extension", "--out", "pack.doc", words=["--out", "'pack.doc'"]),
    output("an extension alone", "--out", ".csv", words=["--out", "'.csv'"]),
    output("unknown format", "--out", "obj:pack.csv", words=["--out", "'obj'", "vtp"]),
    output("format without a file", "--out", "csv:", words=["--out", "missing"]),
    output("same file twice", "--out", "a.csv", "--out", "vtp:./a.csv",
           words=["--out", "twice"]),
    output("report over a pack", "--out", "a.csv", "--report", "a.csv",
           words=["--report", "twice"]),
    output("two reports", "--report", "a.json", "--report", "b.json",
           words=["--report", "twice"]),
    output("plot with a strange extension", "--plot-sizes", "sizes.gif",
           words=["--plot-sizes", "sizes.gif"]),
    ("output over the input",
     refuses([*BOX, "--psd", "sample:s.csv", "--out", "s.csv"], ["--out", "input"],
             files=[("s.csv", "0.1\n0.2\n")], out=False)),
    output("folder that is not there", "--out", "no/pack.csv",
           words=["--out", "no/pack.csv"], code=SYSTEM),
    output("a folder as a file", "--out", "csv:.", words=["--out", "directory"],
           code=SYSTEM),
    output("disk full", "--out", "pack.vtp", "--out", "csv:/dev/full", "--out", "b.png",
           words=["--out", "/dev/full"], code=SYSTEM),
    output("disk full for the report", "--out", "pack.vtp", "--report", "/dev/full",
           words=["--report", "/dev/full"], code=SYSTEM),
]


def refuses_before_the_work(program):
    """A place that cannot be written is told at once: this pack would take minutes."""
    with Folder(program) as folder:
        result = folder.run("--domain", "box:1,1,1", "--psd", "uniform:0.0005,0.001",
                            "--target-porosity", "0.6", "--out", "no/pack.csv")
        equal(result.code, SYSTEM, "exit code")


def standard_output_full(program):
    with Folder(program) as folder, open("/dev/full", "w") as full:
        done = subprocess.run([program, *BOX, *SMALL, "--out", "a.csv"], cwd=folder.path,
                              stdout=full, stderr=subprocess.PIPE)
        equal(done.returncode, SYSTEM, "exit code")
        equal(os.listdir(folder.path), [], "files")


def standard_output_closed(program):
    """The report does not slip into a pack that takes the number of standard output."""
    with Folder(program) as folder:
        done = subprocess.run([program, *BOX, *SMALL, "--out", "a.csv"], cwd=folder.path,
                              stdin=subprocess.DEVNULL, stderr=subprocess.PIPE,
                              preexec_fn=lambda: os.close(1))
        equal(done.returncode, SYSTEM, "exit code")
        equal(os.listdir(folder.path), [], "files")


def disk_full_while_writing(program):
    """More than the buffers hold; the system's reason is told, the file's name once."""
    with Folder(program) as folder:
        result = folder.run("--domain", "box:40,40,40", "--psd", "mono:0.5", "--count",
                            "20000", "--out", "a.csv", "--out", "csv:/dev/full")
        equal((result.code, result.files), (SYSTEM, []), "exit code, files")
        equal(result.err, "packing-cloud: --out: /dev/full: No space left on device\n",
              "standard error")


TESTS += [("disk full while writing", disk_full_while_writing),
          ("standard output closed", standard_output_closed),
          ("unwritable place told before the work", refuses_before_the_work),
          ("disk full for standard output", standard_output_full)]

main(TESTS)
