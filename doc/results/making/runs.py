# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs packing-layers, one process a pack, some side by side, and keeps what they made, so that a
run that was made once is not made again and one that was interrupted goes on."""
import concurrent.futures
import csv
import hashlib
import json
import os
import pathlib
import subprocess
import sys
import threading
import time

import numpy

from making import order


class Run:
    """One pack: the command line without the files it writes."""

    def __init__(self, options, cost, picture=False):
        self.options = tuple(options)
        self.cost = cost  # particle-steps, an estimate
        self.picture = picture

    def key(self, library):
        text = "\0".join((library,) + self.options)
        return hashlib.sha256(text.encode()).hexdigest()[:16]


class Store:
    """Folder of finished runs, keyed by options and by the bytes of program and library."""

    def __init__(self, program, measure, work, rate):
        self.program = program
        self.measure = measure  # packing-measure
        self.work = pathlib.Path(work)
        self.rate = rate  # particle-steps a second of one process, for estimates
        self.library = library_hash(program)
        self.lock = threading.Lock()
        self.work.mkdir(parents=True, exist_ok=True)

    def folder(self, run):
        return self.work / run.key(self.library)

    def have(self, run):
        where = self.folder(run)
        return (where / "done.json").exists() and (
            not run.picture or (where / "pack.png").exists())

    def missing(self, runs):
        """Each once, the longest first."""
        unique = {}
        for run in runs:
            if not self.have(run):
                known = unique.setdefault(run.options, run)
                known.picture = known.picture or run.picture
        return sorted(unique.values(), key=lambda run: -run.cost)

    def seconds(self, runs):
        return sum(run.cost for run in self.missing(runs)) / self.rate

    def make(self, runs, processes):
        """Makes what is missing."""
        todo = self.missing(runs)
        left = [sum(run.cost for run in todo)]
        begun, spent = time.monotonic(), [0.0]

        def one(numbered):
            number, run = numbered
            seconds = self.make_one(run)
            with self.lock:
                left[0] -= run.cost
                spent[0] += run.cost
                wait = (time.monotonic() - begun) / spent[0] * left[0]
                print(f"  [{number + 1}/{len(todo)}] {' '.join(run.options)}: {seconds:.1f} s; "
                      f"{wait / 60:.1f} min left", file=sys.stderr, flush=True)

        with concurrent.futures.ThreadPoolExecutor(processes) as pool:
            futures = [pool.submit(one, numbered) for numbered in enumerate(todo)]
            try:
                for future in concurrent.futures.as_completed(futures):
                    future.result()
            except BaseException:
                pool.shutdown(cancel_futures=True)
                raise

    def make_one(self, run):
        where = self.folder(run)
        where.mkdir(exist_ok=True)
        command = [self.program, *run.options, "--threads", "1", "--quiet",
                   "--out", str(where / "pack.csv"), "--report", str(where / "report.json")]
        if run.picture:
            command += ["--out", str(where / "pack.png")]
        start = time.time()
        done = subprocess.run(command, capture_output=True, text=True, check=False,
                              env={**os.environ, "OMP_NUM_THREADS": "1"})
        end = time.time()
        # 1: the audit or the amount failed; the report says so and the tables count it.
        if done.returncode not in (0, 1) or not (where / "report.json").exists():
            raise SystemExit(f"{' '.join(command)}\nexit {done.returncode}\n{done.stderr}")
        record = {"options": run.options, "exit": done.returncode, "start": start, "end": end,
                  "message": done.stderr}
        temporary = where / "done.json.new"
        temporary.write_text(json.dumps(record, indent=1) + "\n")
        temporary.rename(where / "done.json")
        return end - start

    def record(self, run):
        return json.loads((self.folder(run) / "done.json").read_text())

    def report(self, run):
        """The pack's report, the only one or the first of several."""
        whole = json.loads((self.folder(run) / "report.json").read_text())
        return {**whole, **whole["packs"][0]} if whole.get("packs") else whole

    def pack(self, run):
        """Positions (n by dim) and radii."""
        with open(self.folder(run) / "pack.csv", encoding="ascii") as file:
            rows = csv.reader(line for line in file if not line.startswith("#"))
            header = next(rows)
            table = numpy.array([row for row in rows], dtype=float)
        column = {name: table[:, k] for k, name in enumerate(header)}
        axes = [name for name in ("x", "y", "z") if name in column]
        if "z" in column and not column["z"].any():
            axes.remove("z")
        return numpy.stack([column[name] for name in axes], axis=1), column["r"]

    def order(self, run):
        """Bond orders of each particle, columns by name."""
        return order.of_each(self.measure, self.folder(run) / "pack.csv")


def library_hash(program):
    """Of the program and of the libpacking that it loads."""
    files = [program]
    loaded = subprocess.run(["ldd", program], capture_output=True, text=True, check=False).stdout
    files += [line.split("=>")[1].split()[0] for line in loaded.splitlines()
              if "libpacking" in line and "=> /" in line]
    digest = hashlib.sha256()
    for name in files:
        digest.update(pathlib.Path(name).read_bytes())
    return digest.hexdigest()


def wall_seconds(records):
    """Length of the union of the runs' times."""
    total, reached = 0.0, 0.0
    for start, end in sorted((r["start"], r["end"]) for r in records):
        total += max(0.0, end - max(start, reached))
        reached = max(reached, end)
    return total


def process_seconds(records):
    return sum(r["end"] - r["start"] for r in records)
