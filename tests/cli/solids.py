# SPDX-License-Identifier: GPL-3.0-or-later
"""Polygons and combined containers on the command line: what they come to, what is refused, and
that the pack tells its container to the other programs.

usage: solids.py PACKING_CLOUD PACKING_MEASURE PACKING_CONVERT
"""
import json
import math
import os
import sys
from cli import SYSTEM, Folder, equal, holds, main, refuses

SMALL = ["--psd", "mono:0.1", "--count", "8"]
L = ("l.csv", "# an L with a hole\nx,y\n0,0\n4,0\n4,2\n2,2\n2,5\n0,5\n\n"
              "0.5,0.5\n1.5,0.5\n1.5,1.5\n0.5,1.5\n")
MEASURE, CONVERT = os.path.abspath(sys.argv[2]), os.path.abspath(sys.argv[3])


def makes(volume, *arguments, within=1e-12, files=(L,)):
    def test(program):
        with Folder(program) as folder:
            for name, text in files:
                folder.write(name, text)
            result = folder.run(*arguments, *SMALL, "--out", "pack.csv", "--out", "pack.png",
                                "--report", "report.json")
            equal(result.code, 0, "exit code (%s)" % result.err)
            report = json.loads(folder.read("report.json"))
            holds(abs(report["domain_volume"] / volume - 1) < within,
                  "volume %r, not %r" % (report["domain_volume"], volume))
            equal(report["particles"], 8, "particles")
            holds(report["audit"]["max_protrusion"] <= 0, "protrusion")
            told = " ".join(arguments[1:])
            equal(report["options"]["domain"], told, "options.domain")
            holds(("# domain: %s\n" % told).encode() in folder.read("pack.csv"), "note")
    return test


def refused(words, *arguments, files=(), code=2, name=None):
    return (name or "refused: " + " ".join(arguments),
            refuses([*arguments, *SMALL], words, code, files))


def goes_round(program):
    """Made, measured, scaled and moved; the container goes with the pack."""
    with Folder(program) as folder:
        folder.write(*L)
        made = folder.run("--domain", "polygon:l.csv", "--minus", "circle:0.5+at:1,4", *SMALL,
                          "--out", "pack.csv", "--report", "r.json")
        equal(made.code, 0, made.err)
        holds(any("l.csv" in i["path"] if isinstance(i, dict) and "path" in i else
                  "l.csv" in json.dumps(i)
                  for i in json.loads(folder.read("r.json"))["input"]), "input file")
        folder.program = MEASURE
        measured = folder.run("--in", "pack.csv", "--report", "m.json")
        equal(measured.code, 0, measured.err)
        volume = 13 - math.pi / 4
        got = json.loads(folder.read("m.json"))["domain_volume"]
        holds(abs(got / volume - 1) < 2e-4, "measured volume %r" % got)
        folder.program = CONVERT
        changed = folder.run("--in", "pack.csv", "--scale", "2", "--shift", "1,-3", "--out",
                             "moved.csv", "--report", "c.json")
        equal(changed.code, 0, changed.err)
        holds(b"# domain: polygon:l.csv+scale:2+at:1,-3 --minus circle:1+at:3,5\n" in
              folder.read("moved.csv"), "the container scaled and moved")
        cropped = folder.run("--in", "pack.csv", "--crop",
                             "polygon:l.csv --and rect:1,9", "--out", "part.csv",
                             "--report", "c.json")
        equal(cropped.code, 0, cropped.err)


def help_tells(program):
    with Folder(program) as folder:
        text = folder.run("--help").out.decode()
        for word in ("polygon:FILE", "--or=SPEC", "--and=SPEC", "--minus=SPEC", "--or SPEC"):
            holds(word in text, word)


BOX = ["--domain", "box:2,1,1"]
TESTS = [
    ("polygon", makes(13, "--domain", "polygon:l.csv")),
    ("polygon scaled and moved", makes(52, "--domain", "polygon:l.csv+scale:2+at:5,5")),
    ("union", makes(3, "--domain", "box:2,1,1", "--or", "box:1,2,1")),
    ("touching", makes(3, "--domain", "box:2,1,1", "--or", "box:1,1,1+at:2,0,0")),
    ("the first scaled", makes(8 + 1, "--domain", "box:1,1,1+scale:2", "--or",
                               "box:1,1,1+at:2,0,0")),
    ("intersection", makes(1, "--domain", "box:2,1,1", "--and", "box:1,2,1")),
    ("difference", makes(1, "--domain", "box:2,1,1", "--minus", "box:1,2,1")),
    ("left to right", makes(1.5, "--domain", "box:2,1,1", "--or", "box:1,2,1", "--and",
                            "box:9,9,0.5", within=1e-5)),
    ("axis", makes(2 * math.pi, "--domain", "cylinder:1,3,axis=x", "--minus",
                   "box:1,4,4+at:1,-2,-2")),
    ("polygon and circle", makes(math.pi / 4, "--domain", "polygon:l.csv", "--and",
                                 "circle:0.5+at:1,4", within=2e-4)),
    ("goes round", goes_round),
    ("help", help_tells),
    refused(["--or, --and, --minus", "--domain is missing"], "--and", "box:1,1,1"),
    refused(["--or", "2 dimensions", "3"], *BOX, "--or", "circle:1"),
    refused(["--and", "nothing is left"], *BOX, "--and", "box:1,1,1+at:5,0,0"),
    refused(["--minus", "nothing is left"], *BOX, "--minus", "box:3,3,3+at:-1,-1,-1"),
    refused(["--or", "unknown container 'ball'"], *BOX, "--or", "ball:1"),
    refused(["--minus", "a number is missing"], *BOX, "--minus", "sphere:"),
    refused(["--or", "periodic"], "--domain", "box:1,1,1+periodic", "--or", "sphere:1"),
    refused(["--minus", "open top"], *BOX, "--minus", "box:1,1,1+open:top"),
    refused(["--domain", "FILE is missing"], "--domain", "polygon:"),
    refused(["--domain", "no.csv"], "--domain", "polygon:no.csv", code=SYSTEM),
    refused(["+periodic", "polygon"], "--domain", "polygon:l.csv+periodic", files=(L,)),
    refused(["l.csv", "line 3", "ring 1 ends with 2 vertices"], "--domain", "polygon:l.csv",
            files=[("l.csv", "x,y\n0,0\n1,1\n")], name="refused: two vertices"),
    refused(["l.csv", "crosses or touches"], "--domain", "polygon:l.csv",
            files=[("l.csv", "x,y\n0,0\n2,2\n2,0\n0,2\n")], name="refused: a bow tie"),
]

if __name__ == "__main__":
    main(TESTS)
