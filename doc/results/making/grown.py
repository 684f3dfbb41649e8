# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs packing-front and its sisters one after the other where they are timed, and keeps what they
made: a run that was made once is not made again."""
import concurrent.futures
import csv
import datetime
import hashlib
import json
import math
import pathlib
import re
import shlex
import signal
import subprocess
import sys
import time

import numpy

from making import runs

HERE = pathlib.Path(__file__).resolve().parent.parent
ROOT = HERE.parent.parent
DATA = "doc/results/data"  # from the root, where programs run: pictures show the path


STOPPED = 130


class Pack:
    """A finished run: its report, its folder, the command that makes it."""

    def __init__(self, folder, options):
        self.folder, self.options = folder, options
        self.report = json.loads((folder / "report.json").read_text())
        self.record = json.loads((folder / "done.json").read_text())

    @property
    def stopped(self):
        """Whether it took too long and is a part of a pack."""
        return self.record["exit"] == STOPPED

    def __getitem__(self, key):
        """A number by its dotted key, None where it is null."""
        at = self.report
        for word in key.split("."):
            at = at[int(word)] if isinstance(at, list) else at[word]
        return at

    def command(self):
        """As one would type it in the root of the source."""
        words = [re.sub(r"^mesh:\S*/", "mesh:", word).replace(f"{ROOT}/", "")
                 for word in self.options]
        return shlex.join(["packing-front", *words])

    def rows(self, name="pack.csv"):
        """Columns of a table by name; words become NaN."""
        with open(self.folder / name, encoding="ascii") as file:
            rows = csv.reader(line for line in file if not line.startswith("#"))
            header = next(rows)
            table = numpy.array([[value_of(word) for word in row] for row in rows])
        return {name: table[:, k] for k, name in enumerate(header)}


def value_of(word):
    try:
        return float(word)
    except ValueError:
        return math.nan


class Maker:
    def __init__(self, build, work, scale, limit):
        build, work = pathlib.Path(build).resolve(), pathlib.Path(work).resolve()
        self.programs = {name: str(build / "examples" / name) for name in
                         ("packing-front", "packing-measure", "packing-compare")}
        self.programs["bench-front"] = str(build / "tests" / "bench" / "bench-front")
        self.library = runs.library_hash(self.programs["packing-front"])
        self.work, self.scale, self.limit = work, scale, limit
        self.work.mkdir(parents=True, exist_ok=True)
        self.values = {}
        self.commands = []

    def part(self, name):
        """The file of a part of the page."""
        return self.work / f"{name}.md"

    # ---- sizes of trials ----

    def length(self, full):
        """A length such that volumes go with the scale."""
        return full * self.scale ** (1 / 3)

    def number(self, full, least=2):
        return max(least, round(full * self.scale))

    # ---- runs ----

    def key(self, words, depends):
        digest = hashlib.sha256("\0".join((self.library, *words)).encode())
        for path in depends:
            digest.update(pathlib.Path(path).read_bytes())
        return digest.hexdigest()[:16]

    def front(self, *options, threads=1, outs=(), depends=(), short=False):
        """A pack. `outs` are files to keep, each (option, name). `short`: less than asked is fine
        too."""
        options = (*options, "--threads", str(threads))
        words = list(options)
        for option, name in outs:
            words += [option, name]
        folder = self.work / self.key(words, depends)
        if not (folder / "done.json").exists():
            self.make("packing-front", options, outs, folder, (0, 1) if short else (0,))
        pack = Pack(folder, options)
        self.commands.append(pack)
        return pack

    def side_by_side(self, make, which):
        """Packs whose time does not matter, two at a time."""
        noted = len(self.commands)
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            packs = list(pool.map(make, which))
        self.commands[noted:] = packs
        return packs

    def measure(self, pack, *options, outs=()):
        """What packing-measure says of a pack that was kept as pack.csv."""
        asked = ("--in", str(pack.folder / "pack.csv"), *options)
        words = [pack.folder.name, *options, *(word for out in outs for word in out)]
        folder = self.work / self.key(["measure", *words], ())
        if not (folder / "done.json").exists():
            self.make("packing-measure", asked, outs, folder, (0,))
        return Pack(folder, asked)

    def make(self, program, options, outs, folder, good):
        folder.mkdir(parents=True, exist_ok=True)
        command = [self.programs[program], *options, "--quiet", "--report",
                   str(folder / "report.json")]
        for option, name in outs:
            command += [option, str(folder / name)]
        print("  " + shlex.join([program, *options]), file=sys.stderr, flush=True)
        start = time.monotonic()
        code, said = self.run(command, self.limit)
        if code == STOPPED and not (folder / "report.json").exists():
            code, said = self.run(command, None)  # placed in time, and long to measure
        seconds = time.monotonic() - start
        if code not in (*good, STOPPED) or not (folder / "report.json").exists():
            raise SystemExit(f"{shlex.join(command)}\nexit {code}\n{said}")
        print(f"    {seconds:.1f} s {said.strip()}", file=sys.stderr, flush=True)
        record = {"exit": code, "message": said, "seconds": seconds,
                  "date": str(datetime.date.today())}
        temporary = folder / "done.json.new"
        temporary.write_text(json.dumps(record) + "\n")
        temporary.rename(folder / "done.json")

    def bench(self, *words):
        """What bench-front prints; a trial only has the usual."""
        file = self.work / (self.key(["bench", *words], ()) + ".txt")
        if not file.exists():
            print("  " + shlex.join(["bench-front", *words]), file=sys.stderr, flush=True)
            done = subprocess.run([self.programs["bench-front"], *words], capture_output=True,
                                  text=True, check=True)
            file.write_text(done.stdout)
        return file.read_text()

    def run(self, command, limit):
        """Exit code and what was said; a run over the limit is told to stop, and leaves what it
        has placed if it was still placing."""
        with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                              text=True, cwd=ROOT) as running:
            try:
                said = running.communicate(timeout=limit)[1]
            except subprocess.TimeoutExpired:
                running.send_signal(signal.SIGINT)
                said = running.communicate()[1]
            except BaseException:
                running.kill()
                raise
        return running.returncode, said

    def compare(self, *options):
        """The summary that packing-compare prints."""
        done = subprocess.run([self.programs["packing-compare"], *options, "--report",
                               "/dev/null"], capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise SystemExit(done.stderr)
        return done.stderr.strip()
