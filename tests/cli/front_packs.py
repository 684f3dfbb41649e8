# SPDX-License-Identifier: GPL-3.0-or-later
"""What packing-front makes: packs, lists, grades, looser and settled packs, pictures, exit codes."""
import csv
import itertools
import json
import math
import os
import re
import signal
import subprocess
import time
from cli import DONE, INTERRUPTED, SHORT, Folder, equal, holds, main

SIZES = ["--psd", "uniform:0.7,1.3"]
BOX = ["--domain", "box:14,14,14", *SIZES]
FLAT = ["--domain", "rect:30,30", *SIZES]
MODES = ("dense", "fast", "paper")


def strict(text):
    """JSON without NaN and infinity."""
    def refuse(word):
        raise AssertionError(word + " in the report")
    return json.loads(text, parse_constant=refuse)


def rows(text):
    lines = [line for line in text.decode().splitlines() if not line.startswith("#")]
    return [{k: float(v) for k, v in row.items()} for row in csv.DictReader(lines)]


def notes(text):
    lines = [line[2:] for line in text.decode().splitlines() if line.startswith("# ")]
    return dict(line.split(": ", 1) for line in lines)


def made(program, *arguments, code=DONE, files=("pack.csv",), given=()):
    """Runs and returns the report, the files' bytes and what was said."""
    with Folder(program) as folder:
        for name, text in given:
            folder.write(name, text)
        outs = [word for name in files for word in ("--out", name)]
        result = folder.run(*arguments, *outs)
        equal(result.code, code, "exit code (%s)" % result.err)
        known = {name for name, _ in given}
        return (strict(result.out), {name: folder.read(name) for name in result.files
                                     if name not in known}, result.err)


def centre(p):
    return p["x"], p["y"], p.get("z", 0)


def overlap(particles):
    """The largest overlap relative to the smaller radius, the slow way."""
    return max((a["r"] + b["r"] - math.dist(centre(a), centre(b))) / min(a["r"], b["r"])
               for a, b in itertools.combinations(particles, 2))


def solid(particles):
    return sum(math.pi * p["r"] ** 2 if "z" not in p else 4 / 3 * math.pi * p["r"] ** 3
               for p in particles)


def in_box(particles, edge):
    for p in particles:
        for axis in "xyz":
            if axis in p:
                holds(p["r"] - 1e-12 <= p[axis] <= edge - p["r"] + 1e-12, "inside")


def spheres_fill_a_box(program):
    least = {"dense": 0.5, "fast": 0.45, "paper": 0.38}
    for mode in MODES:
        report, files, said = made(program, *BOX, "--mode", mode)
        particles = rows(files["pack.csv"])
        equal((report["audit"]["passed"], said), (True, ""), mode)
        holds(overlap(particles) <= 1e-12, "%s: overlap" % mode)
        in_box(particles, 14)
        holds(abs(solid(particles) / 14 ** 3 / report["volume_fraction"] - 1) < 1e-12, mode)
        holds(least[mode] < report["volume_fraction"] < 0.66,
              "%s: %g" % (mode, report["volume_fraction"]))
        holds(report["psd"]["ks"] < 1.3 * report["psd"]["ks_limit"], "%s: sizes" % mode)
        equal(report["front"]["placed"], len(particles), "placed")
        equal(report["options"]["mode"], mode, "mode in the report")
        holds(mode in notes(files["pack.csv"])["method"], "note")


def discs_fill_a_rectangle(program):
    for mode, direction in itertools.product(MODES, ("outward", "inward")):
        report, files, _ = made(program, *FLAT, "--mode", mode, "--direction", direction)
        particles = rows(files["pack.csv"])
        equal((report["audit"]["passed"], report["dim"]), (True, 2), mode)
        holds(overlap(particles) <= 1e-12, "overlap")
        in_box(particles, 30)
        holds(0.68 < report["volume_fraction"] < 0.9069, "%s %s: %g" % (
            mode, direction, report["volume_fraction"]))
        holds(report["options"]["direction"] == direction, "direction in the report")


def papers_coordination_is_exact(program):
    """Each particle after the first four (three) brings three (two) contacts, and no more."""
    for domain, dim in (("box:40,40,40", 3), ("rect:60,60", 2)):
        report, _, _ = made(program, "--domain", domain, *SIZES, "--mode", "paper", "--count",
                            "150")
        wanted = 6 - 12 / 150 if dim == 3 else 4 - 6 / 150
        holds(abs(report["coordination"]["mean"] - wanted) < 1e-12,
              report["coordination"]["mean"])


def any_machine_makes_the_same_bytes(program):
    with Folder(program) as folder:
        sets = [name for name in ("avx2", "avx512")
                if folder.run("--isa", name, *BOX, "--count", "1").code == DONE]
    for mode in MODES:
        outs = ("pack.csv", "pack.vtp", "pack.data")
        _, first, _ = made(program, *BOX, "--mode", mode, "--threads", "1", "--isa",
                           "baseline", files=outs)
        for more in (["--threads", "2"], ["--threads", "8"],
                     *(["--isa", name] for name in sets)):
            _, again, _ = made(program, *BOX, "--mode", mode, *more, files=outs)
            for name in first:
                holds(first[name] == again[name], "%s: %s differs with %s" % (mode, name, more))


def seed_and_stream_change_the_pack(program):
    for mode in MODES:
        packs = [rows(made(program, *BOX, "--mode", mode, "--count", "30", *more)[1]["pack.csv"])
                 for more in ([], ["--seed", "2"], ["--stream", "1"])]
        holds(packs[0] != packs[1] and packs[0] != packs[2], mode)


def amounts_are_met(program):
    half = 4 / 3 * math.pi * 1.3 ** 3 / 2
    report, files, _ = made(program, *BOX, "--count", "50")
    equal((len(rows(files["pack.csv"])), report["front"]["state"]), (50, "done"), "count")
    report, _, _ = made(program, *BOX, "--mass", "1000000")
    holds(abs(report["solid_volume"] - 1000) <= half, "mass")
    report, _, _ = made(program, *BOX, "--target-porosity", "0.6")
    holds(abs(report["porosity"] - 0.6) <= half / 14 ** 3, "porosity")


def what_cannot_fit_is_counted(program):
    for mode in MODES:
        report, files, said = made(program, "--domain", "box:5,5,5", "--psd", "mono:1",
                                   "--count", "1000", "--mode", mode, code=SHORT)
        placed = len(rows(files["pack.csv"]))
        holds(4 <= placed < 23, placed)
        equal(len(said.splitlines()), 1, said)
        holds("%d of 1000 particles placed" % placed in said, said)
        equal((report["particles"], report["audit"]["passed"]), (placed, True), "report")


def less_than_asked_is_said(program):
    for more in ([], ["--loosen", "remove"]):
        report, files, said = made(program, *BOX, "--target-porosity", "0.1", *more, code=SHORT)
        told = re.search(r"volume fraction (\S+) of 0.9 reached", said)
        holds(told and abs(float(told[1]) - report["volume_fraction"]) < 1e-5, said)
        equal(len(rows(files["pack.csv"])), report["particles"], "the files are there")
        equal(report["front"]["loosened_volume_fraction"], None, "nothing was loosened")


def looser_packs(program):
    """5 %, 2.3 % and 1.2 % solids, the figures of the paper's Figure 12."""
    full, files, _ = made(program, "--domain", "cylinder:9,18", *SIZES)
    before = rows(files["pack.csv"])
    for share in (0.05, 0.023, 0.012):
        porosity = repr(1 - share)
        report, files, _ = made(program, "--domain", "cylinder:9,18", *SIZES,
                                "--target-porosity", porosity, "--loosen", "shrink")
        after = rows(files["pack.csv"])
        holds(abs(report["volume_fraction"] / share - 1) < 1e-9, "shrunk")
        equal([centre(p) for p in after], [centre(p) for p in before], "places stay")
        holds(abs(report["psd"]["ks"] - full["psd"]["ks"]) < 1e-12, "sizes before shrinking")
        report, files, _ = made(program, "--domain", "cylinder:9,18", *SIZES,
                                "--target-porosity", porosity, "--loosen", "remove")
        after = rows(files["pack.csv"])
        holds(abs(report["volume_fraction"] - share) * report["domain_volume"]
              <= 4 / 3 * math.pi * 1.3 ** 3 / 2, "removed")
        there = {(centre(p), p["r"]) for p in before}
        holds(all((centre(p), p["r"]) in there for p in after), "what is left is as it was")
        holds(report["psd"]["ks"] < report["psd"]["ks_limit"], "sizes stay")
        equal(report["front"]["placed"], len(before), "placed before")


LIST = "# classes\ndiameter,count\n2.4,12\n2,40\n1.5,100\n"


def lists_are_placed_exactly(program):
    for mode in MODES:
        report, files, _ = made(program, "--domain", "box:20,20,20", "--list", "list.csv",
                                "--mode", mode, given=[("list.csv", LIST)])
        radii = sorted(p["r"] for p in rows(files["pack.csv"]))
        equal(radii, [0.75] * 100 + [1] * 40 + [1.2] * 12, mode)
        equal(report["front"]["list"], [
            {"radius": 1.2, "asked": 12, "unplaced": 0}, {"radius": 1, "asked": 40, "unplaced": 0},
            {"radius": 0.75, "asked": 100, "unplaced": 0}], "list")
        equal((report["psd"]["ks"], report["psd"]["unplaced"]), (None, 0), "psd")
        equal(report["input"][0]["file"], "list.csv", "input")


def lists_count_what_is_left(program):
    for mode in MODES:
        report, files, said = made(program, "--domain", "box:6,6,6", "--list", "list.csv",
                                   "--mode", mode, given=[("list.csv", LIST)], code=SHORT)
        particles = rows(files["pack.csv"])
        holds("%d of 152 particles of the list" % len(particles) in said, said)
        for entry in report["front"]["list"]:
            placed = sum(p["r"] == entry["radius"] for p in particles)
            equal(placed + entry["unplaced"], entry["asked"], "class %r" % entry)
        equal(report["psd"]["unplaced"], 152 - len(particles), "unplaced")


def lists_go_by_mass(program):
    ball = 4 / 3 * math.pi * 2500
    text = "mass,radius\n%r,1\n%r,0.5\n" % (20 * ball, 100.4 * ball / 8)
    report, _, _ = made(program, "--domain", "box:14,14,14", "--list", "list.csv", "--density",
                        "2500", given=[("list.csv", text)])
    equal([entry["asked"] for entry in report["front"]["list"]], [20, 100], "counts")


def grades_by_place(program):
    for mode in MODES:
        report, files, _ = made(program, "--domain", "box:16,16,16", "--psd",
                                "uniform:0.9,1.2", "--grade", "uniform:0.5,0.6@box:8,16,16",
                                "--mode", mode)
        fine = [p for p in rows(files["pack.csv"]) if p["r"] < 0.7]
        coarse = [p for p in rows(files["pack.csv"]) if p["r"] >= 0.7]
        holds(fine and coarse and all(p["x"] <= 8 for p in fine), "%s: fine" % mode)
        holds(all(p["x"] >= 8 for p in coarse), "%s: coarse" % mode)
        grade = report["front"]["grades"]
        equal((len(grade), grade[0]["particles"], grade[0]["domain"]),
              (1, len(fine), "box:8,16,16"), mode)
        holds(grade[0]["ks"] < 1.3 * grade[0]["ks_limit"], "%s: sizes" % mode)
        equal((report["psd"]["ks"], report["audit"]["passed"]), (None, True), mode)


def mixtures_tell_their_parts(program):
    report, files, _ = made(program, "--domain", "box:26,26,26", "--psd",
                            "0.6*mono:1+0.4*uniform:0.4,0.5", "--count", "9000")
    particles = rows(files["pack.csv"])
    for p in particles:
        equal(p["component"], 0 if p["r"] == 1 else 1, "component")
    parts = report["front"]["components"]
    equal([part["particles"] for part in parts],
          [sum(p["component"] == k for p in particles) for k in (0, 1)], "particles")
    for part in parts:
        holds(abs(part["number_placed"] - part["number_asked"]) <= 3 * part["number_sd"],
              "shares by number: %r" % part)


def particles_stand_in_the_way(program):
    text = "# domain: box:12,12,12\nx,y,z,r\n4,4,4,2.5\n9,9,9,1.25\n"
    for mode in MODES:
        report, files, said = made(program, "--in", "p.csv", *SIZES, "--mode", mode,
                                   given=[("p.csv", text)])
        particles = rows(files["pack.csv"])
        equal([(*centre(p), p["r"]) for p in particles[:2]],
              [(4, 4, 4, 2.5), (9, 9, 9, 1.25)], "they stay")
        holds(len(particles) > 60 and overlap(particles) <= 1e-12, "%s: overlap" % mode)
        equal((report["front"]["standing"], report["front"]["placed"]),
              (2, len(particles) - 2), "counts")
        holds("box:12,12,12" in said, "the container is the file's")
        holds(report["psd"]["ks"] < 1.3 * report["psd"]["ks_limit"], "sizes are those placed")
    report, files, _ = made(program, "--domain", "box:12,12,12", "--in", "p.csv", *SIZES,
                            "--target-porosity", "0.7", given=[("p.csv", text)])
    holds(abs(report["porosity"] - 0.7) <= 4 / 3 * math.pi * 1.3 ** 3 / 2 / 12 ** 3,
          "standing ones count")


def packs_settle(program):
    report, files, said = made(program, "--domain", "box:8,8,8", *SIZES, "--mode", "paper",
                               "--settle", "gravity", "--young", "2e8", "--threads", "1",
                               "--frames", "2:grow.png")
    settled = report["front"]["settle"]
    equal((report["audit"]["passed"], report["audit"]["limit"]), (True, 0.01), said)
    holds(settled["rest"] and settled["kinetic_per_mgr"] < 1e-4, settled)
    particles = rows(files["pack.csv"])
    holds(0 < overlap(particles) < 0.01, "held up by contacts")
    equal(report["options"]["settle"]["young"], 2e8, "forces in the report")
    equal(files["grow.png"][:8], b"\x89PNG\r\n\x1a\n", "frames")
    grown, files, _ = made(program, "--domain", "box:8,8,8", *SIZES, "--mode", "paper")
    equal(len(rows(files["pack.csv"])), len(particles), "the same particles")
    holds(sum(p["z"] for p in particles) < sum(p["z"] for p in rows(files["pack.csv"])), "fell")


def the_growth_is_drawn(program):
    for direction in ("outward", "inward"):
        _, files, _ = made(program, *FLAT, "--direction", direction, "--frames", "4:grow.svg")
        holds(files["grow.svg"].rstrip().endswith(b"</svg>"), "SVG")
    _, files, _ = made(program, *BOX, "--frames", "grow.png", "--loosen", "shrink",
                       "--target-porosity", "0.95")
    equal(files["grow.png"][:8], b"\x89PNG\r\n\x1a\n", "PNG")


def methods_of_the_paper(program):
    arguments = ["--domain", "box:10,10,10", *SIZES, "--mode", "paper"]
    seen = set()
    for first, then in itertools.product(("random", "fifo", "lifo"), repeat=2):
        report, files, _ = made(program, *arguments, "--select", "%s,%s" % (first, then))
        equal((report["options"]["select"], report["audit"]["passed"]), ([first, then], True),
              "select")
        seen.add(files["pack.csv"])
    equal(len(seen), 9, "nine ways")
    for contact in ("wrappers", "potential", "binary", "direct"):
        report, files, _ = made(program, *arguments, "--contact", contact)
        equal((report["options"]["contact"], report["audit"]["passed"]), (contact, True),
              "contact")
        holds(report["volume_fraction"] > 0.25, "%s: %g" % (contact, report["volume_fraction"]))


def containers_of_every_kind(program):
    for spec in ("box:9,9,9+periodic", "box:9,9,9+periodic:xy", "box:9,9,9+at:1,2,3",
                 "cylinder:5,9", "cylinder:5,9,axis=x", "tube:4,12,16", "cone:2,6,9",
                 "silo:5,14,2,5", "sphere:6", "rect:16,12+periodic:x", "circle:9",
                 "annulus:5,15", "rect:16,12+periodic"):
        for mode in MODES:
            report, _, said = made(program, "--domain", spec, *SIZES, "--mode", mode,
                                   "--threads", "1", files=("pack.csv", "pack.png"))
            equal((report["audit"]["passed"], said), (True, ""), "%s %s" % (spec, mode))
            least = 0.55 if report["dim"] == 2 else 0.22 if mode == "paper" else 0.36
            holds(least < report["volume_fraction"] < 0.91,
                  "%s %s: %g" % (spec, mode, report["volume_fraction"]))


def stops_when_told(number):
    """What stands is a pack: it is audited and written."""
    def test(program):
        with Folder(program) as folder:
            run = subprocess.Popen([program, "--domain", "box:400,400,400", *SIZES, "--out",
                                    "pack.csv", "--report", "report.json"], cwd=folder.path,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE)
            time.sleep(1)
            equal(run.poll(), None, "still at work")
            run.send_signal(number)
            out, err = run.communicate(timeout=90)
            equal((run.returncode, out), (INTERRUPTED, b""), "exit code, output: %s" % err)
            equal(sorted(os.listdir(folder.path)), ["pack.csv", "report.json"], "files")
            report = strict(folder.read("report.json"))
            lines = folder.read("pack.csv").decode().splitlines()
            said = notes(folder.read("pack.csv"))
        equal((report["audit"]["passed"], report["front"]["state"]), (True, "interrupted"),
              "audited")
        equal(said["placed"], "interrupted", "note")
        equal(sum(not line.startswith("#") for line in lines) - 1, report["particles"], "rows")
        holds(b"%d particles" % report["particles"] in err, err)
    return test


def report_has_every_key(program):
    report, _, _ = made(program, *BOX, "--count", "20")
    equal(list(report)[:5], ["program", "version", "command", "options", "input"], "keys")
    equal(list(report["front"]), [
        "state", "standing", "placed", "attempts", "on_front", "placed_volume_fraction",
        "loosened_volume_fraction", "components", "grades", "list", "settle"], "front")
    holds(0 < report["front"]["on_front"] <= 20, "on_front")
    holds(abs(report["front"]["placed_volume_fraction"] / report["volume_fraction"] - 1) < 1e-12,
          "fraction")


def help_mentions_every_option(program):
    with Folder(program) as folder:
        result = folder.run("--help")
        equal((result.code, result.err), (DONE, ""), "exit code, standard error")
        text = result.out.decode()
        for name in ("domain psd density count mass target-porosity list grade in frame sort "
                     "radius-array diameter-array dim mode direction contact select stock trace "
                     "loosen settle settle-time rest-tolerance frames gravity rotations "
                     "friction slip-velocity young poisson damping pull drag near-field "
                     "disc-mass arm walls dt seed stream threads isa out report max-overlap "
                     "plot-sizes colour quiet version help").split():
            holds(re.search(r"--%s\b" % name, text), name)
        holds("audited" in text.split("130")[1], "what an interruption leaves")
        holds(max(map(len, text.splitlines())) <= 90, "width")


main([(test.__name__.replace("_", " "), test) for test in (
    spheres_fill_a_box, discs_fill_a_rectangle, papers_coordination_is_exact,
    any_machine_makes_the_same_bytes, seed_and_stream_change_the_pack, amounts_are_met,
    what_cannot_fit_is_counted, less_than_asked_is_said, looser_packs,
    lists_are_placed_exactly, lists_count_what_is_left, lists_go_by_mass, grades_by_place,
    mixtures_tell_their_parts, particles_stand_in_the_way, packs_settle, the_growth_is_drawn,
    methods_of_the_paper, containers_of_every_kind, report_has_every_key,
    help_mentions_every_option)] + [
        ("stops at SIGINT", stops_when_told(signal.SIGINT)),
        ("stops at SIGTERM", stops_when_told(signal.SIGTERM))])
