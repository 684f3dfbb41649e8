# SPDX-License-Identifier: GPL-3.0-or-later
"""What the program makes: files, report, determinism, exit codes 0 and 1."""
import csv
import hashlib
import json
import math
import os
import pty
import re
import signal
import subprocess
import sys
import time
from cli import DONE, INTERRUPTED, SHORT, Folder, Skip, equal, holds, main

SAND = os.path.abspath(sys.argv[2])
BOX = ["--domain", "box:4,4,4"]

# Every key of the report, in its order; None where there is nothing below.
KEYS = {
    "program": None, "version": None, "command": None, "options": None, "input": None,
    "seed": None, "threads": None, "dim": None, "particles": None, "domain_volume": None,
    "solid_volume": None, "volume_fraction": None, "porosity": None, "void_ratio": None,
    "volume_fraction_inner": None,
    "coordination": ["mean", "mean_no_rattlers", "rattlers", "histogram", "tolerance"],
    "fabric": ["eigenvalues", "sd", "tensor", "contacts", "noise_floor"],
    "audit": ["max_overlap", "max_protrusion", "limit", "passed"],
    "psd": ["ks", "ks_limit", "ks_mass", "unplaced", "mean_relative_error"],
    "time": ["place", "settle", "measure", "total"],
    "rate": None,
}


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


def made(program, *arguments, code=DONE, files=("pack.csv",)):
    """Runs and returns the report and the files' bytes."""
    with Folder(program) as folder:
        outs = [word for name in files for word in ("--out", name)]
        result = folder.run(*arguments, *outs)
        equal(result.code, code, "exit code (%s)" % result.err)
        names = sorted(name.split(":")[-1] for name in files)
        equal(result.files, names, "files")
        return strict(result.out), {name: folder.read(name) for name in names}, result.err


def overlap(particles):
    """The largest overlap, the slow way."""
    worst = -math.inf
    for i, a in enumerate(particles):
        for b in particles[:i]:
            gap = math.dist((a["x"], a["y"], a.get("z", 0)),
                            (b["x"], b["y"], b.get("z", 0))) - a["r"] - b["r"]
            worst = max(worst, -gap / min(a["r"], b["r"]))
    return worst


def report_has_every_key(program):
    report, _, _ = made(program, *BOX, "--psd", "uniform:0.2,0.4", "--count", "40")
    equal(list(report), list(KEYS), "keys")
    for key, below in KEYS.items():
        if below:
            equal(list(report[key]), below, "keys of " + key)
    equal(report["program"], "packing-cloud", "program")
    equal(report["particles"], 40, "particles")
    equal(report["domain_volume"], 64.0, "domain_volume")
    equal(report["input"], None, "input")
    equal(sum(report["coordination"]["histogram"]), 40, "sum of the histogram")
    equal(report["fabric"], {"eigenvalues": None, "sd": None, "tensor": None, "contacts": 0,
                             "noise_floor": None}, "fabric of a pack without contacts")
    equal(report["time"]["settle"], None, "time.settle")
    holds(abs(report["porosity"] + report["volume_fraction"] - 1) < 1e-15, "porosity")


def report_tells_the_options(program):
    with Folder(program) as folder:
        result = folder.run(*BOX, "--psd", "mono:0.3", "--count", "7", "--seed",
                            "18446744073709551615", "--report", "r.json", "--out",
                            "vtp:a b")
        equal((result.code, result.out), (DONE, b""), "exit code and output")
        text = folder.read("r.json")
    report = strict(text)
    holds(b"18446744073709551615" in text, "the seed to its last digit")
    options = report["options"]
    equal(options["count"], 7, "count")
    equal(options["method"], "rsa", "method")
    equal(options["mass"], None, "mass")
    equal(options["out"], ["vtp:a b"], "out")
    equal(options["report"], "r.json", "report")
    holds(report["command"].endswith("--out 'vtp:a b'"), report["command"])


def report_hashes_the_input(program):
    with open(SAND, "rb") as file:
        digest = hashlib.sha256(file.read()).hexdigest()
    report, _, _ = made(program, "--domain", "cylinder:4,6", "--psd", "curve:" + SAND,
                        "--count", "200")
    equal(report["input"], [{"file": SAND, "sha256": digest}], "input")


def table_agrees_with_report(program):
    report, files, _ = made(program, "--domain", "cylinder:2,4", "--psd",
                            "uniform:0.2,0.4", "--count", "60")
    particles = rows(files["pack.csv"])
    equal(len(particles), 60, "rows")
    solid = sum(4 / 3 * math.pi * p["r"] ** 3 for p in particles)
    holds(abs(solid / report["solid_volume"] - 1) < 1e-12, "solid volume")
    holds(abs(solid / (16 * math.pi) - report["volume_fraction"]) < 1e-12, "fraction")
    holds(overlap(particles) <= 1e-9, "overlap")
    for p in particles:
        holds(math.hypot(p["x"], p["y"]) + p["r"] <= 2 * (1 + 1e-12), "wall")
        holds(p["r"] * (1 - 1e-12) <= p["z"] <= 4 - p["r"] * (1 - 1e-12), "ends")
        holds(0.2 <= p["r"] <= 0.4, "radius")


def table_has_notes(program):
    report, files, _ = made(program, *BOX, "--psd", "mono:0.3", "--count", "20", "--seed",
                            "5", "--threads", "2")
    said = notes(files["pack.csv"])
    for key, value in (("domain", "box:4,4,4"), ("psd", "mono:0.3"), ("seed", "5")):
        equal(said[key], value, key)
    holds(said["program"].startswith("packing-cloud "), "program")
    holds(said["audit"].startswith("passed"), "audit")
    holds(not {"threads", "time", "date"} & set(said), "nothing that differs by run")


def any_machine_makes_the_same_bytes(program):
    arguments = [*BOX, "--psd", "lognormal:0.15,0.4,0.08,0.4", "--target-porosity", "0.75",
                 "--order", "descending"]
    files = ("pack.csv", "pack.vtp", "pack.data", "pack.xyz", "yade:pack.txt", "pack.png")
    with Folder(program) as folder:
        sets = [name for name in ("avx2", "avx512")
                if folder.run("--isa", name, *BOX, "--psd", "mono:1", "--count", "1").code
                == DONE]
    _, first, _ = made(program, *arguments, "--threads", "1", "--isa", "baseline",
                       files=files)
    for more in ([], ["--threads", "2"], *(["--isa", name] for name in sets)):
        _, again, _ = made(program, *arguments, *more, files=files)
        for name in first:
            holds(first[name] == again[name], "%s differs with %s" % (name, more))


def seed_and_stream_change_the_pack(program):
    arguments = [*BOX, "--psd", "mono:0.3", "--count", "20"]
    packs = [rows(made(program, *arguments, *more)[1]["pack.csv"])
             for more in ([], ["--seed", "2"], ["--stream", "1"])]
    holds(packs[0] != packs[1], "seed")
    holds(packs[0] != packs[2], "stream")


def mass_and_porosity_are_met(program):
    sizes = ["--psd", "uniform:0.1,0.2", "--order", "descending"]
    half = 4 / 3 * math.pi * 0.2 ** 3 / 2
    report, _, _ = made(program, *BOX, *sizes, "--mass", "40000", "--density", "2500")
    holds(abs(report["solid_volume"] - 16) <= half, "mass")
    report, _, _ = made(program, *BOX, *sizes, "--mass", "8000")
    holds(abs(report["solid_volume"] - 8) <= half, "default density 1000")
    report, _, _ = made(program, *BOX, *sizes, "--target-porosity", "0.7")
    holds(abs(report["porosity"] - 0.7) <= half / 64, "porosity")


def lattice_fills_and_counts(program):
    report, files, _ = made(program, *BOX, "--psd", "mono:0.5", "--method", "lattice:sc")
    equal(report["particles"], 64, "particles")
    holds(abs(report["volume_fraction"] - math.pi / 6) < 1e-12, "pi / 6")
    equal(report["options"]["order"], None, "order")
    report, _, _ = made(program, *BOX, "--psd", "mono:0.5", "--method", "lattice:sc",
                        "--count", "10")
    equal(report["particles"], 10, "particles")
    sphere = 4 / 3 * math.pi / 8
    report, _, _ = made(program, *BOX, "--psd", "mono:0.5", "--method", "lattice:sc",
                        "--mass", "%r" % (20 * 1000 * sphere))
    equal(report["particles"], 20, "particles by mass")


def saturated_below_the_asked_is_said(program):
    report, files, said = made(program, "--domain", "box:2,2,2", "--psd", "mono:0.5",
                               "--count", "9", code=SHORT)
    holds(report["particles"] < 9, "particles")
    equal(len(rows(files["pack.csv"])), report["particles"], "rows")
    equal(notes(files["pack.csv"])["placed"], "saturated", "note")
    holds("saturated" in said and "of 9 particles" in said, said)
    report, _, said = made(program, "--domain", "box:2,2,2", "--psd", "uniform:0.4,0.5",
                           "--target-porosity", "0.3", "--max-failures", "1000",
                           code=SHORT)
    holds("of 0.7 reached" in said, said)


def without_an_amount_it_saturates(program):
    report, files, said = made(program, "--domain", "rect:20,20+periodic", "--psd",
                               "mono:0.5")
    holds(0.5 < report["volume_fraction"] < 0.6, "0.547 in large cells")
    equal(report["dim"], 2, "dim")
    equal(said, "", "standard error")
    holds(all("z" not in p for p in rows(files["pack.csv"])), "z in two dimensions")


def audit_limit_is_an_option(program):
    """Any two lattice neighbours touch to a rounding error, which a limit of 0 may not pass;
    what the report says and the exit code must agree."""
    with Folder(program) as folder:
        result = folder.run("--domain", "cylinder:3,7", "--psd", "mono:0.31", "--method",
                            "lattice:hcp", "--max-overlap", "0", "--out", "pack.csv")
        report = strict(result.out)
        passed = report["audit"]["passed"]
        equal(report["audit"]["limit"], 0.0, "limit")
        equal(passed, report["audit"]["max_overlap"] == 0
              and report["audit"]["max_protrusion"] == 0, "passed")
        equal(result.code, DONE if passed else SHORT, "exit code")
        word = "passed" if passed else "FAILED"
        holds(notes(folder.read("pack.csv"))["audit"].startswith(word), "note")


def mixtures_tell_their_parts(program):
    report, files, _ = made(program, *BOX, "--psd", "0.5*mono:0.3+0.5*mono:0.15",
                            "--target-porosity", "0.75", "--order", "descending")
    particles = rows(files["pack.csv"])
    for p in particles:
        equal(p["component"], 0 if p["r"] == 0.3 else 1, "component")
    parts = [sum(p["r"] ** 3 for p in particles if p["component"] == k) for k in (0, 1)]
    holds(0.6 < parts[0] / parts[1] < 1.6, "equal masses")
    _, files, _ = made(program, *BOX, "--psd",
                       "1*uniform:0.2,0.3,by=mass+1e0*discrete:0.1=1,0.15=2",
                       "--count", "30")
    equal(len(rows(files["pack.csv"])), 30, "rows")


def containers_of_every_kind(program):
    volumes = {
        "box:4,4,4": 64, "box:2,2,2+scale:2": 64, "box:4,4,4+at:1,2,3": 64,
        "box:4e+0,4,4+open:top": 64, "box:4,4,4+periodic:xy": 64, "rect:5,6": 30,
        "rect:5,6+periodic:x": 30, "cylinder:2,5": 20 * math.pi,
        "cylinder:2,5,axis=x": 20 * math.pi, "tube:1,3,2": 16 * math.pi,
        "cone:1,3,3+open:top": 13 * math.pi, "silo:2,6,1,3": 19 * math.pi,
        "sphere:3": 36 * math.pi, "circle:3+at:1,1": 9 * math.pi, "annulus:1,3": 8 * math.pi,
    }
    for spec, volume in volumes.items():
        report, files, _ = made(program, "--domain", spec, "--psd", "mono:0.25", "--count",
                                "12", files=("pack.csv", "pack.png", "pack.svg"))
        holds(abs(report["domain_volume"] / volume - 1) < 1e-12, spec)
        equal(report["particles"], 12, spec)
        equal(files["pack.png"][:8], b"\x89PNG\r\n\x1a\n", "PNG of " + spec)
        holds(files["pack.svg"].rstrip().endswith(b"</svg>"), "SVG of " + spec)
    _, files, _ = made(program, "--domain", "box:4,4,4+at:10,20,30+scale:2", "--psd",
                       "mono:0.5", "--count", "5")
    for p in rows(files["pack.csv"]):
        holds(20 < p["x"] < 28 and 40 < p["y"] < 48 and 60 < p["z"] < 68, "moved and scaled")


def every_law(program):
    with Folder(program) as folder:
        folder.write("radii.txt", "# measured\n0.2\n0.25\n\n0.3\n")
        for spec in ("mono:0.3", "uniform:0.2,0.3", "normal:0.25,0.05,0.1,0.4",
                     "lognormal:0.25,0.2,0.1,0.4", "weibull:0.25,3,0.1,0.4",
                     "gamma:0.05,5,0.1,0.4", "exponential:0.2,0.1,0.4",
                     "discrete:0.2=1,0.3=2", "discrete:0.2=1,0.3=2,by=number",
                     "uniform:0.2,0.3,by=mass", "sample:radii.txt",
                     "curve:%s,by=number" % SAND):
            result = folder.run("--domain", "box:9,9,9", "--psd", spec, "--count", "20",
                                "--plot-sizes", "sizes.svg")
            equal((result.code, result.err), (DONE, ""), spec)
            equal(strict(result.out)["particles"], 20, spec)


def files_replace_what_was_there(program):
    with Folder(program) as folder:
        folder.write("pack.csv", "old\n")
        result = folder.run(*BOX, "--psd", "mono:0.3", "--count", "5", "--out", "pack.csv")
        equal((result.code, result.files), (DONE, ["pack.csv"]), "exit code and files")
        equal(len(rows(folder.read("pack.csv"))), 5, "rows")


def packs_go_through_pipes(program):
    with Folder(program) as folder:
        pipe = os.path.join(folder.path, "pipe")
        os.mkfifo(pipe)
        run = subprocess.Popen([program, *BOX, "--psd", "mono:0.3", "--count", "5", "--out",
                                "csv:pipe", "--report", "/dev/null"], cwd=folder.path)
        with open(pipe, "rb") as file:
            text = file.read()
        equal(run.wait(60), DONE, "exit code")
        equal(len(rows(text)), 5, "rows")


def stops_when_told(number):
    def test(program):
        with Folder(program) as folder:
            folder.write("pack.csv", "old\n")
            run = subprocess.Popen([program, "--domain", "box:1,1,1", "--psd",
                                    "uniform:0.002,0.004", "--target-porosity", "0.6",
                                    "--out", "pack.csv", "--out", "pack.vtp"],
                                   cwd=folder.path, stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE)
            time.sleep(0.5)
            equal(run.poll(), None, "still at work")
            run.send_signal(number)
            out, err = run.communicate(timeout=60)
            equal((run.returncode, out), (INTERRUPTED, b""), "exit code, output")
            holds(b"nothing written" in err, err)
            equal(os.listdir(folder.path), ["pack.csv"], "files")
            equal(folder.read("pack.csv"), b"old\n", "the old file")
    return test


def stops_while_a_pipe_has_no_reader(program):
    with Folder(program) as folder:
        os.mkfifo(os.path.join(folder.path, "pipe"))
        run = subprocess.Popen([program, *BOX, "--psd", "mono:0.3", "--count", "5", "--out",
                                "csv:pipe", "--out", "pack.vtp"], cwd=folder.path,
                               stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        time.sleep(0.5)
        equal(run.poll(), None, "still waiting")
        run.terminate()
        out, err = run.communicate(timeout=10)
        equal((run.returncode, out), (INTERRUPTED, b""), "exit code, output")
        equal(os.listdir(folder.path), ["pipe"], "files")


def ends_when_told_twice(program):
    """A sieve curve from a pipe without a writer: the wait is not the program's own."""
    with Folder(program) as folder:
        os.mkfifo(os.path.join(folder.path, "pipe"))
        run = subprocess.Popen([program, *BOX, "--psd", "curve:pipe", "--count", "5"],
                               cwd=folder.path, stdout=subprocess.PIPE,
                               stderr=subprocess.PIPE)
        time.sleep(0.5)
        run.terminate()
        time.sleep(0.1)
        run.terminate()
        run.communicate(timeout=10)
        equal(run.returncode, -signal.SIGTERM, "exit code")


def help_describes_every_spec(program):
    """help2man makes a heap of the lines that have no description."""
    with Folder(program) as folder:
        lines = folder.run("--help").out.decode().splitlines()
        bare = [i for i, line in enumerate(lines) if re.match(r"  \S+:\S+$", line)]
        holds(bare, "specs that fill their line")
        for i in bare:
            holds(lines[i + 1].startswith(26 * " "), lines[i])


def help_mentions_every_option(program):
    with Folder(program) as folder:
        result = folder.run("--help")
        equal((result.code, result.err), (DONE, ""), "exit code, standard error")
        text = result.out.decode()
        for name in ("domain psd count mass density target-porosity method order "
                     "max-failures seed stream threads isa out report max-overlap "
                     "plot-sizes colour quiet version help").split():
            holds(re.search(r"--%s\b" % name, text), name)
        for word in ("box cylinder tube cone silo sphere circle annulus rect periodic open "
                     "scale axis mono uniform normal lognormal weibull gamma exponential "
                     "discrete curve sample by=mass csv vtp lammps yade xyz png svg").split():
            holds(word in text, word)
        holds(max(map(len, text.splitlines())) <= 90, "width")


def version_is_told(program):
    with Folder(program) as folder:
        result = folder.run("--version")
        equal(result.code, DONE, "exit code")
        holds(re.match(r"packing-cloud \(libpacking\) \d+\.\d+\.\d+\n",
                       result.out.decode()), result.out)


def numbers_are_the_same_in_every_locale(program):
    """In a locale with a decimal comma that is really there, made for the occasion."""
    arguments = [*BOX, "--psd", "mono:0.31", "--count", "9"]
    with Folder(program) as folder:
        subprocess.run(["localedef", "-i", "de_DE", "-f", "UTF-8",
                        os.path.join(folder.path, "de_DE.UTF-8")], capture_output=True,
                       check=True)
        comma = dict(os.environ, LOCPATH=folder.path, LC_ALL="de_DE.UTF-8")
        said = subprocess.run(["locale", "decimal_point"], env=comma, capture_output=True,
                              text=True, check=True).stdout
        equal(said, ",\n", "the locale's decimal point")
        texts = []
        for env in (dict(os.environ, LC_ALL="C"), comma):
            with Folder(program) as other:
                result = other.run(*arguments, "--out", "pack.csv", "--report", "r.json",
                                   env=env)
                equal(result.code, DONE, "exit code")
                texts.append(other.read("pack.csv"))
                strict(other.read("r.json"))
    holds(texts[0] == texts[1], "files differ")


def nothing_on_standard_error(program):
    """No bar where standard error is no terminal."""
    with Folder(program) as folder:
        result = folder.run(*BOX, "--psd", "mono:0.1", "--count", "5000")
        equal(result.err, "", "standard error")


def on_a_terminal(program, *more):
    """What the program prints when standard error is a terminal."""
    with Folder(program) as folder:
        try:
            ours, theirs = pty.openpty()
        except OSError:
            raise Skip("no pseudo-terminals") from None
        run = subprocess.Popen([program, "--domain", "box:1,1,1", "--psd", "mono:0.01",
                                "--report", "r.json", *more],
                               cwd=folder.path, stderr=theirs)
        os.close(theirs)
        text = b""
        try:
            while True:
                text += os.read(ours, 65536)
        except OSError:  # the other end is closed and all is read
            os.close(ours)
        equal(run.wait(60), DONE, "exit code")
        return text.decode(), strict(folder.read("r.json"))["time"]["place"]


def bar_on_a_terminal(program):
    text, seconds = on_a_terminal(program)
    if seconds <= 0.5:
        raise Skip("a machine this fast draws no bar")
    holds(re.search(r"placing \[#*\.*\] +[0-9.]+ %  [0-9]+  [0-9]+[kM]?/s  .* left", text),
          repr(text))
    holds(text.endswith("\r\033[K"), "the bar is wiped")
    equal(on_a_terminal(program, "--quiet")[0], "", "quiet")


main([(test.__name__.replace("_", " "), test) for test in (
    report_has_every_key, report_tells_the_options, report_hashes_the_input,
    table_agrees_with_report, table_has_notes, any_machine_makes_the_same_bytes,
    seed_and_stream_change_the_pack, mass_and_porosity_are_met, lattice_fills_and_counts,
    saturated_below_the_asked_is_said, without_an_amount_it_saturates,
    audit_limit_is_an_option, mixtures_tell_their_parts, containers_of_every_kind, every_law,
    files_replace_what_was_there, packs_go_through_pipes,
    stops_while_a_pipe_has_no_reader, ends_when_told_twice, help_mentions_every_option, help_describes_every_spec,
    version_is_told, numbers_are_the_same_in_every_locale, nothing_on_standard_error, bar_on_a_terminal)] + [
    ("stops at SIGINT", stops_when_told(signal.SIGINT)),
    ("stops at SIGTERM", stops_when_told(signal.SIGTERM))])
