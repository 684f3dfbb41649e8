# SPDX-License-Identifier: GPL-3.0-or-later
"""Means, deviations and an exact test."""
import itertools
import math

import numpy

SPLITS = 2_000_000  # more than these are drawn at random instead of enumerated


def mean(values):
    return math.fsum(values) / len(values) if values else math.nan


def deviation(values):
    """Standard deviation with n - 1."""
    if len(values) < 2:
        return math.nan
    m = mean(values)
    return math.sqrt(math.fsum((v - m) ** 2 for v in values) / (len(values) - 1))


def variation(values):
    """Coefficient of variation."""
    return deviation(values) / mean(values)


def standard_error(a, b):
    """Of the difference of two means."""
    return math.sqrt(deviation(a) ** 2 / len(a) + deviation(b) ** 2 / len(b))


def permutation_p(above, below):
    """One-sided permutation test of mean(above) > mean(below): the share of all ways to split
    the pooled values into groups of these sizes whose difference of means is as large or
    larger. Exact (184756 splits for 10 and 10); where there are more than two million splits,
    a million random ones with a fixed seed."""
    pooled = numpy.array(list(above) + list(below), float)
    n, k = len(pooled), len(above)
    slack = 1e-12 * numpy.abs(pooled).sum()
    asked = float(numpy.sum(above)) - slack
    if math.comb(n, k) <= SPLITS:
        return share_of_splits(pooled, k, asked)
    rng = numpy.random.Generator(numpy.random.Philox(1))
    hits = sum(rng.permutation(pooled)[:k].sum() >= asked for _ in range(SPLITS // 2))
    return (hits + 1) / (SPLITS // 2 + 1)


def share_of_splits(pooled, k, asked):
    splits = itertools.combinations(range(len(pooled)), k)
    hits = total = 0
    while True:
        block = numpy.fromiter(itertools.chain.from_iterable(itertools.islice(splits, 100_000)),
                               numpy.intp)
        if block.size == 0:
            return hits / total
        sums = pooled[block.reshape(-1, k)].sum(axis=1)
        hits += int((sums >= asked).sum())
        total += len(sums)
