# SPDX-License-Identifier: GPL-3.0-or-later
"""packing-measure: measure_packs.py MEASURE CLOUD LAYERS. What it reports of packs that are
known, or measured by the program that made them."""
import csv
import json
import math
import os
import re
import signal
import subprocess
import sys
import time
from cli import DONE, INTERRUPTED, Folder, equal, holds, main

CLOUD, LAYERS = (os.path.abspath(path) for path in sys.argv[2:4])

COMMON = ["program", "version", "command", "options", "input", "seed", "threads", "dim",
          "particles", "domain_volume", "solid_volume", "volume_fraction", "porosity",
          "void_ratio", "volume_fraction_inner", "coordination", "fabric", "audit", "psd"]
FABRIC = ["eigenvalues", "sd", "tensor", "contacts", "noise_floor"]
MEASURES = {
    "audit": ["min_gap", "gap_i", "gap_j", "overlaps", "overlap_i", "overlap_j", "protrusions",
              "protrusion_i", "duplicates", "bad_numbers"],
    "contacts": ["pairs", "walls"],
    "classes": ["degree", "supported", "non_stable", "stable", "firm", "non_stable_share",
                "stable_share", "firm_share"],
    "wall_fabric": FABRIC, "orientations": FABRIC, "bonds": ["gap", "count"],
    "normals": ["z_lo", "z_hi", "azimuth_lo", "azimuth_hi", "count"],
    "order": ["neighbours", "isolated", "q4", "q6", "structures", "psi6"],
    "radial_distribution": ["r_max", "mean_diameter", "centres", "margin", "density",
                            "peak_r", "r", "g", "cumulative"],
    "profiles": None, "sections": None,
    "map": ["nx", "ny", "nz", "mean", "sd", "min", "max", "error"],
    "pores": ["pores", "constrictions", "mean_coordination", "min_r", "mean_r", "max_r",
              "min_constriction_r", "mean_constriction_r", "max_constriction_r", "blocked",
              "cut", "closed_constrictions", "open_constrictions", "distribution"],
    "sizes": ["min_r", "max_r", "mean_r", "curve", "sieves", "errors", "tests",
              "components"],
}


def strict(text):
    def refuse(word):
        raise AssertionError(word + " in the report")
    return json.loads(text, parse_constant=refuse)


def rows(text):
    lines = [line for line in text.decode().splitlines() if not line.startswith("#")]
    return [{k: float(v) for k, v in row.items()} for row in csv.DictReader(lines)]


def table(particles, note=None, columns="x,y,z,r"):
    lines = ["# domain: " + note] if note else []
    return "\n".join([*lines, columns, *(",".join("%.17g" % v for v in p) for p in particles),
                      ""])


def measured(program, text, *arguments, name="p.csv", files=()):
    """The report of a pack that stands in a file, and the files made."""
    with Folder(program) as folder:
        folder.write(name, text)
        result = folder.run("--in", name, *arguments)
        equal(result.code, DONE, "exit code (%s)" % result.err)
        equal(result.files, sorted([name, *files]), "files")
        return strict(result.out), {f: folder.read(f) for f in files}, result.err


def near(got, wanted, slack, what):
    holds(abs(got - wanted) <= slack, "%s: %.17g instead of %.17g" % (what, got, wanted))


SQRT2, SQRT3 = math.sqrt(2), math.sqrt(3)
# Unit cells of touching spheres of radius 1/2: edges, centres in edges, density, contacts,
# eigenvalues, Q4 and Q6 of the contacts.
THIRD = [1 / 3] * 3
LATTICES = {
    "sc": ((1, 1, 1), [(0, 0, 0)], math.pi / 6, 6, THIRD, .763763, .353553),
    "bcc": ((2 / SQRT3,) * 3, [(0, 0, 0), (.5, .5, .5)], math.pi * SQRT3 / 8, 8, THIRD,
            .509175, .628539),
    "fcc": ((SQRT2,) * 3, [(0, 0, 0), (.5, .5, 0), (.5, 0, .5), (0, .5, .5)],
            math.pi / (3 * SQRT2), 12, THIRD, .190941, .574524),
    "hcp": ((1, SQRT3, math.sqrt(8 / 3)),
            [(0, 0, 0), (.5, .5, 0), (.5, 1 / 6, .5), (0, 2 / 3, .5)],
            math.pi / (3 * SQRT2), 12, THIRD, .097222, .484762),
    "simple hexagonal": ((1, SQRT3, 1), [(0, 0, 0), (.5, .5, 0)], math.pi / (3 * SQRT3), 8,
                         [3 / 8, 3 / 8, 1 / 4], .531250, .504012),
}


def lattice_text(name):
    edges, places = LATTICES[name][:2]
    return table([tuple(e * (p + .1) for e, p in zip(edges, place)) + (0.5,)
                  for place in places],
                 "box:%.17g,%.17g,%.17g+periodic" % edges)


def lattices_have_their_numbers(program):
    """One unit cell each, with all its images."""
    for name, (_, places, density, contacts, eigenvalues, q4, q6) in LATTICES.items():
        report, _, _ = measured(program, lattice_text(name), "--order", "1.000001")
        near(report["volume_fraction"], density, 1e-12, name)
        equal(report["particles"], len(places), name)
        near(report["coordination"]["mean"], contacts, 1e-12, name + " contacts")
        equal(report["coordination"]["rattlers"], 0, name)
        equal(report["audit"]["passed"], True, name)
        for got, wanted in zip(report["fabric"]["eigenvalues"], eigenvalues):
            near(got, wanted, 1e-12, name + " fabric")
        order = report["measures"]["order"]
        near(order["q4"]["global"], q4, 1e-6, name + " Q4")
        near(order["q6"]["global"], q6, 1e-6, name + " Q6")
        near(order["q6"]["mean"], q6, 1e-6, name + " local q6")
    report, _, _ = measured(program, lattice_text("fcc"))
    equal(report["measures"]["order"]["structures"],
          {"other": 0, "fcc": 4, "hcp": 0, "bcc": 0, "icosahedral": 0}, "structures")


def discs_have_their_numbers(program):
    text = table([(0, 0, .5), (.5, SQRT3 / 2, .5)], "rect:1,%.17g+periodic" % SQRT3, "x,y,r")
    report, _, _ = measured(program, text, "--pores")
    equal(report["dim"], 2, "dim")
    near(report["volume_fraction"], math.pi / (2 * SQRT3), 1e-12, "density")
    equal(report["coordination"]["mean"], 6, "contacts")
    near(report["fabric"]["eigenvalues"][1], .5, 1e-12, "fabric")
    equal(len(report["fabric"]["tensor"]), 2, "rows of the tensor")
    psi = report["measures"]["order"]["psi6"]
    near(psi["mean"], 1, 1e-9, "psi6")
    near(psi["global"], 1, 1e-9, "psi6")
    equal(psi["six_neighbours_share"], 1, "share")
    near(report["measures"]["pores"]["min_r"], 1 / SQRT3 - .5, 1e-9, "pore")


NETWORK = ["n-pores.csv", "n-constrictions.csv", "n.vtp", "n_node1.dat", "n_node2.dat",
           "n_link1.dat", "n_link2.dat"]


def pores_of_the_cubic_lattice(program):
    """Three by three cells; its pores and constrictions are those of a cube and a square."""
    centres = [(x + .5, y + .5, z + .5, .5) for x in range(3) for y in range(3)
               for z in range(3)]
    report, files, _ = measured(program, table(centres, "box:3,3,3+periodic"),
                                "--pore-network", "n",
                                files=NETWORK)
    pores = report["measures"]["pores"]
    for end in ("min_r", "max_r"):
        near(pores[end], (SQRT3 - 1) / 2, 1e-9, end)
    near(pores["max_constriction_r"], (SQRT2 - 1) / 2, 1e-9, "constriction")
    lines = files["n-pores.csv"].decode().splitlines()
    equal(len(lines), 1 + pores["pores"], "rows of pores")
    lines = files["n-constrictions.csv"].decode().splitlines()
    equal(len(lines), 1 + pores["constrictions"], "rows of constrictions")
    equal(len(files["n_node2.dat"].splitlines()), pores["pores"], "nodes")
    share = pores["distribution"]["share"]
    equal((share[0], share[-1], len(share)), (0, 1, len(pores["distribution"]["pore_r"])),
          "shares")


def report_has_every_key(program):
    text = lattice_text("fcc")
    report, _, _ = measured(program, text)
    equal(list(report), [*COMMON, "measures", "time", "rate"], "keys")
    equal(list(report["fabric"]), FABRIC, "fabric")
    equal(list(report["measures"]), list(MEASURES), "measures")
    for key in ("normals", "radial_distribution", "map", "pores"):
        equal(report["measures"][key], None, key)
    equal((report["measures"]["profiles"], report["measures"]["sections"]), ([], []), "lists")
    equal((report["seed"], report["psd"]["ks"]), (None, None), "what does not apply")
    report, _, _ = measured(program, text, "--pores", "--rdf", "2,20", "--normals", "6",
                            "--map", "2,2,2", "--psd", "mono:0.5")
    for key, below in MEASURES.items():
        if below:
            equal(list(report["measures"][key]), below, key)


def made_and_measured(make, *arguments, more=(), code=DONE):
    """Both reports of one pack: the maker's, and ours of its file."""
    def test(program):
        with Folder(make) as folder:
            result = folder.run(*arguments, "--out", "pack.csv", "--report", "made.json")
            equal(result.code, code, "exit code of the maker (%s)" % result.err)
            folder.program = program
            result = folder.run("--in", "pack.csv", *more, "--quiet")
            equal((result.code, result.err), (DONE, ""), "exit code, standard error")
            made, ours = strict(folder.read("made.json")), strict(result.out)
        for key in ("dim", "particles", "domain_volume", "solid_volume", "volume_fraction",
                    "porosity", "void_ratio", "volume_fraction_inner", "coordination",
                    "fabric", "audit"):
            equal(ours[key], made[key], key)
        made["psd"]["unplaced"] = None
        equal(ours["psd"], made["psd"], "psd")
    return test


MIXED = ["--domain", "cylinder:2,5", "--psd", "0.5*lognormal:0.2,0.3,0.1,0.4+0.5*mono:0.1",
         "--count", "300"]


def unlike_audits_are_told(program):
    """Exit status 0, and the report says that the pack fails."""
    text = table([(1, 1, 1, .5), (1.9, 1, 1, .5), (3.8, 1, 1, .5)], "box:4,4,4")
    report, _, said = measured(program, text)
    equal(report["audit"]["passed"], False, "passed")
    near(report["audit"]["max_overlap"], .2, 1e-12, "overlap")
    near(report["audit"]["max_protrusion"], .6, 1e-12, "protrusion")
    holds("FAILED" in said and "1 overlap, the largest of particles 0 and 1" in said, said)
    holds("1 sticks out, particle 2" in said, said)
    found = report["measures"]["audit"]
    near(found["min_gap"], -.2, 1e-12, "gap")
    equal([found[k] for k in list(found)[1:]], [0, 1, 1, 0, 1, 1, 2, 0, 0], "audit")
    report, _, _ = measured(program, table([(1, 1, 1, .5)] * 2 + [(2.5, 1, 1, .5)], "box:4,4,4"))
    equal(report["measures"]["audit"]["duplicates"], 1, "duplicates")
    report, _, _ = measured(program, table([(1, 1, 1, .5), (2.5, 1, 1, .5)], "box:4,4,4"))
    near(report["measures"]["audit"]["min_gap"], 1, 1e-12, "gap")
    equal(report["measures"]["audit"]["overlap_i"], None, "no overlap")


def container_comes_from_where_it_is_told(program):
    particles = [(1, 1, 1, .5), (2, 1, 1, .5)]
    report, _, said = measured(program, table(particles, "box:4,4,4"), "--domain", "sphere:9")
    near(report["domain_volume"], 4 / 3 * math.pi * 729, 1e-9, "--domain wins")
    holds("as p.csv says" not in said, said)
    report, _, said = measured(program, table(particles, "cylinder:3,5"))
    near(report["domain_volume"], 45 * math.pi, 1e-9, "a note")
    holds("cylinder:3,5, as p.csv says" in said, said)
    xyz = ('2\nLattice="4 0 0 0 4 0 0 0 4" Origin="0 0 0" Properties=species:S:1:pos:R:3:'
           'radius:R:1 pbc="T T F"\nX 1 1 1 .5\nX 2 1 1 .5\n')
    report, _, said = measured(program, xyz, name="p.xyz")
    equal(report["options"]["domain"], "box:4,4,4+periodic:xy", "extended XYZ")
    data = ("pack\n\n2 atoms\n1 atom types\n\n0 4 xlo xhi\n0 4 ylo yhi\n0 4 zlo zhi\n\n"
            "Atoms # sphere\n\n1 1 1 1000 1 1 1\n2 1 1 1000 2 1 1\n")
    report, _, said = measured(program, data, name="p.data")
    equal(report["options"]["domain"], "box:4,4,4", "LAMMPS data")
    holds("taken as walls" in said, said)
    dump = ("ITEM: TIMESTEP\n5\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS pp ff ff\n0 4\n"
            "0 4\n0 4\nITEM: ATOMS id type radius x y z\n1 1 0.5 2 2 2\n")
    report, _, _ = measured(program, dump + dump.replace("2 2 2", "1 2 2"), "--frame", "0",
                            name="p.dump")
    equal(report["options"]["domain"], "box:4,4,4+periodic:x", "a dump")
    equal(report["options"]["frame"], 0, "frame")


def lists_agree_with_brute_force(program):
    with Folder(CLOUD) as folder:
        folder.run(*MIXED, "--out", "pack.csv", "--report", "r.json")
        text = folder.read("pack.csv")
    p = rows(text)
    report, files, _ = measured(program, text.decode(), "--tolerance", "0.05", "--contacts",
                                "c.csv", "--bonds", "0.03:b.csv", files=("b.csv", "c.csv"))
    wanted = [set(), set()]
    for i, a in enumerate(p):
        for j in range(i):
            b = p[j]
            gap = math.dist((a["x"], a["y"], a["z"]), (b["x"], b["y"], b["z"])) \
                - a["r"] - b["r"]
            if gap <= .05 * (a["r"] + b["r"]):
                wanted[0].add((j, i))
            if gap <= .03:
                wanted[1].add((j, i))
    for name, pairs in zip(("c.csv", "b.csv"), wanted):
        found = [row for row in rows(files[name]) if row["j"] >= 0]
        equal({(int(row["i"]), int(row["j"])) for row in found}, pairs, name)
        for row in found:
            near(math.hypot(row["nx"], row["ny"], row["nz"]), 1, 1e-12, "normal")
    equal(report["measures"]["contacts"]["pairs"], len(wanted[0]), "pairs")
    equal(report["measures"]["bonds"], {"gap": .03, "count": len(wanted[1])}, "bonds")
    degrees = report["measures"]["classes"]
    equal(sum(degrees["degree"]), 300, "degrees")
    equal(degrees["non_stable"] + degrees["stable"] + degrees["firm"], 300, "classes")


def orders_of_each(program):
    """The list has the means that the report tells; an order counts where it stands."""
    report, files, _ = measured(program, lattice_text("hcp"), "--order-list", "o.csv",
                                files=["o.csv"])
    lines = files["o.csv"].decode().splitlines()
    equal(lines[0], "i,q4,q4_averaged,w4,q6,q6_averaged,w6,structure", "header")
    equal(len(lines), 1 + report["particles"], "lines")
    for i, line in enumerate(lines[1:]):
        number, q4, _, _, q6, averaged, _, structure = line.split(",")
        equal((number, structure), (str(i), "hcp"), "particle")
        near(float(q4), LATTICES["hcp"][5], 1e-6, "q4")
        near(float(q6), LATTICES["hcp"][6], 1e-6, "q6")
        holds(0 < float(averaged) <= float(q6) + 1e-12, "averaged")
    _, files, _ = measured(program, lattice_text("hcp"), "--order", "nearest:12",
                           "--order-list", "o.csv", files=["o.csv"])
    holds(b"structure" not in files["o.csv"], "structures of the nearest")
    flat = table([(0, 0, .5), (.9, .1, .5), (.1, 1, .5), (2, 2, .4)], "rect:3,3", "x,y,r")
    report, files, _ = measured(program, flat, "--order-list", "o.csv", files=["o.csv"])
    psi = rows(files["o.csv"])
    equal([row["neighbours"] for row in psi], [2, 1, 1, 0], "neighbours")
    order = report["measures"]["order"]["psi6"]
    near(sum(row["psi6"] for row in psi) / 4, order["mean"], 1e-12, "mean")
    near(math.hypot(sum(row["psi6_re"] for row in psi), sum(row["psi6_im"] for row in psi)) / 4,
         order["global"], 1e-12, "global")
    turn = [6 * math.atan2(.1, .9), 6 * math.atan2(1, .1)]
    near(psi[1]["psi6_re"], math.cos(turn[0]), 1e-12, "one bond")
    near(psi[0]["psi6_im"], (math.sin(turn[0]) + math.sin(turn[1])) / 2, 1e-12, "two bonds")


def void_adds_up(program):
    """Profiles and maps hold the whole container; sections of the cubic lattice are known."""
    centres = [(x + .5, y + .5, z + .5, .5) for x in range(4) for y in range(4)
               for z in range(4)]
    report, files, _ = measured(
        program, table(centres, "box:4,4,4"), "--profile", "z,7", "--profile", "radius",
        "--profile", "sphere,9", "--map", "3,2,5:m.csv", "--section", "z=0.5",
        "--section", "x,8", files=("m.csv",))
    void = 1 - math.pi / 6
    found = report["measures"]
    equal([p["along"] for p in found["profiles"]], ["z", "radius", "sphere"], "along")
    for profile in found["profiles"]:
        near(profile["porosity"], void, 1e-9, profile["along"])
    equal([len(p["porosities"]) for p in found["profiles"]], [7, 50, 9], "bins")
    near(found["map"]["mean"], void, 1e-9, "map")
    cells = rows(files["m.csv"])
    equal(len(cells), 30, "cells")
    near(sum(c["solid"] for c in cells), 64 * math.pi / 6, 1e-8, "solid of all cells")
    near(found["sections"][0]["planes"][0]["occupation_ratio"], 1 - math.pi / 4, 1e-12,
         "section through centres")
    near(found["sections"][0]["planes"][0]["image_occupation_ratio"], 1 - math.pi / 4, 3e-3,
         "its image")
    equal([plane["height"] for plane in found["sections"][1]["planes"]],
          [.25 + .5 * k for k in range(8)], "heights")
    near(found["sections"][1]["mean"], 1 - math.pi * .1875, 1e-9, "r^2 = 1/4 - 1/16")


def sieves_and_errors(program):
    """Ten spheres of diameter 1 and one of 2: masses 10 and 8, asked half and half."""
    text = table([(3 * k, 0, 0, .5) for k in range(10)] + [(0, 9, 0, 1)], "sphere:99")
    for sieves in ("1.5,0.9", "s.txt"):
        with Folder(program) as folder:
            folder.write("p.csv", text)
            folder.write("s.txt", "# openings\n0.9\n\n1.5\n")
            result = folder.run("--in", "p.csv", "--sieves", sieves, "--psd",
                                "discrete:0.5=1,1=1")
            equal(result.code, DONE, result.err)
            sizes = strict(result.out)["measures"]["sizes"]
        found = sizes["sieves"]
        equal(found["opening"], [1.5, .9, 0], "openings")
        for got, wanted in zip(found["retained_placed"], (800 / 18, 1000 / 18, 0)):
            near(got, wanted, 1e-9, "retained")
        for got, wanted in zip(found["retained_asked"], (50, 50, 0)):
            near(got, wanted, 1e-9, "asked")
        near(sizes["errors"]["mae"], (1000 / 18 - 50) / 2, 1e-9, "MAE")
        near(sizes["errors"]["mre"], (50 - 1000 / 18) / 50, 1e-9, "MRE")
        near(sizes["mean_r"], 6 / 11, 1e-15, "mean radius")
        equal(sizes["curve"]["mass_placed"][-1], 1, "curve")


def components_are_told(program):
    with Folder(CLOUD) as folder:
        folder.run(*MIXED, "--out", "pack.csv", "--report", "r.json")
        text = folder.read("pack.csv").decode()
    report, _, _ = measured(program, text, "--psd", MIXED[3])
    parts = report["measures"]["sizes"]["components"]
    equal(len(parts), 2, "components")
    equal(sum(part["count"] for part in parts), 300, "particles")
    for part in parts:
        near(part["mass_asked"], .5, 1e-9, "asked by mass")
        holds(abs(part["number_placed"] - part["number_asked"]) < 4 * part["number_sd"],
              "number")
    tests = report["measures"]["sizes"]["tests"]
    holds(tests["ks_p"] > 1e-4 and tests["chi_square_p"] > 1e-4, "a sample of the law")


PLOTS = ("sizes", "rdf", "coordination", "normals", "profile", "section")


def plots_are_drawn(program):
    text = lattice_text("fcc")
    names = ["a-%s.png" % name for name in PLOTS]
    report, files, _ = measured(program, text, "--plot", "a", files=names)
    for name in names:
        equal(files[name][:8], b"\x89PNG\r\n\x1a\n", name)
    holds(report["measures"]["normals"] and report["measures"]["radial_distribution"],
          "what is drawn is reported")
    names = ["a-%s.svg" % name for name in PLOTS]
    _, files, _ = measured(program, text, "--plot", "a", "--plot-format", "svg", "--psd",
                           "mono:0.5", "--section", "z,5", "--section", "x=99", "--profile",
                           "x", "--profile", "radius-y", files=names)
    for name in names:
        holds(files[name].rstrip().endswith(b"</svg>"), name)
    flat = table([(1, 1, .5), (2, 1, .5)], "rect:4,4", "x,y,r")
    measured(program, flat, "--plot", "a", files=["a-%s.png" % name for name in PLOTS[:-1]])
    lone = table([(1, 1, 1, .5)], "box:2,2,2")
    _, _, said = measured(program, lone, "--plot", "a", "--pores", "--section", "z=9",
                          files=["a-%s.png" % name for name in PLOTS])
    for words in (": 1 sphere of radius 0.5", "coordination     0.000; all are rattlers; 0 contacts",
                  "no neighbours", "pores            none", "z = 9: outside of the container"):
        holds(words in said, said)
    holds("nan" not in said, said)


def one_is_not_many(program):
    """The summary counts as people do."""
    text = table([(1, 1, .4, .5), (1, 1, 1.3, .5)], "box:2,2,2")
    _, _, said = measured(program, text)
    for words in (": 2 spheres of", "1 overlap, the largest", "0 pairs at one place",
                  "1 sticks out", "of 1 random contact "):
        holds(words in said, words + " in " + said)


def a_pack_of_nothing(program):
    report, files, said = measured(program, "# domain: box:1,1,1\nx,y,z,r\n", "--plot", "a",
                                   "--pores", "--map", "1,1,1", "--contacts", "c.csv",
                                   "--bonds", "1:b.csv", "--order-list", "o.csv",
                                   files=["b.csv", "c.csv", "o.csv"] + ["a-%s.png" % n for n in PLOTS])
    equal((report["particles"], report["porosity"]), (0, 1), "nothing but void")
    equal(report["coordination"]["mean"], None, "coordination")
    equal(report["measures"]["map"]["mean"], 1, "map")
    holds("no particles" in said and "nan" not in said, said)


def quiet_says_nothing(program):
    _, _, said = measured(program, lattice_text("sc"), "--quiet")
    equal(said, "", "standard error")
    _, _, said = measured(program, lattice_text("sc"))
    for word in ("container", "audit", "volume fraction", "coordination", "fabric", "order"):
        holds(any(line.startswith(word) for line in said.splitlines()), word)


def any_machine_finds_the_same(program):
    with Folder(CLOUD) as folder:
        folder.run(*MIXED, "--out", "pack.csv", "--report", "r.json")
        text = folder.read("pack.csv").decode()
    found = []
    for more in (["--threads", "1", "--isa", "baseline"], ["--threads", "2"], ["--threads", "5"]):
        report, _, _ = measured(program, text, "--pores", "--rdf", "3", "--profile", "z",
                                "--tolerance", "0.1", "--psd", MIXED[3], *more)
        for key in ("command", "options", "threads", "time", "rate"):
            report.pop(key)
        found.append(report)
    equal(found[1], found[0], "two threads")
    equal(found[2], found[0], "five threads")


def stops_when_told(program):
    """While its input comes slowly through a pipe."""
    with Folder(program) as folder:
        pipe = os.path.join(folder.path, "pipe.csv")
        os.mkfifo(pipe)
        run = subprocess.Popen([program, "--in", "pipe.csv", "--domain", "box:9,9,9",
                                "--contacts", "c.csv"], cwd=folder.path,
                               stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        with open(pipe, "w") as feed:
            feed.write("x,y,z,r\n")
            feed.flush()
            time.sleep(0.5)
            equal(run.poll(), None, "still reading")
            run.send_signal(signal.SIGINT)
            feed.write("1,1,1,1\n")
        out, err = run.communicate(timeout=60)
        equal((run.returncode, out), (INTERRUPTED, b""), "exit code, output")
        holds(b"nothing written" in err, err)
        equal(os.listdir(folder.path), ["pipe.csv"], "files")


def help_mentions_every_option(program):
    with Folder(program) as folder:
        result = folder.run("--help")
        equal((result.code, result.err), (DONE, ""), "exit code, standard error")
        text = result.out.decode()
        for name in ("in domain psd dim frame sort radius-array diameter-array tolerance up "
                     "contacts bonds normals order order-list rdf profile section map pores pore-network "
                     "pore-merge sieves plot plot-format threads isa report max-overlap quiet "
                     "version help").split():
            holds("--" + name in text, name)
        formats = folder.run("--in", "x:y").err.split("known are ")[1].strip().split(", ")
        for name in formats:
            holds(name in re.findall(r"[a-z-]+", text.split("Formats:")[1].split("without")[0]),
                  name)
        holds(max(map(len, text.splitlines())) <= 90, "width")


main([(test.__name__.replace("_", " "), test) for test in (
    lattices_have_their_numbers, discs_have_their_numbers, pores_of_the_cubic_lattice,
    report_has_every_key, unlike_audits_are_told, container_comes_from_where_it_is_told,
    lists_agree_with_brute_force, orders_of_each, void_adds_up, sieves_and_errors, components_are_told,
    plots_are_drawn, one_is_not_many, a_pack_of_nothing, quiet_says_nothing, any_machine_finds_the_same,
    stops_when_told, help_mentions_every_option)] + [
    ("as packing-cloud reported: spheres in a cylinder",
     made_and_measured(CLOUD, *MIXED, more=["--psd", MIXED[3]])),
    ("as packing-cloud reported: a periodic lattice",
     made_and_measured(CLOUD, "--domain", "box:6,6,6+periodic", "--psd", "mono:0.5",
                       "--method", "lattice:sc", more=["--psd", "mono:0.5"])),
    ("as packing-cloud reported: discs",
     made_and_measured(CLOUD, "--domain", "rect:20,10+periodic:x", "--psd",
                       "uniform:0.2,0.5", "--count", "200", more=["--psd",
                                                                 "uniform:0.2,0.5"])),
    ("as packing-cloud reported: a silo that is open",
     made_and_measured(CLOUD, "--domain", "silo:3,9,1,3+open:top", "--psd", "mono:0.3",
                       "--count", "150", more=["--psd", "mono:0.3"])),
    ("as packing-layers reported",
     made_and_measured(LAYERS, "--domain", "rect:0.3,0.06", "--psd", "mono:0.02",
                       "--layer-end", "time", "--layer-time", "0.05", "--layer-height",
                       "0.1", "--height", "0.05",
                       more=["--psd", "mono:0.02", "--max-overlap", "0.01"]))])
