# SPDX-License-Identifier: GPL-3.0-or-later
"""What packing-layers makes: packs, statistics, numbered files, one sheet, exit codes."""
import csv
import json
import math
import os
import re
import signal
import statistics
import subprocess
import time
from cli import DONE, INTERRUPTED, SHORT, Folder, equal, holds, main

# One thread: packs this small gain nothing by two, least of all on a machine that is busy.
FLAT = ["--domain", "rect:0.3,0.15", "--psd", "mono:0.01", "--threads", "1"]
DEEP = ["--domain", "box:0.2,0.2,0.15", "--psd", "uniform:0.015,0.02", "--threads", "1"]
QUICK = ["--layer-end", "time", "--layer-time", "0.4"]


def strict(text):
    """JSON without NaN and infinity."""
    def refuse(word):
        raise AssertionError(word + " in the report")
    return json.loads(text, parse_constant=refuse)


def rows(text):
    lines = [line for line in text.decode().splitlines() if not line.startswith("#")]
    return [{k: float(v) for k, v in row.items()} for row in csv.DictReader(lines)]


def made(program, *arguments, code=DONE, files=("pack.csv",)):
    """Runs and returns the report, the files' bytes and what was said."""
    with Folder(program) as folder:
        outs = [word for name in files for word in ("--out", name)]
        result = folder.run(*arguments, *outs)
        equal(result.code, code, "exit code (%s)" % result.err)
        return (strict(result.out), {name: folder.read(name) for name in result.files},
                result.err)


def area_below(y, r, height):
    """Of a disc cut at a height."""
    h = min(max((height - y) / r, -1), 1)
    return r * r * (math.pi - math.acos(h) + h * math.sqrt(1 - h * h))


def discs_fill_a_rectangle(program):
    report, files, _ = made(program, *FLAT, *QUICK)
    particles = rows(files["pack.csv"])
    equal(report["audit"]["passed"], True, "audit")
    equal(report["audit"]["limit"], 0.01, "limit")
    equal(report["layers"]["stopped"], "full", "stopped")
    holds(0.75 < report["volume_fraction"] < 0.9069, report["volume_fraction"])
    equal(len(particles), report["particles"], "rows")
    equal(sum(report["layers"]["particles"]), report["particles"], "particles of layers")
    holds(report["layers"]["bed_height"] >= 0.15, "bed")
    holds(max(p["y"] + p["r"] for p in particles) >= 0.15, "above the height")
    solid = sum(area_below(p["y"], p["r"], 0.15) for p in particles)
    holds(abs(solid / 0.045 / report["volume_fraction"] - 1) < 1e-3, "cut at the height")
    for p in particles:
        holds(-1e-4 <= p["x"] - p["r"] and p["x"] + p["r"] <= 0.3001, "walls")
    steps = round(0.4 / report["layers"]["dt"])
    equal(report["layers"]["steps"], steps * report["layers"]["count"], "steps")
    holds(any(p["vy"] != 0 for p in particles), "velocities")


def every_column_is_full(program):
    """No column of two mean diameters ends below the height; the other rule is laxer."""
    bed, files, _ = made(program, *FLAT, *QUICK)
    tops = [max(p["y"] + p["r"] for p in rows(files["pack.csv"])
                if 0.3 * k / 7 <= p["x"] < 0.3 * (k + 1) / 7) for k in range(7)]
    holds(min(tops) >= 0.15, tops)
    holds(abs(min(tops) - bed["layers"]["bed_height"]) < 1e-12, "bed_height")
    highest, files, _ = made(program, *FLAT, *QUICK, "--full", "highest")
    holds(highest["layers"]["highest"] >= 0.15, "highest")
    holds(highest["layers"]["count"] <= bed["layers"]["count"], "layers")
    holds(highest["volume_fraction"] <= bed["volume_fraction"], "fractions")


def spheres_come_to_rest(program):
    report, files, said = made(program, *DEEP, files=("pack.csv", "pack.vtp", "pack.data",
                                                      "pack.png"))
    equal(report["audit"]["passed"], True, "audit")
    holds(0.45 < report["volume_fraction"] < 0.66, report["volume_fraction"])
    equal(report["layers"]["end"], ["rest"] * report["layers"]["count"], said)
    equal(report["layers"]["ended_by_time"], 0, "capped")
    holds(report["layers"]["kinetic_per_mgr"] < 1e-4, "rest")
    holds(report["psd"]["ks"] < report["psd"]["ks_limit"] * 1.3, "sizes are kept")
    z_hi = float(re.search(r"^\S+ (\S+) zlo zhi", files["pack.data"].decode(), re.M)[1])
    tops = [p["z"] + p["r"] for p in rows(files["pack.csv"])]
    holds(z_hi >= max(tops) > 0.15, "the file's box holds what is above the height")


def layers_are_laid_as_asked(program):
    report, _, said = made(program, *FLAT, *QUICK, "--layer-density", "0.3",
                           "--layer-height", "0.05", "--max-layers", "2", code=SHORT)
    equal(report["layers"]["count"], 2, "layers")
    half = math.pi * 0.01 ** 2 / 2 / 0.015
    for density in report["layers"]["density"]:
        holds(abs(density - 0.3) <= half, density)
    equal(report["layers"]["stopped"], "most layers", "stopped")
    holds("--max-layers" in said and "of 0.15" in said, said)


def layers_may_start_in_the_bed(program):
    lower, low_files, _ = made(program, *FLAT, *QUICK, "--layer-start", "bed")
    higher, high_files, _ = made(program, *FLAT, *QUICK)
    half = math.pi * 0.01 ** 2 / 2 / 0.015
    for density in lower["layers"]["density"]:  # the bed takes some of the room
        holds(0.2 < density <= 0.4 + half, density)
    equal((lower["audit"]["passed"], lower["layers"]["stopped"]), (True, "full"), "pack")
    equal(lower["options"]["layer_start"], "bed", "option")
    equal(higher["options"]["layer_start"], "highest", "default")
    holds(low_files != high_files, "another pack")


def saturated_layers_are_said(program):
    report, _, said = made(program, *FLAT, *QUICK, "--layer-density", "0.53")
    holds("no further particle fits" in said and "of the 0.53 asked" in said, said)
    equal(len(said.splitlines()), 1, "said once")
    holds(report["layers"]["saturated"] > 0, "saturated")
    equal(made(program, *FLAT, *QUICK, "--layer-density", "0.53", "--quiet")[2], "", "quiet")


def a_layer_without_rest_ends(program):
    report, _, said = made(program, *FLAT, "--rest-tolerance", "1e-300", "--layer-time",
                           "0.2", "--layer-time-max", "0.3")
    holds("--layer-time-max" in said and len(said.splitlines()) == 1, said)
    equal(report["layers"]["ended_by_time"], report["layers"]["count"], "ended by time")
    for seconds in report["layers"]["time"]:
        holds(abs(seconds - 0.3) < 1e-3, seconds)


def any_machine_makes_the_same_bytes(program):
    arguments = [*DEEP, *QUICK, "--max-layers", "2", "--quiet"]
    outs = ("pack.csv", "pack.vtp", "pack.data")
    with Folder(program) as folder:
        sets = [name for name in ("avx2", "avx512")
                if folder.run("--isa", name, *FLAT, *QUICK, "--layer-time", "0.001",
                              "--max-layers", "1", "--quiet").code == SHORT]
    _, first, _ = made(program, *arguments, "--threads", "1", "--isa", "baseline",
                       code=SHORT, files=outs)
    for more in (["--threads", "2"], *(["--isa", name] for name in sets)):
        _, again, _ = made(program, *arguments, *more, code=SHORT, files=outs)
        for name in first:
            holds(first[name] == again[name], "%s differs with %s" % (name, more))


def numbers(value, path=()):
    """(path, number or None) of each leaf that is a number or null."""
    if isinstance(value, dict):
        for key, below in value.items():
            yield from numbers(below, path + (key,))
    elif value is None or isinstance(value, (int, float)) and not isinstance(value, bool):
        yield path, value


def leaf(value, path):
    for key in path:
        value = value[key]
    return value


def statistics_are_right(whole, packs):
    seen = 0
    for path, mean in numbers(whole["mean"]):
        values = [leaf(pack, path) for pack in packs]
        sd, cv = leaf(whole["sd"], path), leaf(whole["cv"], path)
        if None in values:
            equal((mean, sd, cv), (None, None, None), path)
            continue
        wanted = statistics.mean(values)
        holds(math.isclose(mean, wanted, rel_tol=1e-12), path)
        if len(packs) == 1:
            equal((sd, cv), (None, None), path)
            continue
        deviation = statistics.stdev(values)
        holds(math.isclose(sd, deviation, rel_tol=1e-6, abs_tol=1e-12 * abs(wanted)), path)
        if wanted:
            holds(math.isclose(cv, sd / mean, rel_tol=1e-12, abs_tol=1e-300), path)
        seen += 1
    return seen


SHARED = {"seed", "threads", "dim"}


def packs_have_statistics(program):
    report, files, _ = made(program, *FLAT, *QUICK, "--packs", "3", "--sheet", "all.png",
                            files=("pack.csv",))
    equal(sorted(files), ["all.png", "pack-1.csv", "pack-2.csv", "pack-3.csv"], "files")
    equal(len(report["packs"]), 3, "packs")
    holds(statistics_are_right(report, report["packs"]) > 25, "numbers with statistics")
    numeric = {path for path, _ in numbers(report["packs"][0])
               if path[0] not in SHARED | {"options", "input"}}
    equal({path for path, _ in numbers(report["mean"])}, numeric, "keys of the mean")
    for number, pack in enumerate(report["packs"]):
        equal(pack["options"]["stream"], number, "stream")
        equal(len(rows(files["pack-%d.csv" % (number + 1)])), pack["particles"], "rows")
    holds(len({p["volume_fraction"] for p in report["packs"]}) == 3, "different packs")
    equal(files["all.png"][:8], b"\x89PNG\r\n\x1a\n", "sheet")


def sets_have_statistics(program):
    report, files, _ = made(program, *FLAT, *QUICK, "--layer-time", "0.2", "--packs", "2",
                            "--sets", "2", "--sheet", "all.svg")
    equal(sorted(files), ["all.svg", *("pack-%d-%d.csv" % (s, p) for s in (1, 2)
                                       for p in (1, 2))], "files")
    packs = [pack for group in report["sets"] for pack in group["packs"]]
    equal([pack["options"]["stream"] for pack in packs], [0, 1, 1000, 1001], "streams")
    for group in report["sets"]:
        statistics_are_right(group, group["packs"])
    statistics_are_right(report, packs)
    statistics_are_right(report["set_means"], [group["mean"] for group in report["sets"]])
    holds("packs" not in report, "packs stand in their sets")
    holds(files["all.svg"].rstrip().endswith(b"</svg>"), "sheet")


def a_pack_alone_is_the_same(program):
    arguments = [*FLAT, *QUICK, "--layer-time", "0.2"]
    _, files, _ = made(program, *arguments, "--packs", "2", "--sets", "2")
    for name, stream in (("pack-1-2.csv", "1"), ("pack-2-1.csv", "1000")):
        _, alone, _ = made(program, *arguments, "--stream", stream)
        holds(alone["pack.csv"] == files[name], name)
    _, other, _ = made(program, *arguments, "--seed", "2")
    holds(other["pack.csv"] != files["pack-1-1.csv"], "seed")


def containers_of_every_kind(program):
    """Those with an open top are filled; closed ones take what finds room."""
    kinds = {
        "box:0.2,0.2,0.1": "full", "box:0.2,0.2,0.1+periodic:xy": "full",
        "cylinder:0.1,0.1+at:1,2,3": "full", "tube:0.05,0.15,0.1": "full",
        "cone:0.05,0.12,0.12": "full", "silo:0.1,0.2,0.04,0.1": "full",
        "sphere:0.1": "no room", "cylinder:0.08,0.2,axis=x": "no room",
        "rect:0.2,0.1+periodic:x": "full", "circle:0.12": "no room",
        "annulus:0.05,0.15": "no room",
    }
    for spec, stopped in kinds.items():
        report, files, _ = made(program, "--domain", spec, "--psd", "mono:0.02", *QUICK,
                                "--threads", "1", "--layer-time", "0.3", "--layer-height", "0.05", "--quiet",
                                files=("pack.csv", "pack.png"))
        equal(report["layers"]["stopped"], stopped, spec)
        equal(report["audit"]["passed"], True, spec)
        flat = report["dim"] == 2
        holds((0.55 if flat else 0.25) < report["volume_fraction"] < (0.91 if flat else 0.68),
              "%s: %g" % (spec, report["volume_fraction"]))


def options_reach_the_stepper(program):
    """Each of these changes the pack, and the report tells it."""
    arguments = [*FLAT, *QUICK, "--layer-time", "0.1", "--max-layers", "2", "--dt", "5e-5"]
    _, usual, _ = made(program, *arguments, code=SHORT)
    for name, value in (("rotations", "off"), ("friction", "0.5"), ("gravity", "1"),
                        ("gravity", "0.5,-2"), ("young", "2e7"), ("poisson", "0.4"),
                        ("density", "2000"), ("damping", "0.3"), ("drag", "0.01"),
                        ("near-field", "0,0,1e-4,1,0.04"), ("disc-mass", "on"),
                        ("slip-velocity", "0.1"), ("pull", "on"), ("arm", "radius"),
                        ("walls", "material"), ("dt", "2e-5"), ("layer-time", "0.2"),
                        ("layer-height", "0.06"), ("layer-density", "0.2")):
        if name == "density":  # without drag only the ratio of stiffness to weight counts
            arguments_of = [*arguments, "--drag", "0.001"]
        else:
            arguments_of = arguments
        report, files, _ = made(program, *arguments_of, "--" + name, value, code=SHORT)
        holds(rows(files["pack.csv"]) != rows(usual["pack.csv"]), "--%s %s" % (name, value))
        told = report["options"][name.replace("-", "_")]
        wanted = {"on": True, "off": False}.get(value, value)
        if name == "gravity":
            wanted = [0, -1] if value == "1" else [0.5, -2]
        elif name == "near-field":
            wanted = [0, 0, 1e-4, 1, 0.04]
        elif isinstance(wanted, str) and wanted[0].isdigit():
            wanted = float(wanted)
        equal(told, wanted, "option %s in the report" % name)


def examples_are_the_papers(program):
    for name, domain, psd, density in (
            ("5.1", "rect:1,0.5", "mono:0.01", 0.4),
            ("5.2", "rect:1,0.5", "normal:0.01,0.001,0.007,0.013", 0.4),
            ("5.3", "box:1,1,0.5", "mono:0.02", 0.25),
            ("5.4", "box:1,1,0.5", "normal:0.02,0.002,0.014,0.026", 0.25)):
        report, _, _ = made(program, "--example", name, "--max-layers", "1", "--layer-end",
                            "time", "--layer-time", "0.001", "--quiet", code=SHORT, files=())
        told = report["options"]
        equal((told["domain"], told["psd"]), (domain, psd), name)
        wanted = {"height": 0.5, "layer_height": 0.1, "layer_density": density,
                  "density": 1000, "young": 1e8, "poisson": 0.25, "damping": 0.1,
                  "friction": 0.2, "drag": 0.005, "rotations": True, "dt": 1e-4}
        for key, value in wanted.items():
            equal(told[key], value, "%s: %s" % (name, key))
        equal(told["gravity"], [0, -2] if report["dim"] == 2 else [0, 0, -2], "gravity")
        equal(told["layer_time_max"], 0.01, "ten times the layer time")
    report, _, _ = made(program, "--example", "5.1", "--dim", "3", "--height", "0.3",
                        "--psd", "mono:0.05", "--max-layers", "1", "--layer-end", "time",
                        "--layer-time", "0.001", "--layer-height", "0.2", "--quiet",
                        code=SHORT, files=())
    equal(report["options"]["domain"], "box:1,1,0.3", "dim and height")


def stops_when_told(program):
    with Folder(program) as folder:
        folder.write("pack-1.csv", "old\n")
        run = subprocess.Popen([program, "--example", "5.3", "--packs", "2", "--out",
                                "pack.csv", "--sheet", "all.png"], cwd=folder.path,
                               stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        time.sleep(1)
        equal(run.poll(), None, "still at work")
        run.send_signal(signal.SIGINT)
        out, err = run.communicate(timeout=60)
        equal((run.returncode, out), (INTERRUPTED, b""), "exit code, output")
        holds(b"nothing written" in err, err)
        equal(os.listdir(folder.path), ["pack-1.csv"], "files")
        equal(folder.read("pack-1.csv"), b"old\n", "the old file")


def help_mentions_every_option(program):
    with Folder(program) as folder:
        result = folder.run("--help")
        equal((result.code, result.err), (DONE, ""), "exit code, standard error")
        text = result.out.decode()
        for name in ("example dim domain psd density height layer-height layer-density full "
                     "max-layers layer-start layer-end layer-time layer-time-max rest-tolerance packs "
                     "sets gravity rotations friction slip-velocity young poisson damping "
                     "pull drag near-field disc-mass arm walls dt seed stream threads isa out "
                     "sheet report max-overlap plot-sizes colour quiet version help").split():
            holds(re.search(r"--%s\b" % name, text), name)
        holds(not re.search("--count|--target-porosity", text), "options of others")
        holds(max(map(len, text.splitlines())) <= 90, "width")


main([(test.__name__.replace("_", " "), test) for test in (
    discs_fill_a_rectangle, every_column_is_full, spheres_come_to_rest,
    layers_are_laid_as_asked, layers_may_start_in_the_bed, saturated_layers_are_said, a_layer_without_rest_ends,
    any_machine_makes_the_same_bytes, packs_have_statistics, sets_have_statistics,
    a_pack_alone_is_the_same, containers_of_every_kind, options_reach_the_stepper,
    examples_are_the_papers, stops_when_told, help_mentions_every_option)])
