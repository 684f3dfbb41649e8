# SPDX-License-Identifier: GPL-3.0-or-later
"""Which packs each part of the results is made of. A part is a dictionary of groups of runs; one
pack that belongs to several parts is made once."""
from making import paper
from making.runs import Run

DT = 1e-4
LAYER_TIMES = (.5, 1.0, 2.0, 4.0)
FRICTIONS = (0.0, .05, .1, .2, .3, .5, 1.0)
FRICTIONS_3D = (0.0, .1, .2, 1.0)
PAPER_FRICTION = .2
PAPER_LAYER_TIME = 1.0
SLIP_EXAMPLES = ("5.1", "5.3")
SLIP_FACTORS = {"5.1": (.1, 1, 10), "5.3": (.1, 1)}
FINE_R = .01
REST_TIME_MAX = 3.0  # a layer that finds no rest ends then; bounds the cost of that part


class Plan:
    """How many packs each part takes, and the sizes of a quick trial."""

    def __init__(self, quick, packs=None):
        self.quick = quick
        few = (lambda n: min(n, 2)) if quick else (lambda n: n)
        self.table_packs = packs or few(10)
        self.rest_packs = {2: few(2), 3: few(1)}
        self.rule_packs = {2: few(10), 3: few(5)}
        self.time_packs = few(2)
        self.slip_packs = {2: few(10), 3: few(2)}
        self.friction_packs = {2: few(2), 3: few(1)}

    def run(self, example, rotations, pack, end="time", full="bed", layer_time=PAPER_LAYER_TIME,
            friction=None, slip=None, psd=None, picture=False):
        options = ["--example", example, "--rotations", rotations, "--layer-end", end,
                   "--full", full, "--seed", "1", "--stream", str(pack)]
        count, time = paper.LAYER_COUNT[example], layer_time
        if psd is not None:
            options += ["--psd", f"mono:{psd}"]
            count *= (.02 / psd) ** 3
        if friction is not None and friction != PAPER_FRICTION:
            options += ["--friction", repr(friction)]
        if slip is not None:
            options += ["--slip-velocity", repr(slip)]
        if end == "rest":
            time = REST_TIME_MAX
        if self.quick:
            layer, height = quick_sizes(example, psd)
            options += ["--layer-height", layer, "--height", height]
            time = .05 * layer_time
            options += ["--layer-time", repr(time)]
            options += ["--layer-time-max", repr(4 * time)] if end == "rest" else []
        elif end == "rest":
            options += ["--layer-time-max", repr(REST_TIME_MAX)]
        elif end == "time" and layer_time != PAPER_LAYER_TIME:
            options += ["--layer-time", repr(layer_time)]
        layers = paper.LAYERS[example]
        return Run(options, layers * (layers + 1) / 2 * count * time / DT, picture)

    def several(self, packs, *args, **named):
        return [self.run(*args, pack=k, **named) for k in range(packs)]

    def tables(self):
        return {(e, rot): self.several(self.table_packs, e, rot, picture=paper.DIM[e] == 3)
                for e in paper.EXAMPLES for rot in paper.ROTATIONS}

    def rest(self):
        return {(e, rot): self.several(self.rest_packs[paper.DIM[e]], e, rot, end="rest")
                for e in paper.EXAMPLES for rot in paper.ROTATIONS}

    def rules(self):
        return {(e, rot): self.several(self.rule_packs[paper.DIM[e]], e, rot, full="highest")
                for e in paper.EXAMPLES for rot in paper.ROTATIONS}

    def time(self):
        return {(rot, t): self.several(self.time_packs, "5.1", rot, layer_time=t)
                for rot in paper.ROTATIONS for t in LAYER_TIMES}

    def slip(self, default):
        """default: the program's own regularising velocity for each example; its packs are
        those of the tables."""
        def named(example, factor):
            return {} if factor == 1 else {"slip": default[example] * factor}
        return {(e, rot, factor): self.several(self.slip_packs[paper.DIM[e]], e, rot,
                                               **named(e, factor))
                for e in SLIP_EXAMPLES for rot in paper.ROTATIONS for factor in SLIP_FACTORS[e]}

    def friction(self):
        return {(e, rot, mu): self.several(self.friction_packs[paper.DIM[e]], e, rot,
                                           friction=mu)
                for e, sweep in (("5.1", FRICTIONS), ("5.3", FRICTIONS_3D))
                for rot in paper.ROTATIONS for mu in sweep}

    def fine(self):
        r = .02 if self.quick else FINE_R
        return {rot: [self.run("5.3", rot, 0, psd=r, picture=True)] for rot in paper.ROTATIONS}


def quick_sizes(example, psd):
    """Layer and asked height of a trial: two layers or so."""
    if paper.DIM[example] == 2:
        return "0.05", "0.04"
    return ("0.1", "0.06") if psd is None else ("0.1", "0.12")


ORDER = ("tables", "orderings", "rest", "rules", "time", "slip", "friction", "order", "fine")
# Parts that look at the packs of another one.
SEES = {"orderings": "tables", "order": "tables"}


def runs_of(groups):
    return [run for runs in groups.values() for run in runs]
