# SPDX-License-Identifier: GPL-3.0-or-later
"""Each request of a program for memory is refused once: memory.py PROGRAM MODULE.

It ends with exit code 3, one line and no file, or, where the C library does without, with the
very files of an undisturbed run. Pictures are left out: fontconfig, through which cairo finds
its letters, does not survive a refusal."""
import json
import os
import sys
from cli import DONE, SYSTEM, Folder, equal, holds, main, one_line

MODULE = os.path.abspath(sys.argv[2])
NAME = os.path.basename(sys.argv[1])
CLOUD = {
    "rsa": ["--domain", "cylinder:2,5", "--psd", "0.5*curve:c.csv+0.5*sample:s.txt",
            "--count", "20", "--order", "descending"],
    "equal spheres": ["--domain", "box:2,2,2+periodic", "--psd", "mono:0.3"],
    "lattice": ["--domain", "silo:2,6,1,3", "--psd", "mono:0.5", "--method", "lattice:fcc"],
    "cells": ["--domain", "rect:9,9", "--psd", "uniform:0.2,0.4", "--count", "20",
              "--method", "lattice:cells"],
}
SETTLED = ["--layer-end", "time", "--layer-time", "0.05", "--layer-height", "0.1"]
LAYERS = {
    "spheres": ["--domain", "cone:0.1,0.12,0.06", "--psd", "sample:r.txt", "--quiet",
                "--layer-density", "0.2", *SETTLED],
    "packs of discs": ["--domain", "rect:0.3,0.06+periodic:x", "--psd", "mono:0.02",
                       "--packs", "2", *SETTLED],
}
CONVERT = {
    "a table": ["--in", "p.csv", "--crop", "box:3,3,3", "--scale", "2", "--shift", "1,1,1",
                "--replicate", "2,2,1", "--bond", "0.5", "--renumber"],
    "bonds": ["--in", "g.geo", "--renumber", "--replicate", "2,1,1"],
    "VTK": ["--in", "v.vtp", "--domain", "box:4,4,4"],
}
FRONT = {
    "spheres": ["--domain", "box:4,4,4", "--psd", "0.5*mono:0.5+0.5*uniform:0.3,0.4",
                "--in", "p.csv", "--grade", "mono:0.3@box:9,9,2", "--count", "20", "--quiet"],
    "paper": ["--domain", "box:2,2,2", "--psd", "sample:s.txt", "--mode", "paper", "--loosen",
              "remove", "--target-porosity", "0.95", "--trace", "trace.csv"],
    "a list of discs": ["--domain", "circle:3", "--list", "l.csv", "--mode", "fast",
                        "--settle", "gravity", "--settle-time", "0.05", "--quiet"],
}
MEASURE = {
    "spheres": ["--in", "p.csv", "--psd", "0.5*curve:c.csv+0.5*sample:s.txt", "--sieves",
                "0.5,0.3", "--profile", "z,3", "--section", "z,2", "--normals", "6", "--rdf",
                "1,5", "--tolerance", "0.5"],
    "discs": ["--in", "xyz:x.xyz", "--profile", "x,4", "--order", "nearest:2"],
}
PACKS = {"packing-cloud": CLOUD, "packing-convert": CONVERT, "packing-front": FRONT,
         "packing-layers": LAYERS, "packing-measure": MEASURE}[NAME]
OUT = ["pack.csv", "pack.vtp", "pack.data", "pack.xyz", "yade:pack.txt"]
if NAME == "packing-measure":
    OUT = [["--contacts", "contacts.csv"], ["--order-list", "order.csv"], ["--bonds", "0.5:bonds.csv"],
           ["--map", "2,2:map.csv"], ["--pore-network", "pores"]]
# A report full of numbers is made of thousands of like requests: every third is enough.
STEP = 3 if NAME == "packing-measure" else 1
ROWS = "x,y,z,r\n1,1,1,0.2\n1.5,1,1,0.2\n1,1.5,1,0.3\n2,1,2,0.2\n1,1,1.5,0.3\n"
INPUT = {"c.csv": "diameter,passing\n0.2,0\n0.4,1\n", "s.txt": "0.2\n0.3\n",
         "r.txt": "0.02\n0.025\n", "l.csv": "radius,count\n0.5,9\n", "p.csv": "# domain: box:4,4,4+periodic\n" + ROWS,
         "x.xyz": '2\nLattice="4 0 0 0 4 0 0 0 1" Properties=species:S:1:pos:R:3:radius:R:1 '
                  'pbc="T T F"\nX 1 1 0 .5\nX 2 1 0 .5\n',
         "g.geo": "LSMGeometry 1.2\nBoundingBox 0 0 0 4 4 4\nPeriodicBoundaries 1 0 0\n"
                  "Dimension 3D\nBeginParticles\nSimple\n2\n0.5 2 2 0.5 0 1\n"
                  "1.5 2 2 0.5 1 1\nEndParticles\nBeginConnect\n1\n0 1 5\nEndConnect\n",
         "v.vtp": '<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian">'
                  '<PolyData><Piece NumberOfPoints="1"><Points><DataArray type="Float64" '
                  'NumberOfComponents="3" format="ascii">1 1 1</DataArray></Points>'
                  '<PointData><DataArray type="Float64" Name="radius" format="ascii">0.5'
                  '</DataArray></PointData></Piece></PolyData></VTKFile>\n'}


def without_times(report):
    """What differs from run to run goes."""
    for key in ("time", "rate", "mean", "sd", "cv"):
        report.pop(key, None)
    report.get("layers", {}).pop("particle_steps_per_second", None)
    for pack in report.get("packs", []):
        without_times(pack)


def run(program, arguments, fail_at):
    """The result and what the files hold; the report without its times."""
    with Folder(program) as folder:
        for name, text in INPUT.items():
            folder.write(name, text)
        outs = [word for name in OUT for word in
                (["--out", name] if isinstance(name, str) else name)]
        result = folder.run(*arguments, *outs, "--threads", "1", "--report", "report.json",
                            env=dict(os.environ, LD_PRELOAD=MODULE, FAIL_AT=str(fail_at)))
        result.files = {name: folder.read(name) for name in result.files
                        if name not in INPUT and name != "trace.csv"}  # times
    if "report.json" in result.files:
        report = json.loads(result.files["report.json"])
        without_times(report)
        result.files["report.json"] = report
    return result


def survives(arguments):
    def test(program):
        whole = run(program, arguments, 0)
        packs = 2 if "--packs" in arguments else 1
        equal(whole.code, DONE, whole.err)
        holds(len(whole.files) >= packs * len(OUT) + 1, "files: %s" % sorted(whole.files))
        refused, fail_at, unnoticed = 0, 1, 0
        while unnoticed < 50:  # more than the C library does without in a row
            result = run(program, arguments, fail_at)
            if result.code == DONE:
                holds(result.files == whole.files, "files differ, request %d" % fail_at)
                unnoticed += 1
            else:
                equal(result.code, SYSTEM, "exit code, request %d" % fail_at)
                equal(sorted(result.files), [], "files, request %d" % fail_at)
                one_line(result, NAME, "out of memory")
                refused, unnoticed = refused + 1, 0
            fail_at += STEP
        holds(refused > 200, "only %d requests were refused" % refused)
    return test


main([(name, survives(arguments)) for name, arguments in PACKS.items()])
