#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Holds the measures of order.py and the tests of stats.py against known values."""
import itertools
import math
import pathlib
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).parent.parent))
try:
    import numpy
except ImportError:
    print("skipped: python3-numpy is missing")
    sys.exit(77)
from making import order, paper, stats  # noqa: E402


def lattice(cell, basis, side):
    """Points of `side` cells along each axis; `cell` the edges, `basis` in parts of them."""
    corners = numpy.array(list(itertools.product(range(side), repeat=len(cell))), float)
    points = (corners[:, None, :] + numpy.array(basis)[None, :, :]).reshape(-1, len(cell))
    return points * numpy.array(cell)


CRYSTALS = {  # neighbours 1 apart
    "fcc": lattice([2 ** .5] * 3, [(0, 0, 0), (.5, .5, 0), (.5, 0, .5), (0, .5, .5)], 5),
    "hcp": lattice([1, 3 ** .5, (8 / 3) ** .5],
                   [(0, 0, 0), (.5, .5, 0), (0, 1 / 3, .5), (.5, 5 / 6, .5)], 6),
    "sc": lattice([1, 1, 1], [(0, 0, 0)], 6),
    "bcc": lattice([2 / 3 ** .5] * 3, [(0, 0, 0), (.5, .5, .5)], 6),
    "hexagonal": lattice([1, 3 ** .5], [(0, 0), (.5, .5)], 9),
}
# Crystal, reach, neighbours, q_6, sort by common neighbours.
KNOWN = (("fcc", 1.2, 12, .574524, "f"), ("hcp", 1.2, 12, .484762, "h"),
         ("sc", 1.2, 6, .353553, "-"), ("bcc", 1.1, 8, .628539, "-"),
         ("bcc", 1.2, 14, .510688, "-"))


def near(a, b, tolerance, what):
    if not abs(a - b) <= tolerance:
        sys.exit(f"{what}: {a} is not {b}")


def middle(x):
    return int(((x - x.mean(axis=0)) ** 2).sum(axis=1).argmin())


def check_crystals():
    for name, reach, count, q6, sort in KNOWN:
        x = CRYSTALS[name]
        i, j = order.neighbours(x, numpy.full(len(x), .5), reach)
        start, of = order.lists(len(x), i, j)
        k = middle(x)
        near(start[k + 1] - start[k], count, 0, name + " neighbours")
        near(order.bond_order(x, start, of)[k], q6, 1e-6, name + " q6")
        if order.crystal(start, of)[k] != sort:
            sys.exit(name + " is sorted wrongly")


def check_hexatic():
    x = CRYSTALS["hexagonal"]
    angle = .3
    turned = x @ numpy.array([[math.cos(angle), math.sin(angle)],
                              [-math.sin(angle), math.cos(angle)]])
    i, j = order.neighbours(turned, numpy.full(len(x), .5))
    psi, n = order.hexatic(turned, i, j)
    k = middle(x)
    near(n[k], 6, 0, "hexagonal neighbours")
    near(abs(psi[k]), 1, 1e-12, "hexagonal psi6")
    near(math.atan2(psi[k].imag, psi[k].real), math.remainder(6 * angle, 2 * math.pi), 1e-9,
         "angle of psi6")


def check_neighbours():
    rng = numpy.random.default_rng(1)
    for dim in (2, 3):
        x, r = rng.random((300, dim)), .03 + .05 * rng.random(300)
        i, j = order.neighbours(x, r)
        slow = [(a, b) for a in range(300) for b in range(a + 1, 300)
                if math.dist(x[a], x[b]) < order.REACH * (r[a] + r[b])]
        if list(zip(i.tolist(), j.tolist())) != slow:
            sys.exit("neighbours differ from all pairs")


def check_stats():
    near(stats.permutation_p([3, 4], [1, 2]), 1 / 6, 1e-15, "permutation test")
    near(stats.permutation_p([1, 2], [3, 4]), 1, 0, "permutation test")
    near(stats.permutation_p([1, 2, 3], [1, 2, 3]), 14 / 20, 1e-15, "permutation test with ties")
    near(stats.permutation_p(range(10, 20), range(10)), 1 / 184756, 1e-15, "exact 10 and 10")
    near(stats.deviation([1, 2, 3, 4]), (5 / 3) ** .5, 1e-15, "deviation")
    printed = {"5.1": ((.861, .012), (.837, .010)), "5.2": ((.825, .003), (.813, .007)),
               "5.3": ((.569, .015), (.539, .002)), "5.4": ((.573, .006), (.546, .005))}
    for example, both in printed.items():
        for rotations, (mean, deviation) in zip(paper.ROTATIONS, both):
            rows = paper.ROWS[example, rotations]
            near(stats.mean(rows), mean, 6e-4, f"mean of the paper's {example} {rotations}")
            near(stats.deviation(rows), deviation, 6e-4,
                 f"deviation of the paper's {example} {rotations}")


if __name__ == "__main__":
    check_crystals()
    check_hexatic()
    check_neighbours()
    check_stats()
    print("order and statistics agree with known values")
