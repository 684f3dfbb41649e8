# SPDX-License-Identifier: GPL-3.0-or-later
"""packing-convert, bad input: exit code 2 (or 3), one line that names the option, nothing
written."""
from cli import BAD_INPUT, SYSTEM, main, refuses

ROWS = "x,y,z,r\n1,1,1,0.5\n2,1,1,0.5\n1,2,1,0.5\n3,3,3,0.5\n"
FILES = [("p.csv", ROWS), ("f.csv", "# domain: rect:4,4\nx,y,r\n1,1,0.5\n2,1,0.5\n"),
         ("b.csv", "# domain: box:4,4,4+periodic\n" + ROWS),
         ("g.geo", "LSMGeometry 1.2\nBoundingBox 0 0 0 4 4 4\nPeriodicBoundaries 0 0 0\n"
                   "Dimension 3D\nBeginParticles\nSimple\n1\n2 2 2 1 0 1\nEndParticles\n"
                   "BeginConnect\n0\nEndConnect\n")]
IN, FLAT, BOX = ["--in", "p.csv"], ["--in", "f.csv", "--quiet"], ["--in", "b.csv", "--quiet"]


def test(name, arguments, words, code=BAD_INPUT, out=True):
    return (name, refuses(arguments, words, code, FILES, out=out))


def option(*arguments, words, start=IN, name=None, code=BAD_INPUT):
    return test(name or " ".join(arguments), [*start, *arguments], words, code)


def output(name, *arguments, words, code=BAD_INPUT, start=IN):
    return test(name, [*start, *arguments], words, code, out=False)


TESTS = [
    test("nothing asked", [], ["--in", "missing"]),
    output("nothing to write", words=["--out", "missing"]),
    test("a file that is not there", ["--in", "none.geo"], ["--in", "none.geo"], SYSTEM),
    option("--in", "p.csv", words=["--in", "twice"]),
    option("--crop", "ball:3", words=["--crop", "'ball'"]),
    option("--crop", "box:3,3", words=["--crop", "LZ is missing"]),
    option("--crop", "box:3,3,x", words=["--crop", "'x'"]),
    option("--crop", "box:3,3,-1", words=["--crop", "size"]),
    option("--crop", "box:3,3,3+at:1", words=["--crop", "+at"]),
    option("--crop", "rect:3,3", words=["--crop", "2 dimensions"]),
    option("--crop", "sphere:3", words=["--crop", "3 dimensions"], start=FLAT),
    option("--crop-by", "half", words=["--crop-by", "'half'"]),
    option("--scale", "0", words=["--scale", "above 0"]),
    option("--scale", "-1", words=["--scale", "above 0"]),
    option("--scale", "nan", words=["--scale", "'nan'"]),
    option("--scale", "1e300", "--scale", "1e300", words=["--scale"]),
    option("--shift", "1", words=["--shift"]),
    option("--shift", "1,2", words=["--shift", "X,Y,Z"]),
    option("--shift", "1,2,3,4", words=["--shift"]),
    option("--shift", "1,2,inf", words=["--shift", "'inf'"]),
    option("--shift", "1,2,3", words=["--shift", "two dimensions"], start=FLAT),
    option("--shift", "1e308,0,0", "--shift", "1e308,0,0", words=["--shift"]),
    option("--replicate", "2,2,2", words=["--replicate", "--domain"], name="no box"),
    option("--replicate", "2,2,2", "--domain", "sphere:9", words=["--replicate", "box"]),
    option("--replicate", "2,2,2", "--domain", "box:4,4,4+open:top",
           words=["--replicate", "open top"]),
    option("--replicate", "0,2,2", words=["--replicate"], start=BOX),
    option("--replicate", "2", words=["--replicate"], start=BOX),
    option("--replicate", "2,2", words=["--replicate", "NX,NY,NZ"], start=BOX),
    option("--replicate", "2,-2,2", words=["--replicate", "'-2'"], start=BOX),
    option("--replicate", "2,2,2", words=["--replicate", "two dimensions"], start=FLAT,
           name="discs above each other"),
    option("--replicate", "1000000,1000000,1", words=["--replicate", "particles"], start=BOX),
    option("--bond", "-1", words=["--bond", "below 0"]),
    option("--bond", "x", words=["--bond", "'x'"]),
    output("ids that begin at 0", "--out", "a.data", words=["a.data", "--renumber"],
           start=["--in", "g.geo", "--quiet"]),
    option("--density", "0", words=["--density"]),
    option("--domain", "rect:4,4", words=["--domain", "flat"]),
    option("--dim", "2", words=["--dim", "p.csv"]),
    option("--psd", "mono:1", words=["--psd"]),
    option("loose", words=["'loose'"]),
    output("unknown extension", "--out", "a.doc", words=["--out", "'a.doc'", ".geo"]),
    output("unknown format", "--out", "obj:a", words=["--out", "'obj'", "mercury"]),
    output("a deck without its pack", "--out", "lammps-deck:in.a", words=["--out", "in.a"]),
    output("a mesh of no container", "--out", "a.stl", words=["--out", "a.stl"]),
    output("a pack outside its container", "--out", "a.data", words=["--out", "a.data"],
           start=["--in", "p.csv", "--domain", "box:2,2,2+periodic"]),
    output("output over the input", "--out", "p.csv", words=["--out", "input"]),
    output("folder that is not there", "--out", "no/a.csv", words=["no/a.csv"], code=SYSTEM),
    output("disk full", "--out", "a.vtp", "--out", "csv:/dev/full", words=["/dev/full"],
           code=SYSTEM),
]
assert len({name for name, _ in TESTS}) == len(TESTS), "two tests of one name"
main(TESTS)
