# SPDX-License-Identifier: GPL-3.0-or-later
"""mesh:FILE of --domain: taken in each format, moved and scaled, noted with its hash; what is no
closed surface is refused in a line that names option, file, defect and place."""
import hashlib
import json

from cli import BAD_INPUT, DONE, SYSTEM, Folder, equal, holds, main, refuses

CORNERS = [(i & 1, i >> 1 & 1, i >> 2 & 1) for i in range(8)]
SIDES = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
PACK = "x,y,z,r\n1,1,1,0.5\n3,3,3,0.25\n"


def obj(sides=SIDES):
    return "".join("v %d %d %d\n" % c for c in CORNERS) + \
        "".join("f %d %d %d %d\n" % tuple(i + 1 for i in s) for s in sides)


def stl():
    text = "solid cube\n"
    for s in SIDES:
        for t in ((s[0], s[1], s[2]), (s[0], s[2], s[3])):
            text += "facet normal 0 0 0\nouter loop\n" + \
                "".join("vertex %d %d %d\n" % CORNERS[i] for i in t) + "endloop\nendfacet\n"
    return text + "endsolid cube\n"


def ply():
    return "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\n" \
        "property float z\nelement face 6\nproperty list uchar int vertex_indices\nend_header\n" + \
        "".join("%d %d %d\n" % c for c in CORNERS) + \
        "".join("4 %d %d %d %d\n" % s for s in SIDES)


def takes(name, text, tail, volume):
    def test(program):
        with Folder(program) as folder:
            folder.write("p.csv", PACK)
            folder.write(name, text)
            result = folder.run("--in", "p.csv", "--domain", "mesh:" + name + tail)
            equal(result.code, DONE, "exit code (%s)" % result.err)
            report = json.loads(result.out)
            equal(report["options"]["domain"], "mesh:" + name + tail, "the container")
            equal(report["domain_volume"], volume, "its volume")
            equal(report["audit"]["passed"], True, "the audit")
            notes = report["input"] if isinstance(report["input"], list) else [report["input"]]
            digest = hashlib.sha256(text.encode()).hexdigest()
            holds(digest in json.dumps(notes), "the hash of %s is not in %r" % (name, notes))
    return test


def refused(name, sides, words, text=None, domain="mesh:m.obj", code=BAD_INPUT):
    files = [("p.csv", PACK), ("m.obj", obj(sides) if text is None else text)]
    return (name, refuses(["--in", "p.csv", "--domain", domain], ["--domain", *words], code,
                          files, out=False))


TESTS = [
    ("OBJ", takes("m.obj", obj(), "+scale:4", 64)),
    ("STL", takes("cube.stl", stl(), "+scale:4+at:-0.5,0,0", 64)),
    ("PLY", takes("a.b.ply", ply(), "+at:-0.125,0,0+scale:4", 64)),
    refused("a side is missing", SIDES[1:], ["m.obj", "open edge", "0.5"]),
    refused("a side is turned", [SIDES[0][::-1]] + SIDES[1:], ["opposite orientation"]),
    refused("inside out", [s[::-1] for s in SIDES], ["faces the wrong way"]),
    refused("a line that is none", SIDES, ["m.obj", "line 1"], text="hello\n"),
    refused("no file", SIDES, ["none.obj"], domain="mesh:none.obj", code=SYSTEM),
    refused("no name", SIDES, ["FILE", "mesh:FILE"], domain="mesh:"),
    refused("periodic", SIDES, ["+periodic", "mesh"], domain="mesh:m.obj+periodic"),
    refused("open", SIDES, ["+open", "mesh"], domain="mesh:m.obj+open:top"),
    refused("a scale of 0", SIDES, ["+scale"], domain="mesh:m.obj+scale:0"),
]

main(TESTS)
