#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes doc/results/layers.md and its pictures: the packs of Campello and Cassares (Lat. Am. J.
Solids Struct. 13, 23, 2016) by packing-layers, beside the paper's tables.

    doc/results/layers.py [--program build/examples/packing-layers] [--work build/results-layers]
        [--measure build/examples/packing-measure]

Needs python3-numpy and python3-matplotlib. Packs are independent: each is a process of one thread,
two at a time. What was made is kept in the work folder, keyed by the options and by the bytes of
program and library, so an interrupted or partial run goes on where it was. What is said about the
numbers by hand stands in layers-notes.md, one section a part, where {{name}} stands for a number of
the run (the work folder's values.json lists them).
"""
import argparse
import datetime
import json
import os
import pathlib
import re
import sys

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
sys.dont_write_bytecode = True
sys.path.insert(0, str(HERE))
from making import page, parts, runs, stats, text  # noqa: E402


def read_options():
    p = argparse.ArgumentParser(description=__doc__,
                                formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument("--program", default=str(ROOT / "build/examples/packing-layers"))
    p.add_argument("--measure", default=str(ROOT / "build/examples/packing-measure"),
                   help="what tells how ordered the packs are")
    p.add_argument("--work", default=str(ROOT / "build/results-layers"),
                   help="folder of raw results")
    p.add_argument("--only", default="", metavar="PART,...",
                   help=f"make the packs of these parts only, of {','.join(parts.ORDER)}; "
                        "the others are written where their packs are there")
    p.add_argument("--quick", action="store_true",
                   help="a trial: low beds, two packs, 1/20 of the time; writes into the work "
                        "folder")
    p.add_argument("--packs", type=int, help="of each table, default 10")
    p.add_argument("--processes", type=int, default=2, help="side by side, default 2")
    p.add_argument("--rate", type=float, default=1e7,
                   help="particle-steps a second of a process, for the estimate")
    p.add_argument("--estimate", action="store_true", help="print the estimate and end")
    p.add_argument("--out", help="the file, default layers.md beside this script")
    return p.parse_args()


def default_slip(store, groups, make):
    """The program's regularising velocity by example, from the report of a table's pack; None
    where there is no such pack and none shall be made."""
    found = {}
    for example in parts.SLIP_EXAMPLES:
        run = groups[example, "on"][0]
        if make:
            store.make([run], 1)
        if not store.have(run):
            return None
        found[example] = float(store.report(run)["options"]["slip_velocity"])
    return found


def plan_groups(plan, store, wanted):
    """Groups of each part. The slip part needs a pack of the tables first."""
    groups = {name: getattr(plan, name)() for name in parts.ORDER
              if name not in parts.SEES and name != "slip"}
    slip = default_slip(store, groups["tables"], "slip" in wanted)
    if slip is not None or not wanted:  # an estimate does without the numbers
        groups["slip"] = plan.slip(slip or dict.fromkeys(parts.SLIP_EXAMPLES, 1.0))
    for name, of in parts.SEES.items():
        groups[name] = groups[of]
    return groups, slip


def estimate(store, groups, wanted, processes):
    seen, total = set(), 0.0
    for name in wanted:
        fresh = [run for run in store.missing(parts.runs_of(groups.get(name, {})))
                 if run.options not in seen]
        seen.update(run.options for run in fresh)
        seconds = sum(run.cost for run in fresh) / store.rate / processes
        total += seconds
        print(f"{name:10} {len(fresh):4} packs to make, about {seconds / 60:5.1f} min",
              file=sys.stderr)
    print(f"in all about {total / 60:.0f} min with {processes} processes at {store.rate:.1e} "
          "particle-steps/s each", file=sys.stderr)


def fill(note, values):
    def value(match):
        if match.group(1) not in values:
            print(f"layers-notes.md: no number {match.group(1)}", file=sys.stderr)
            return "(not run)"
        return values[match.group(1)]
    return re.sub(r"\{\{([^}]+)\}\}", value, note)


def head(store, arguments):
    command = "doc/results/layers.py" + " --quick" * arguments.quick
    version = page.version(ROOT)
    program = page.shell(ROOT, arguments.program, "--version").splitlines()[0]
    return f"""# Layers: the packs of Campello and Cassares

E. M. B. Campello and K. R. Cassares, Lat. Am. J. Solids Struct. 13 (2016) 23-50: layers by random
sequential addition, jammed by a discrete-element simulation; the method is in
[../methods/dem.md](../methods/dem.md). This file is written by `{command}`; what is said by hand
comes from `layers-notes.md`.

Machine: {page.machine()}. Date: {datetime.date.today()}. Source: {version} ({program}). Each pack is one
process of one thread, {arguments.processes} side by side; pack k has `--seed 1 --stream k-1`, so that
`--packs 10` makes the same ten. Unless said: `packing-layers --example E --rotations on|off
--layer-end time --full bed`, 1.0 s a layer as in the paper. Deviations (sd) are with n - 1, cv = sd / mean. Density is the volume fraction below the asked
height, particles cut there counted in part (equation 22).
"""


def cost_row(store, made, records):
    unique = {run.options: run for run in made}.values()
    rates = [store.report(run)["layers"]["particle_steps_per_second"] or 0 for run in unique]
    return [str(len(records)), f"{runs.process_seconds(records.values()):.0f}",
            f"{runs.wall_seconds(records.values()):.0f}", f"{stats.mean(rates):.3g}"]


def cost(store, groups):
    rows, every = [], {}
    for name in parts.ORDER:
        made = [run for run in parts.runs_of(groups.get(name, {})) if store.have(run)]
        if name in parts.SEES or not made:
            continue
        records = {run.options: store.record(run) for run in made}
        every.update(records)
        rows.append([name] + cost_row(store, made, records))
    made = [run for name in groups for run in parts.runs_of(groups[name]) if store.have(run)]
    rows.append(["all, each pack once"] + cost_row(store, made, every))
    return ("A pack that serves several parts counts in each; wall time is that during which a "
            "pack of the part was being made.\n\n" +
            text.table(["part", "packs", "process time [s]", "wall time [s]",
                        "mean particle-steps/s of a process"], rows))


def write(store, groups, slip, arguments):
    out = pathlib.Path(arguments.out) if arguments.out else (
        store.work / "layers.md" if arguments.quick else HERE / "layers.md")
    images = store.work / "images" if arguments.quick else ROOT / "doc" / "images"
    images.mkdir(parents=True, exist_ok=True)
    results, sections = text.Results(store, images), []
    notes = page.read_notes(HERE / "layers-notes.md")
    for example, velocity in (slip or {}).items():
        results.values[f"slip.default.{example}"] = f"{velocity:.3g}"
    for name in parts.ORDER:
        title, writer = text.SECTIONS[name]
        of = groups.get(name)
        body = (writer(results, of) if of and not store.missing(parts.runs_of(of)) else
                f"Not run: `doc/results/layers.py --only {name}`.\n")
        sections.append((name, title, body))
    pieces = [head(store, arguments)]
    if "first" in notes:
        pieces.append(fill(notes["first"], results.values) + "\n")
    for name, title, body in sections:
        pieces += [f"## {title}\n", body.rstrip() + "\n"]
        if name in notes:
            pieces.append(fill(notes[name], results.values) + "\n")
    pieces += ["## Cost\n", cost(store, groups)]
    out.write_text("\n".join(pieces), encoding="utf-8")
    (store.work / "values.json").write_text(json.dumps(results.values, indent=1) + "\n")
    print(out)


def main():
    arguments = read_options()
    wanted = arguments.only.split(",") if arguments.only else list(parts.ORDER)
    unknown = set(wanted) - set(parts.ORDER)
    if unknown:
        sys.exit(f"--only: no part {', '.join(sorted(unknown))}; there are "
                 f"{', '.join(parts.ORDER)}")
    for program in (arguments.program, arguments.measure):
        if not os.access(program, os.X_OK):
            sys.exit(f"{program} is missing: meson setup build --buildtype=release && "
                     "ninja -C build")
    work = pathlib.Path(arguments.work) / ("quick" if arguments.quick else "full")
    store = runs.Store(arguments.program, arguments.measure, work, arguments.rate)
    plan = parts.Plan(arguments.quick, arguments.packs)
    groups, slip = plan_groups(plan, store, [] if arguments.estimate else wanted)
    estimate(store, groups, wanted, arguments.processes)
    if arguments.estimate:
        return
    for name in wanted:
        print(name, file=sys.stderr)
        store.make(parts.runs_of(groups[name]), arguments.processes)
    write(store, groups, slip, arguments)


if __name__ == "__main__":
    main()
