#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes doc/results/front.md and its pictures: packs by packing-front beside those of I. Perez
Morales, R. Rosello Valera, C. Recarey Morfa et al.

    doc/results/front.py [--build build] [--work build/results-front] [--only PART,...]
        [--scale 1] [--threads 2] [--limit 3600]

Needs python3-numpy and python3-matplotlib. Runs go one after the other, for they are timed; what was
made is kept in the work folder, keyed by the options and by the bytes of program and library, so an
interrupted or partial run goes on where it was: `--only table2,table4` makes these parts, the others
are written as they were made last. `--scale 0.001` tries everything in minutes, on packs of
a thousandth of the particles; it writes into the work folder. What is said by hand stands in
front-notes.md, one section a part.
"""
import argparse
import datetime
import os
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
sys.dont_write_bytecode = True
sys.path.insert(0, str(HERE))
from making import front_packs, front_studies, grown, page  # noqa: E402

FIRST = {name: front_studies.PARTS[name] for name in ("bars", "millions")}
PARTS = {**FIRST, **front_packs.PARTS, **front_studies.PARTS}


def read_options():
    p = argparse.ArgumentParser(description=__doc__,
                                formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument("--build", default=str(ROOT / "build"), help="where the programs are")
    p.add_argument("--work", default=str(ROOT / "build/results-front"),
                   help="folder of raw results")
    p.add_argument("--only", default="", metavar="PART,...",
                   help=f"make the packs of these parts only, of {','.join(PARTS)}")
    p.add_argument("--scale", type=float, default=1,
                   help="share of the particles, below 1 for a trial")
    p.add_argument("--threads", type=int, default=2, help="of the largest packs, default 2")
    p.add_argument("--limit", type=float, default=3600, metavar="SECONDS",
                   help="a run that takes longer is stopped and told as such, default an hour")
    p.add_argument("--out", help="the file, default front.md beside this script")
    return p.parse_args()


def head(arguments):
    scale = f" --scale {arguments.scale:g}" if arguments.scale != 1 else ""
    return f"""# Front: packs without dynamics

I. Perez Morales, R. Rosello Valera, C. Recarey Morfa et al., the seed paper of the advancing front;
the method is in [../methods/front.md](../methods/front.md). This file is written by
`doc/results/front.py{scale}`; what is said by hand comes from `front-notes.md`.

Machine: {page.machine()}. Date: {datetime.date.today()}. Times are wall clock of
placing alone (`time.place` of the report), one run, nothing beside it. N: particles placed. "Whole" is
the volume fraction of the whole container, particles cut exactly at it; "inner" that of the part at
least 3 r_max from every wall. Z: mean contacts of a particle with others (gap at most 1e-9 of
r_i + r_j). KS: Kolmogorov-Smirnov distance of the sizes placed from those asked, beside its 5 % limit
1.36 / sqrt N. Overlap: the largest, relative to the smaller radius. Bounds and sizes that our copy of the
paper has lost are stood in for, and each part says by what.
"""


def made_part(maker, name, arguments):
    """The Markdown of a part, and of which source it is."""
    maker.commands = []
    body = PARTS[name][1](maker, arguments).rstrip()
    seen = dict.fromkeys(f"{pack.command()}" for pack in maker.commands)
    lines = list(seen)
    more = [f"... and {len(lines) - 12} like these" for _ in (1,) if len(lines) > 12]
    if lines:
        body += "\n\n```\n" + "\n".join(lines[:12] + more) + "\n```"
    return f"{body}\n\nSource {page.version(ROOT)}, {datetime.date.today()}.\n"


def write(maker, arguments):
    trial = arguments.scale != 1
    out = pathlib.Path(arguments.out) if arguments.out else (
        maker.work / "front.md" if trial else HERE / "front.md")
    notes, pieces = page.read_notes(HERE / "front-notes.md"), [head(arguments)]
    for name, (title, _) in PARTS.items():
        body = maker.part(name)
        pieces += [f"## {title}\n",
                   body.read_text() if body.exists() else
                   f"Not run: `doc/results/front.py --only {name}`.\n"]
        if name in notes:
            pieces.append(notes[name] + "\n")
    if "fuzzing" in notes:
        pieces += ["## Fuzzing\n", notes["fuzzing"] + "\n"]
    out.write_text("\n".join(pieces), encoding="utf-8")
    print(out)


def main():
    arguments = read_options()
    wanted = arguments.only.split(",") if arguments.only else list(PARTS)
    unknown = set(wanted) - set(PARTS)
    if unknown:
        sys.exit(f"--only: no part {', '.join(sorted(unknown))}; there are {', '.join(PARTS)}")
    trial = arguments.scale != 1
    work = pathlib.Path(arguments.work) / (f"trial-{arguments.scale:g}" if trial else "full")
    maker = grown.Maker(arguments.build, work, arguments.scale, arguments.limit)
    for program in maker.programs.values():
        if not os.access(program, os.X_OK):
            sys.exit(f"{program} is missing: meson setup build --buildtype=release && "
                     "ninja -C build")
    maker.images = work / "images" if trial else ROOT / "doc" / "images"
    maker.images.mkdir(parents=True, exist_ok=True)
    for name in PARTS:
        if name in wanted:
            print(name, file=sys.stderr)
            body = made_part(maker, name, arguments)
            maker.part(name).write_text(body, encoding="utf-8")
    write(maker, arguments)


if __name__ == "__main__":
    main()
