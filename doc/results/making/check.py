#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Holds the tests of stats.py against known values."""
import pathlib
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).parent.parent))
try:
    import numpy
except ImportError:
    print("skipped: python3-numpy is missing")
    sys.exit(77)
from making import paper, stats  # noqa: E402


def near(a, b, tolerance, what):
    if not abs(a - b) <= tolerance:
        sys.exit(f"{what}: {a} is not {b}")


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
    check_stats()
    print("statistics agree with known values")
