# SPDX-License-Identifier: GPL-3.0-or-later
"""packing-convert: convert_packs.py CONVERT CLOUD. Formats there and back, and what changes on
the way."""
import csv
import gzip
import json
import math
import os
import re
import signal
import subprocess
import sys
import time
from cli import DONE, INTERRUPTED, Folder, equal, holds, main, one_line

CLOUD = os.path.abspath(sys.argv[2])

KEYS = ["program", "version", "command", "options", "input", "seed", "threads", "dim",
        "particles", "domain_volume", "solid_volume", "volume_fraction", "porosity",
        "void_ratio", "volume_fraction_inner", "coordination", "fabric", "audit", "psd",
        "convert", "time", "rate"]
# What both a reader and a writer know, with the extension it goes by (else FORMAT:).
BOTH = {"vtp": "a.vtp", "vtu": "a.vtu", "lammps": "a.data", "liggghts": "liggghts:a",
        "dump": "a.dump", "yade": "yade:a", "yade-pack": "yade-pack:a", "geo": "a.geo",
        "xyz": "a.xyz"}
PACK = ("x,y,z,r,id,type,vx,vy,vz\n"
        "1.1,1.2,1.3,0.5,7,1,0.1,0.2,0.3\n"
        "2.1,1.7,0.9,0.25,3,2,0,-1e-3,0\n"
        "0.12345678901234567,3.5,2.25,0.1,12,1,1e-17,0,5\n")


def strict(text):
    def refuse(word):
        raise AssertionError(word + " in the report")
    return json.loads(text, parse_constant=refuse)


def rows(text):
    lines = [line for line in text.decode().splitlines() if not line.startswith("#")]
    return [{k: float(v) for k, v in row.items()} for row in csv.DictReader(lines)]


def notes(text):
    lines = [line[2:] for line in text.decode().splitlines() if line.startswith("# ")]
    return [tuple(line.split(": ", 1)) for line in lines]


def converted(program, text, *arguments, out="q.csv", name="p.csv"):
    """The report and the file that comes of a pack."""
    with Folder(program) as folder:
        folder.write(name, text)
        result = folder.run("--in", name, *arguments, "--out", out, "--quiet")
        equal((result.code, result.err), (DONE, ""), "exit code, standard error")
        path = out.split(":")[-1]
        equal(result.files, sorted([name, path]), "files")
        return strict(result.out), folder.read(path)


def formats_there_and_back(program):
    """To the last bit: what a format holds comes back."""
    for name, out in BOTH.items():
        _, there = converted(program, PACK, "--domain", "box:4,4,4", out=out)
        with Folder(program) as folder:
            with open(os.path.join(folder.path, "b"), "wb") as file:
                file.write(there)
            result = folder.run("--in", name + ":b", "--out", "c.csv", "--quiet")
            equal((result.code, result.err), (DONE, ""), name)
            got = rows(folder.read("c.csv"))
        wanted = rows(PACK.encode())
        equal(len(got), 3, name)
        if "id" in got[0] and name != "yade":
            got.sort(key=lambda row: [w["id"] for w in wanted].index(row["id"]))
        for a, b in zip(got, wanted):
            for key in "xyz":
                equal(a[key], b[key], name + " " + key)
            holds(abs(a["r"] - b["r"]) <= 1e-16, name + " r")
            for key in ("vx", "vy", "vz", "type"):
                if key in a and name not in ("geo", "yade"):
                    equal(a[key], b[key], name + " " + key)


def every_format_is_written(program):
    with Folder(program) as folder:
        folder.write("p.csv", PACK)
        said = folder.run("--in", "p.csv", "--out", "x:y").err
        formats = said.split("known are ")[1].strip().split(", ")
        text = folder.run("--help").out.decode()
        listed = re.findall(r"[a-z-]+", text.split("write the pack;")[1])
        for name in formats:
            holds(name in listed, name + " in --help")
        outs = [word for name in formats for word in ("--out", "%s:a.%s" % (name, name))]
        result = folder.run("--in", "p.csv", "--domain", "box:4,4,4", *outs, "--report", "r")
        equal((result.code, result.err), (DONE, ""), "exit code")
        equal(result.files, sorted(["p.csv", "r", *("a." + name for name in formats)]), "files")
        for name in formats:
            holds(len(folder.read("a." + name)) > 20, name)


def decks_name_their_files(program):
    with Folder(program) as folder:
        os.mkdir(os.path.join(folder.path, "d"))
        folder.write("p.csv", PACK)
        result = folder.run("--in", "p.csv", "--domain", "silo:4,9,1,3", "--shift", "-1,-1,2",
                            "--out", "d/a.data", "--out", "lammps-deck:d/in.a", "--out",
                            "liggghts-deck:in.b", "--out", "d/a.stl", "--quiet")
        equal((result.code, result.err), (DONE, ""), "exit code")
        near, far = folder.read("d/in.a").decode(), folder.read("in.b").decode()
    holds(re.search(r"^read_data\s+a\.data$", near, re.M), near)
    holds(re.search(r"^read_data\s+d/a\.data", far, re.M), far)
    holds("d/a.stl" in far, "the mesh")


def changes_apply_in_their_order(program):
    pack = "# domain: box:4,4,4\n" + PACK
    _, text = converted(program, pack, "--scale", "2", "--shift", "1,2,3")
    equal([[row[key] for key in "xyzr"] for row in rows(text)],
          [[2 * row["x"] + 1, 2 * row["y"] + 2, 2 * row["z"] + 3, 2 * row["r"]]
           for row in rows(PACK.encode())], "scaled, then moved")
    equal([row["vz"] for row in rows(text)], [.6, 0, 10], "velocities")
    holds(("domain", "box:8,8,8+at:1,2,3") in notes(text), "container")
    equal([note for note in notes(text) if note[0] in ("scale", "shift")],
          [("scale", "2"), ("shift", "1,2,3")], "notes")
    _, text = converted(program, pack, "--shift", "1,2,3", "--scale", "2")
    equal(rows(text)[0]["z"], 2 * (1.3 + 3), "moved, then scaled")
    holds(("domain", "box:8,8,8+at:2,4,6") in notes(text), "container")


def crops_keep_what_is_inside(program):
    pack = "# domain: box:4,4,4\n" + PACK
    report, text = converted(program, pack, "--crop", "box:1.7,2,2+at:0.5,0.5,0.5")
    equal([row["id"] for row in rows(text)], [7], "whole")
    near = report["volume_fraction"] - 4 / 3 * math.pi / 8 / 6.8
    holds(abs(near) < 1e-12, "volume fraction")
    equal(report["convert"], {"read": 3, "written": 1, "bonds_read": 0, "bonds_written": 0,
                              "domain": "box:1.7,2,2+at:0.5,0.5,0.5"}, "counts")
    _, text = converted(program, pack, "--crop", "box:1.7,2,2+at:0.5,0.5,0.5", "--crop-by",
                        "centres")
    equal([row["id"] for row in rows(text)], [7, 3], "centres")
    report, text = converted(program, pack, "--crop", "sphere:0.1")
    equal((rows(text), report["particles"]), ([], 0), "nothing left")


def boxes_repeat(program):
    pack = "# domain: box:4,4,4+periodic+at:0.5,0,0\n" + PACK
    report, text = converted(program, pack, "--replicate", "2,3,1")
    wanted = [[row["x"] + 4 * i, row["y"] + 4 * j, row["z"]] for j in range(3)
              for i in range(2) for row in rows(PACK.encode())]
    got = rows(text)
    equal([[row["x"], row["y"], row["z"]] for row in got], wanted, "places")
    equal([row["id"] for row in got], list(range(1, 19)), "ids")
    equal([row["type"] for row in got], [1, 2, 1] * 6, "types")
    holds(("domain", "box:8,12,4+periodic:xyz+at:0.5,0,0") in notes(text), "container")
    once, _ = converted(program, pack)
    for key in ("volume_fraction", "porosity"):
        holds(abs(report[key] - once[key]) < 1e-12, key)
    equal(report["coordination"]["mean"], once["coordination"]["mean"], "contacts")


def repeated_lattices_stay_lattices(program):
    """The unit cell of FCC, touching: 4, then 4 * 27 spheres of 12 contacts."""
    edge = math.sqrt(2)
    cell = "# domain: box:%.17g,%.17g,%.17g+periodic\nx,y,z,r\n" % (edge, edge, edge) + "".join(
        "%.17g,%.17g,%.17g,0.5\n" % (edge * a, edge * b, edge * c)
        for a, b, c in ((.1, .1, .1), (.6, .6, .1), (.6, .1, .6), (.1, .6, .6)))
    for times, count in (("1,1,1", 4), ("3,3,3", 108)):
        report, _ = converted(program, cell, "--replicate", times)
        equal((report["particles"], report["coordination"]["mean"]), (count, 12), times)
        holds(abs(report["volume_fraction"] - math.pi / (3 * math.sqrt(2))) < 1e-12, times)


def pairs(text):
    """The bonds of a .geo file."""
    lines = text.decode().splitlines()
    start = lines.index("BeginConnect")
    return [tuple(map(int, line.split())) for line in lines[start + 2:lines.index("EndConnect")]]


GEO = ("LSMGeometry 1.2\nBoundingBox 0 0 0 4 4 4\nPeriodicBoundaries 1 0 0\nDimension 3D\n"
       "BeginParticles\nSimple\n3\n0.5 2 2 0.5 0 1\n1.5 2 2 0.5 1 1\n3.5 2 2 0.5 2 1\n"
       "EndParticles\nBeginConnect\n2\n0 1 5\n0 2 6\nEndConnect\n")


def bonds_go_along(program):
    _, data = converted(program, GEO, "--renumber", out="q.data", name="p.geo")
    holds(b"2 bonds" in data, "bonds in LAMMPS data")
    _, back = converted(program, data.decode(), "--domain", "box:4,4,4+periodic:x",
                        out="q.geo", name="p.data")
    equal(sorted((min(a, b), max(a, b)) for a, b, _ in pairs(back)),
          [(1, 2), (1, 3)], "and back, by their ids")
    _, twice = converted(program, GEO, "--replicate", "2,1,1", out="q.geo", name="p.geo")
    equal(sorted(pairs(twice)), [(1, 2, 5), (1, 6, 6), (4, 3, 6), (4, 5, 5)],
          "across the border they lead to the next copy")
    report, cut = converted(program, GEO, "--crop", "box:2,4,4", out="q.geo", name="p.geo")
    equal(pairs(cut), [(0, 1, 5)], "of what is left")
    equal((report["convert"]["bonds_read"], report["convert"]["bonds_written"]), (2, 1),
          "counts")


def neighbours_are_bonded(program):
    """Spheres in a row, 0.1 apart."""
    row = "x,y,z,r\n" + "".join("%g,0,0,0.5\n" % (1.1 * k) for k in range(5))
    _, text = converted(program, row, "--bond", "0.11", out="q.geo")
    equal(pairs(text), [(k, k + 1, 1) for k in range(4)], "bonds")
    _, text = converted(program, row, "--bond", "0.11", "--bond", "0.05", out="q.geo")
    equal(pairs(text), [], "none, and the first are forgotten")


def density_is_the_file_s_or_ours(program):
    _, data = converted(program, PACK, "--density", "2650", out="q.data")
    for more, wanted in (([], "2650"), (["--density", "7800"], "7800")):
        _, again = converted(program, data.decode(), *more, out="r.data", name="p.data")
        line = again.decode().split("Atoms # sphere\n\n")[1].splitlines()[0]
        equal(line.split()[3], wanted, "density")


def discs_stay_flat(program):
    pack = "# domain: rect:4,4+periodic\nx,y,r\n1,1,0.5\n2,2,0.5\n"
    report, text = converted(program, pack, "--scale", "2", "--shift", "1,0", "--replicate",
                             "2,1")
    equal(report["dim"], 2, "dim")
    holds("z" not in rows(text)[0], "no z")
    equal([[row["x"], row["y"]] for row in rows(text)], [[3, 2], [5, 4], [11, 2], [13, 4]],
          "places")
    report, text = converted(program, "x,y,z,r\n1,1,0,0.5\n", "--dim", "3")
    equal(report["dim"], 3, "a layer of spheres")
    holds("z" in rows(text)[0], "z")


def containers_are_found_or_missed_aloud(program):
    table = "# domain: box:4,4,4\nx,y,z,r\n1,1,1,0.5\n"
    _, text = converted(program, "\ufeff" + table)
    holds(("domain", "box:4,4,4") in notes(text), "behind a byte order mark")
    with Folder(program) as folder:
        with gzip.open(os.path.join(folder.path, "p.csv.gz"), "wt") as file:
            file.write(table)
        one_line(folder.run("--in", "p.csv.gz", "--out", "q.csv"), "p.csv.gz", "--domain")
        equal(folder.run("--in", "p.csv.gz", "--domain", "box:9,9,9", "--out", "q.csv").err,
              "", "where --domain tells it")
    data = ("pack\n1 atoms\n1 atom types\n0 4 xlo xhi\n0 4 ylo yhi\n%d 4 zlo zhi\n\n"
            "Atoms # sphere\n\n1 1 1 1000 1 1 1\n")
    with Folder(program) as folder:
        folder.write("p.data", data % 0)
        folder.write("flat.data", data % 4)
        one_line(folder.run("--in", "p.data", "--out", "q.csv"), "p.data", "taken as walls")
        one_line(folder.run("--in", "flat.data", "--out", "q.csv"), "--in", "its container: size.z")


def pictures_need_no_container(program):
    for out in ("q.png", "q.svg"):
        report, text = converted(program, PACK, out=out)
        holds(text[:4] in (b"\x89PNG", b"<?xm"), out)
        equal((report["domain_volume"], report["porosity"]), (None, None), "void")
        equal(report["audit"]["max_protrusion"], None, "no walls")
    converted(program, "x,y,z,r\n", out="q.png")


def report_has_every_key(program):
    report, _ = converted(program, PACK, "--crop", "sphere:9", "--scale", "3")
    equal(list(report), KEYS, "keys")
    equal(report["options"]["changes"], [{"crop": "sphere:9"}, {"scale": "3"}], "changes")
    equal(report["seed"], None, "seed")
    holds(re.fullmatch("[0-9a-f]{64}", report["input"][0]["sha256"]), "hash")


def failed_audits_are_told_and_no_error(program):
    report, text = converted(program, "# domain: box:2,2,2\nx,y,z,r\n1,1,1,0.5\n1.5,1,1,0.5\n")
    equal(report["audit"]["passed"], False, "passed")
    holds(("audit", "FAILED, limit 1e-09") in notes(text), "note")


def a_pack_of_packing_cloud_goes_round(program):
    """Through five formats and back to equal bytes of x, y, z, r."""
    with Folder(CLOUD) as folder:
        folder.run("--domain", "box:4,4,4+periodic", "--psd", "uniform:0.1,0.3", "--count",
                   "200", "--out", "a.csv", "--report", "r.json")
        folder.program = program
        chain = ["a.csv", "b.vtu", "c.xyz", "d.geo", "e.vtp", "f.csv"]
        for come, go in zip(chain, chain[1:]):
            equal(folder.run("--in", come, "--out", go, "--report", "r.json").code, DONE, go)
        equal([[row[key] for key in "xyzr"] for row in rows(folder.read("f.csv"))],
              [[row[key] for key in "xyzr"] for row in rows(folder.read("a.csv"))], "rows")


def stops_when_told(program):
    with Folder(program) as folder:
        os.mkfifo(os.path.join(folder.path, "pipe.csv"))
        run = subprocess.Popen([program, "--in", "pipe.csv", "--out", "a.vtp"],
                               cwd=folder.path, stdout=subprocess.PIPE,
                               stderr=subprocess.PIPE)
        with open(os.path.join(folder.path, "pipe.csv"), "w") as feed:
            feed.write("x,y,z,r\n")
            feed.flush()
            time.sleep(0.5)
            equal(run.poll(), None, "still reading")
            run.send_signal(signal.SIGTERM)
            feed.write("1,1,1,1\n")
        out, err = run.communicate(timeout=60)
        equal((run.returncode, out), (INTERRUPTED, b""), "exit code, output")
        holds(b"nothing written" in err, err)
        equal(os.listdir(folder.path), ["pipe.csv"], "files")


def help_mentions_every_option(program):
    with Folder(program) as folder:
        text = folder.run("--help").out.decode()
        for name in ("in out domain density crop crop-by scale shift replicate bond renumber dim frame "
                     "sort radius-array diameter-array colour threads isa report max-overlap "
                     "quiet version help").split():
            holds("--" + name in text, name)
        holds(max(map(len, text.splitlines())) <= 90, "width")


main([(test.__name__.replace("_", " "), test) for test in (
    formats_there_and_back, every_format_is_written, decks_name_their_files,
    changes_apply_in_their_order, crops_keep_what_is_inside, boxes_repeat,
    repeated_lattices_stay_lattices, bonds_go_along, neighbours_are_bonded,
    density_is_the_file_s_or_ours, discs_stay_flat, containers_are_found_or_missed_aloud,
    pictures_need_no_container,
    report_has_every_key, failed_audits_are_told_and_no_error,
    a_pack_of_packing_cloud_goes_round, stops_when_told, help_mentions_every_option)])
