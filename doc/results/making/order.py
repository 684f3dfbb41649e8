# SPDX-License-Identifier: GPL-3.0-or-later
"""How ordered a pack is: hexatic order of discs, bond order and common neighbours of spheres.

Two particles are neighbours when their centres are less than REACH (r_i + r_j) apart: REACH lies
between the first and the second shell of the close-packed lattices (1 and sqrt 2), in both
dimensions.
"""
import numpy

REACH = 1.2


def neighbours(x, r, reach=REACH):
    """Pairs (i, j), i < j, with |x_i - x_j| < reach (r_i + r_j).
    x: n by dim, r: n. Returns two index arrays, sorted by i and then j."""
    edge = 2 * reach * r.max()
    cell = numpy.floor((x - x.min(axis=0)) / edge).astype(numpy.int64) + 1
    size = cell.max(axis=0) + 2
    key = cell[:, 0]
    for axis in range(1, x.shape[1]):
        key = key * size[axis] + cell[:, axis]
    by_cell = numpy.argsort(key, kind="stable")
    sorted_key = key[by_cell]
    steps = numpy.indices((3,) * x.shape[1]).reshape(x.shape[1], -1).T - 1
    found_i, found_j = [], []
    for step in steps:
        shift = step[0]
        for axis in range(1, x.shape[1]):
            shift = shift * size[axis] + step[axis]
        first = numpy.searchsorted(sorted_key, key + shift, "left")
        count = numpy.searchsorted(sorted_key, key + shift, "right") - first
        i = numpy.repeat(numpy.arange(len(x)), count)
        offset = numpy.arange(count.sum()) - numpy.repeat(numpy.cumsum(count) - count, count)
        j = by_cell[numpy.repeat(first, count) + offset]
        keep = i < j
        i, j = i[keep], j[keep]
        apart2 = ((x[j] - x[i]) ** 2).sum(axis=1)
        near = apart2 < (reach * (r[i] + r[j])) ** 2
        found_i.append(i[near])
        found_j.append(j[near])
    i, j = numpy.concatenate(found_i), numpy.concatenate(found_j)
    by_pair = numpy.lexsort((j, i))
    return i[by_pair], j[by_pair]


def lists(n, i, j):
    """Neighbours of each particle: offsets (n + 1) into one array, sorted."""
    a, b = numpy.concatenate((i, j)), numpy.concatenate((j, i))
    by_pair = numpy.lexsort((b, a))
    return numpy.searchsorted(a[by_pair], numpy.arange(n + 1)), b[by_pair]


def hexatic(x, i, j):
    """psi_6 of each disc, (1/n) sum over its n neighbours of exp(6 i theta), and n; psi_6 is 0
    without neighbours. |psi_6| is 1 in the hexagonal lattice."""
    angle = numpy.arctan2(x[j, 1] - x[i, 1], x[j, 0] - x[i, 0])
    turn = numpy.exp(6j * angle)  # the same seen from either end
    n = numpy.bincount(i, minlength=len(x)) + numpy.bincount(j, minlength=len(x))
    total = sum(numpy.bincount(k, w, len(x)) * unit for k in (i, j)
                for w, unit in ((turn.real, 1), (turn.imag, 1j)))
    return total / numpy.maximum(n, 1), n


def legendre6(c):
    c2 = c * c
    return (((231 * c2 - 315) * c2 + 105) * c2 - 5) / 16


def bond_order(x, start, of):
    """q_6 of each sphere by the addition theorem of the spherical harmonics,
    q_6^2 = (1/n^2) sum_jk P_6(cos theta_jk) over pairs of its n bonds; 0 without neighbours."""
    q = numpy.zeros(len(x))
    count = numpy.diff(start)
    for n in numpy.unique(count[count > 0]):
        who = numpy.flatnonzero(count == n)
        bond = x[of[start[who][:, None] + numpy.arange(n)]] - x[who][:, None, :]
        bond /= numpy.sqrt((bond ** 2).sum(axis=2))[:, :, None]
        cosine = numpy.clip(bond @ bond.transpose(0, 2, 1), -1, 1)
        q[who] = numpy.sqrt(numpy.maximum(legendre6(cosine).mean(axis=(1, 2)), 0))
    return q


def longest_chain(bonds):
    """The most bonds of one connected piece."""
    pieces = []
    for a, b in bonds:
        touching = [p for p in pieces if a in p[0] or b in p[0]]
        pieces = [p for p in pieces if not (a in p[0] or b in p[0])]
        nodes = {a, b}.union(*(p[0] for p in touching))
        pieces.append((nodes, 1 + sum(p[1] for p in touching)))
    return max((p[1] for p in pieces), default=0)


def signature(a, b, near):
    """Common-neighbour signature of a bond: common neighbours, bonds among them, the longest
    chain of those bonds (Honeycutt and Andersen, J. Phys. Chem. 91, 4950, 1987)."""
    common = near[a] & near[b]
    bonds = [(c, d) for c in common for d in near[c] & common if c < d]
    return len(common), len(bonds), longest_chain(bonds)


def crystal(start, of):
    """What each sphere is a piece of: "f" fcc (twelve bonds, all 421), "h" hcp (six 421 and six
    422), "-" neither."""
    n = len(start) - 1
    near = [set(of[start[k]:start[k + 1]].tolist()) for k in range(n)]
    kind = numpy.full(n, "-")
    known = {}
    for k in numpy.flatnonzero(numpy.diff(start) == 12):
        marks = []
        for other in near[k]:
            pair = (min(k, other), max(k, other))
            if pair not in known:
                known[pair] = signature(k, other, near)
            marks.append(known[pair])
        fcc, hcp = marks.count((4, 2, 1)), marks.count((4, 2, 2))
        if fcc == 12:
            kind[k] = "f"
        elif fcc == 6 and hcp == 6:
            kind[k] = "h"
    return kind


def wall_distance(x, edge, height):
    """From the centres to the nearest of the walls of [0, edge]^(dim - 1) x [0, height]; the
    free surface counts as a wall."""
    top = numpy.array([edge] * (x.shape[1] - 1) + [height])
    return numpy.minimum(x, top - x).min(axis=1)


def discs(x, r, height):
    """Measures of one 2D pack; only discs at least two mean diameters from walls and surface
    count. local: mean |psi_6|; mean: |mean psi_6|; six: share of discs with six neighbours."""
    i, j = neighbours(x, r)
    psi, n = hexatic(x, i, j)
    inside = wall_distance(x, 1, height) >= 4 * r.mean()
    if not inside.any():
        inside[:] = True
    return {"local": float(numpy.abs(psi[inside]).mean()),
            "mean": float(abs(psi[inside].mean())),
            "six": float((n[inside] == 6).mean())}


def spheres(x, r, height, bins):
    """Measures of one 3D pack by distance to walls and surface in mean diameters: for each bin
    its count, mean q_6, shares of fcc and hcp; bins are [0, 1), [1, 2), ..., the last open."""
    i, j = neighbours(x, r)
    start, of = lists(len(x), i, j)
    q, kind = bond_order(x, start, of), crystal(start, of)
    depth = numpy.floor(wall_distance(x, 1, height) / (2 * r.mean())).astype(int)
    depth = numpy.clip(depth, 0, bins - 1)
    out = []
    for b in range(bins):
        here = depth == b
        n = int(here.sum())
        share = lambda mark: float((kind[here] == mark).mean()) if n else 0.0
        out.append({"from": b, "count": n, "q6": float(q[here].mean()) if n else 0.0,
                    "fcc": share("f"), "hcp": share("h")})
    return out
