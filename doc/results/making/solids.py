#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Closed meshes of the kinds in Figures 23 to 25 of Perez Morales et al.: a building with openings,
an arch bridge, a gear and a bone. The paper's own meshes are not published; these are shapes of ours,
scaled to a volume.

    solids.py NAME VOLUME FILE     NAME: building, bridge, gear, bone; FILE ends in .stl .obj .ply

Needs python3-numpy. Each mesh is checked: every edge belongs to two triangles that run through it
in opposite directions, and the volume is positive."""
import pathlib
import sys

import numpy


# ---- from cells: flat walls at right angles ----

def from_cells(lines, inside):
    """The surface of the cells of a rectilinear grid that are inside: `lines` are three rising
    lists of planes, inside[i, j, k] the cells between them."""
    padded = numpy.pad(inside, 1)
    shape = tuple(len(line) for line in lines)
    triangles = []
    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        below = numpy.moveaxis(padded, (axis, u, v), (0, 1, 2))[:, 1:-1, 1:-1]
        for side in (1, -1):  # leaving the inside upwards, downwards
            faces = below[:-1] & ~below[1:] if side > 0 else ~below[:-1] & below[1:]
            at, i, j = numpy.nonzero(faces)
            corners = []
            for di, dj in ((0, 0), (1, 0), (1, 1), (0, 1))[::side]:
                corner = numpy.empty((len(at), 3), dtype=int)
                corner[:, axis], corner[:, u], corner[:, v] = at, i + di, j + dj
                corners.append(numpy.ravel_multi_index(corner.T, shape))
            a, b, c, d = corners
            triangles += [numpy.stack((a, b, c), 1), numpy.stack((a, c, d), 1)]
    grid = numpy.stack(numpy.meshgrid(*lines, indexing="ij"), -1).reshape(-1, 3)
    return compact(grid, numpy.concatenate(triangles))


def compact(points, triangles):
    """Without the points that no triangle has."""
    used, index = numpy.unique(triangles, return_inverse=True)
    return numpy.asarray(points, float)[used], index.reshape(-1, 3)


def building():
    """Three floors of rooms round a court: slabs, walls with windows and doors, columns."""
    bays, floors = 5, 3
    x = numpy.sort(numpy.concatenate([[6 * i, 6 * i + 1, 6 * i + 2.5, 6 * i + 4.5]
                                      for i in range(bays)] + [[6 * bays, 6 * bays + 1]]))
    z = numpy.sort(numpy.concatenate([[5 * k, 5 * k + 1, 5 * k + 2, 5 * k + 4]
                                      for k in range(floors)] + [[5 * floors, 5 * floors + 1]]))
    n, m = len(x) - 1, len(z) - 1
    i, j, k = numpy.meshgrid(numpy.arange(n), numpy.arange(n), numpy.arange(m), indexing="ij")
    wall_x, wall_y, slab = i % 4 == 0, j % 4 == 0, k % 4 == 0
    window = (k % 4 == 2) & (((i % 4 == 2) & wall_y) | ((j % 4 == 2) & wall_x))
    inside = (wall_x | wall_y | slab) & ~window
    middle = 4 * (bays // 2)
    court = (i > middle) & (i < middle + 4) & (j > middle) & (j < middle + 4)
    return from_cells((x, x, z), inside & ~(court & (k > 0)))


# ---- prisms: an outline drawn along an axis ----

def bridge():
    """A deck of 14 on five arches and six piers, 24 of them high, with parapets' width left out: an
    outline in x and z, drawn along y."""
    spans, span, pier, rise, deck = 5, 40.0, 8.0, 20.0, 6.0
    length, top = spans * span + (spans + 1) * pier, 24.0 + deck
    outline = [(0.0, 0.0)]
    for s in range(spans):
        left = pier + s * (span + pier)
        outline.append((left, 0.0))
        for angle in numpy.linspace(numpy.pi, 0, 25):
            outline.append((left + span / 2 * (1 + numpy.cos(angle)), 4 + rise * numpy.sin(angle)))
        outline.append((left + span, 0.0))
    outline += [(length, 0.0), (length, top), (0.0, top)]
    return prism(outline, 14.0)


def prism(outline, depth):
    """Counterclockwise in x and z, seen against y; along y from 0."""
    n = len(outline)
    caps = numpy.array(ears(outline))
    near = numpy.array([(x, 0.0, z) for x, z in outline])
    far = near + (0.0, depth, 0.0)
    i = numpy.arange(n)
    j = (i + 1) % n
    sides = [numpy.stack((i, j, j + n), 1), numpy.stack((i, j + n, i + n), 1)]
    return (numpy.concatenate((near, far)),
            numpy.concatenate([caps, caps[:, ::-1] + n, *[side[:, ::-1] for side in sides]]))


def ears(outline):
    """Triangles of a simple polygon, counterclockwise, by cutting off ears."""
    def turn(a, b, c):
        return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])

    def is_ear(left, k):
        a, b, c = (left[(k + d) % len(left)] for d in (-1, 0, 1))
        p, q, r = outline[a], outline[b], outline[c]
        if turn(p, q, r) <= 0:
            return None
        for other in left:
            s = outline[other]
            if other not in (a, b, c) and min(turn(p, q, s), turn(q, r, s), turn(r, p, s)) >= 0:
                return None
        return a, b, c

    left, triangles = list(range(len(outline))), []
    while len(left) > 3:
        for k in range(len(left)):
            ear = is_ear(left, k)
            if ear:
                triangles.append(ear)
                del left[k]
                break
        else:
            raise ValueError("not a simple polygon, counterclockwise")
    return triangles + [tuple(left)]


def gear():
    """A spur gear of 24 teeth with a bore: two rings of points round an axis, drawn along it."""
    teeth, outer, root, bore, width = 24, 12.0, 10.4, 4.0, 6.0
    angles, radii = [], []
    for t in range(teeth):
        for share, r in ((0.0, root), (0.2, root), (0.32, outer), (0.68, outer), (0.8, root)):
            angles.append(2 * numpy.pi * (t + share) / teeth)
            radii.append(r)
    angles, radii, n = numpy.array(angles), numpy.array(radii), len(angles)
    ring = numpy.stack((numpy.cos(angles), numpy.sin(angles)), 1)
    points = [numpy.column_stack((ring * r, numpy.full(n, z)))
              for z in (0.0, width) for r in (radii[:, None], bore)]
    outer0, inner0, outer1, inner1 = (numpy.arange(n) + k * n for k in range(4))

    def strip(a, b):
        c, d = numpy.roll(a, -1), numpy.roll(b, -1)
        return [numpy.stack((a, c, d), 1), numpy.stack((a, d, b), 1)]

    faces = (strip(outer0, outer1) + strip(inner1, inner0) + strip(inner0, outer0) +
             strip(outer1, inner1))
    return numpy.concatenate(points), numpy.concatenate(faces)


# ---- from a function: smooth bodies ----

# The six tetrahedra of a cube round its long diagonal; corners as bits x, y, z.
TETRAHEDRA = ((0, 1, 3, 7), (0, 3, 2, 7), (0, 2, 6, 7), (0, 6, 4, 7), (0, 4, 5, 7), (0, 5, 1, 7))


def from_function(function, lo, hi, cells):
    """Marching tetrahedra: the surface where the function is 0, positive inside. Points lie on the
    edges of the tetrahedra, so that neighbours share them and the surface is closed."""
    lo, hi = numpy.array(lo, float), numpy.array(hi, float)
    step = (hi - lo).max() / cells
    shape = tuple(numpy.ceil((hi - lo) / step).astype(int) + 1)
    grid = numpy.stack(numpy.meshgrid(*(numpy.arange(n) for n in shape), indexing="ij"), -1)
    points = lo + step * grid.reshape(-1, 3)
    values = function(points)
    # A value near 0 would bring needles: it goes to one side.
    values = numpy.where(numpy.abs(values) < 0.02 * step, 0.02 * step, values)
    base = numpy.ravel_multi_index(
        numpy.stack(numpy.meshgrid(*(numpy.arange(n - 1) for n in shape), indexing="ij"),
                    -1).reshape(-1, 3).T, shape)
    offset = [numpy.ravel_multi_index((c & 1, c >> 1 & 1, c >> 2), shape) for c in range(8)]
    faces = [face for four in TETRAHEDRA
             for face in cut_tetrahedra(numpy.stack([base + offset[c] for c in four], 1), values)]
    edges = numpy.sort(numpy.concatenate(faces), axis=2).reshape(-1, 2)
    unique, index = numpy.unique(edges, axis=0, return_inverse=True)
    a, b = values[unique[:, 0]], values[unique[:, 1]]
    t = (a / (a - b))[:, None]
    surface = (1 - t) * points[unique[:, 0]] + t * points[unique[:, 1]]
    return surface, index.reshape(-1, 3)


def cut_tetrahedra(four, values):
    """Triangles as (n, 3, 2): each corner the edge it lies on. The tetrahedra are positively
    oriented; outsides come first in each case."""
    inside = values[four] > 0
    for case in range(1, 15):
        of = [c for c in range(4) if case >> c & 1]
        out = [c for c in range(4) if c not in of]
        rows = four[(inside == [bool(case >> c & 1) for c in range(4)]).all(1)]
        if len(rows) == 0:
            continue
        if len(of) == 2:
            (a, b), (c, d) = of, out
            quad = ((a, c), (a, d), (b, d), (b, c))
            corners = ((quad[0], quad[1], quad[2]), (quad[0], quad[2], quad[3]))
            order = of + out
        else:
            one, rest = (of[0], out) if len(of) == 1 else (out[0], of)
            corners = (tuple((one, k) for k in rest),)
            order = [one] + rest
        even = parity(order)
        # With one inside (a, b, c, d even) its cut, seen from outside, runs b, c, d.
        flip = even if len(of) == 3 else not even
        for triangle in corners:
            edge = numpy.stack([rows[:, list(pair)] for pair in triangle], 1)
            yield edge[:, ::-1] if flip else edge


def parity(order):
    """Whether a permutation is even."""
    return sum(order[i] > order[j] for i in range(4) for j in range(i + 1, 4)) % 2 == 0


def smooth_union(a, b, width):
    """Of two distances, positive inside (a polynomial blend)."""
    h = numpy.clip(0.5 + 0.5 * (a - b) / width, 0, 1)
    return b + (a - b) * h + width * h * (1 - h)


def bone():
    """A shaft that widens into two knuckles at one end, and into a neck with a ball at the other."""
    def ball(p, centre, r):
        return r - numpy.linalg.norm(p - centre, axis=1)

    def rod(p, a, b, ra, rb):
        a, along = numpy.array(a, float), numpy.subtract(b, a)
        t = numpy.clip((p - a) @ along / (along @ along), 0, 1)
        return ra + (rb - ra) * t - numpy.linalg.norm(p - a - t[:, None] * along, axis=1)

    def function(p):
        shape = rod(p, (0, 0, 0), (0, 0, 20), 1.9, 1.6)
        for part in (ball(p, (-1.6, 0, -1), 2.4), ball(p, (1.6, 0, -1), 2.4),
                     rod(p, (0, 0, 19), (3.5, 0.5, 23), 1.7, 1.4), ball(p, (4.2, 0.6, 24), 2.3),
                     ball(p, (-0.8, 0, 21.5), 1.7)):
            shape = smooth_union(shape, part, 1.2)
        return shape

    return from_function(function, (-6, -5, -6), (9, 5, 29), 110)


# ---- checks and files ----

def volume_of(points, triangles):
    a, b, c = (points[triangles[:, k]] for k in range(3))
    return float((a * numpy.cross(b, c)).sum()) / 6


def check(points, triangles):
    """Closed, and oriented outwards."""
    edges = numpy.concatenate([triangles[:, [i, (i + 1) % 3]] for i in range(3)])
    n = len(points)
    there = edges[:, 0].astype(numpy.int64) * n + edges[:, 1]
    back = edges[:, 1].astype(numpy.int64) * n + edges[:, 0]
    if len(numpy.unique(there)) != len(there):
        raise ValueError("an edge is run through twice in one direction")
    if not numpy.array_equal(numpy.sort(there), numpy.sort(back)):
        raise ValueError("the surface is open")
    if volume_of(points, triangles) <= 0:
        raise ValueError("inside out")


def make(name, volume):
    """Points and triangles of a solid of that volume, its lowest corner at the origin."""
    points, triangles = SOLIDS[name]()
    check(points, triangles)
    points = points - points.min(axis=0)
    return points * (volume / volume_of(points, triangles)) ** (1 / 3), triangles


def write(path, points, triangles):
    path = pathlib.Path(path)
    if path.suffix == ".stl":
        record = numpy.zeros(len(triangles), dtype=[("n", "<f4", 3), ("v", "<f4", (3, 3)),
                                                    ("a", "<u2")])
        record["v"] = points[triangles]
        path.write_bytes(bytes(80) + numpy.uint32(len(triangles)).tobytes() + record.tobytes())
        return
    corners = "\n".join("%s%.17g %.17g %.17g" % (("v " if path.suffix == ".obj" else "",) +
                                                tuple(p)) for p in points)
    if path.suffix == ".obj":
        faces = "\n".join("f %d %d %d" % tuple(t + 1) for t in triangles)
        path.write_text(corners + "\n" + faces + "\n")
        return
    faces = "\n".join("3 %d %d %d" % tuple(t) for t in triangles)
    path.write_text("ply\nformat ascii 1.0\nelement vertex %d\nproperty double x\n"
                    "property double y\nproperty double z\nelement face %d\n"
                    "property list uchar int vertex_indices\nend_header\n%s\n%s\n"
                    % (len(points), len(triangles), corners, faces))


SOLIDS = {"building": building, "bridge": bridge, "gear": gear, "bone": bone}


def main():
    if len(sys.argv) != 4 or sys.argv[1] not in SOLIDS:
        sys.exit(__doc__)
    name, volume, path = sys.argv[1], float(sys.argv[2]), sys.argv[3]
    points, triangles = make(name, volume)
    write(path, points, triangles)
    print("%s: %d triangles, %s" % (name, len(triangles), points.max(axis=0)))


if __name__ == "__main__":
    main()
