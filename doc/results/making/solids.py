#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes closed triangle meshes as binary STL, to be filled: a building, an arch bridge, a gear and a
bone (the kinds of Figures 23 to 25 of Perez Morales et al.).

usage: solids.py building|bridge|part|bone FILE.stl [KEY=VALUE ...]
       solids.py all DIRECTORY

Every surface is closed by the way it is made, so packing_mesh_check() finds nothing: the building is
the border of a set of cells of one grid, bridge and gear are prisms over triangulated polygons that
share their corners, the bone comes by marching tetrahedra.
"""
import itertools
import math
import struct
import sys

DEFAULTS = {
    # lengths in metres; wall is also the thickness of slabs
    "building": {"length": 24, "width": 14, "storey": 3.2, "storeys": 4, "bays": 6, "wall": 0.4,
                 "column": 0.6},
    "bridge": {"span": 30, "arches": 4, "width": 10, "rise": 12, "pier": 4, "crown": 2,
               "pier_height": 10, "steps": 40},
    "part": {"teeth": 24, "radius": 60, "tooth": 9, "thickness": 18, "hub": 22, "hub_height": 32,
             "bore": 12, "holes": 6, "steps": 64},
    "bone": {"length": 400, "cells": 64},
}


def write_stl(path, triangles, name):
    """Triangles of three points each; normals are left to the reader."""
    with open(path, "wb") as out:
        out.write(f"{name}, closed".encode().ljust(80)[:80])
        out.write(struct.pack("<I", len(triangles)))
        for t in triangles:
            out.write(struct.pack("<12fH", 0, 0, 0, *t[0], *t[1], *t[2], 0))


# ---- cells of a grid ----

def border_of_cells(lines, solid):
    """The faces between cells that are solid and those that are not, two triangles each."""
    triangles = []
    sizes = [len(line) - 1 for line in lines]

    def is_solid(cell):
        return all(0 <= cell[k] < sizes[k] for k in range(3)) and solid(*cell)

    for i in range(sizes[0]):
        for j in range(sizes[1]):
            for k in range(sizes[2]):
                if is_solid((i, j, k)):
                    add_faces(triangles, lines, (i, j, k), is_solid)
    return triangles


def add_faces(triangles, lines, cell, is_solid):
    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        for high in (0, 1):
            beside = list(cell)
            beside[axis] += 2 * high - 1
            if is_solid(tuple(beside)):
                continue
            corners = []
            for du, dv in ((0, 0), (1, 0), (1, 1), (0, 1)):
                at = [0, 0, 0]
                at[axis] = lines[axis][cell[axis] + high]
                at[u] = lines[u][cell[u] + du]
                at[v] = lines[v][cell[v] + dv]
                corners.append(tuple(at))
            if not high:
                corners.reverse()
            triangles.append((corners[0], corners[1], corners[2]))
            triangles.append((corners[0], corners[2], corners[3]))


def intervals(size, count, thick):
    """`count` bays between count + 1 walls of a thickness; the lines, and which bays are walls."""
    step = (size - thick) / count
    lines = []
    for i in range(count + 1):
        lines += [i * step, i * step + thick]
    return lines


def building(p):
    """Slabs, columns inside, outer walls with a window in each bay, a door below."""
    bays_x, bays_y, storeys = int(p["bays"]), max(1, int(p["bays"] * p["width"] / p["length"])), \
        int(p["storeys"])
    wall, column = p["wall"], p["column"]
    outer_x, outer_y = intervals(p["length"], bays_x, wall), intervals(p["width"], bays_y, wall)
    # within each bay: a third of wall, a third of window, a third of wall; columns at the walls' ends
    x, y = refine(outer_x, column, wall), refine(outer_y, column, wall)
    z = []
    for s in range(storeys):
        base = s * p["storey"]
        z += [base, base + wall, base + wall + 0.35 * (p["storey"] - wall),
              base + wall + 0.8 * (p["storey"] - wall)]
    z += [storeys * p["storey"], storeys * p["storey"] + wall]

    def part(lines, i, size, count):
        """Of cell i: in an outer wall, in a window's width, in a column's."""
        step = (size - wall) / count
        middle = 0.5 * (lines[i] + lines[i + 1])
        at = middle % step
        return (middle < wall or middle > size - wall,
                wall + (step - wall) / 3 < at < wall + 2 * (step - wall) / 3,
                at < wall or at > step - (column - wall) / 2 or at < wall + (column - wall) / 2)

    x_parts = [part(x, i, p["length"], bays_x) for i in range(len(x) - 1)]
    y_parts = [part(y, i, p["width"], bays_y) for i in range(len(y) - 1)]

    def solid(i, j, k):
        if k % 4 == 0:  # a slab
            return True
        wall_x, window_x, column_x = x_parts[i]
        wall_y, window_y, column_y = y_parts[j]
        if not (wall_x or wall_y):
            return column_x and column_y
        if wall_x and wall_y:
            return True
        window = window_y if wall_x else window_x
        is_door = k < 4 and wall_y and window and i == middle_window(x_parts)
        return not (window and (k % 4 == 2 or (is_door and k % 4 == 1)))

    return border_of_cells((x, y, z), solid)


def middle_window(parts):
    windows = [i for i, (_, window, _) in enumerate(parts) if window]
    return windows[len(windows) // 2]


def refine(lines, column, wall):
    """Lines of walls with those of windows and of columns between them."""
    more = set(lines)
    for i in range(1, len(lines) - 1, 2):
        a, b = lines[i], lines[i + 1]
        more |= {a + (b - a) / 3, a + 2 * (b - a) / 3}
        more |= {a + (column - wall) / 2, b - (column - wall) / 2}
    return sorted(more)


# ---- prisms ----

def area2(a, b, c):
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def in_triangle(p, a, b, c):
    return area2(a, b, p) >= 0 and area2(b, c, p) >= 0 and area2(c, a, p) >= 0


def clip_ears(polygon):
    """Triangles of a counter-clockwise polygon; the fattest ear first keeps needles rare."""
    points = list(polygon)
    triangles = []
    while len(points) > 3:
        best, best_quality = None, 0
        for i in range(len(points)):
            a, b, c = points[i - 1], points[i], points[(i + 1) % len(points)]
            size = area2(a, b, c)
            if size <= 0:
                continue
            longest = max(math.dist(a, b), math.dist(b, c), math.dist(c, a))
            quality = size / longest ** 2
            if quality <= best_quality:
                continue
            if any(p not in (a, b, c) and in_triangle(p, a, b, c) for p in points):
                continue
            best, best_quality = i, quality
        a, b, c = points[best - 1], points[best], points[(best + 1) % len(points)]
        triangles.append((a, b, c))
        del points[best]
    triangles.append(tuple(points))
    return triangles


def crosses(a, b, p, q):
    return (len({a, b, p, q}) == 4 and area2(a, b, p) * area2(a, b, q) <= 0 and
            area2(p, q, a) * area2(p, q, b) <= 0)


def join_holes(outer, holes):
    """One polygon: each (clockwise) hole is tied in by a pair of edges, shortest first."""
    polygon, left = list(outer), [list(hole) for hole in holes]
    while left:
        rings = [polygon] + left
        edges = [(r[i - 1], r[i]) for r in rings for i in range(len(r))]
        ways = sorted((math.dist(p, q), i, h, j) for i, p in enumerate(polygon)
                      for h, hole in enumerate(left) for j, q in enumerate(hole))
        for _, i, h, j in ways:
            p, q = polygon[i], left[h][j]
            inside = area2(polygon[i - 1], p, polygon[(i + 1) % len(polygon)]) > 0
            if inside and not any(crosses(p, q, a, b) for a, b in edges):
                hole = left.pop(h)
                polygon = polygon[:i + 1] + hole[j:] + hole[:j + 1] + polygon[i:]
                break
    return polygon


def flat(outer, holes, z, up):
    """A triangulated face at a height, seen from above or from below."""
    faces = []
    for a, b, c in clip_ears(join_holes(outer, holes)):
        t = ((*a, z), (*b, z), (*c, z))
        faces.append(t if up else (t[0], t[2], t[1]))
    return faces


def upright(ring, low, high):
    """Walls over a ring; the solid is on the left of its way."""
    faces = []
    for i, b in enumerate(ring):
        a = ring[i - 1]
        faces.append(((*a, low), (*b, low), (*b, high)))
        faces.append(((*a, low), (*b, high), (*a, high)))
    return faces


def prism(outer, holes, low, high):
    faces = flat(outer, holes, low, False) + flat(outer, holes, high, True)
    for ring in [outer] + holes:
        faces += upright(ring, low, high)
    return faces


def bridge(p):
    """Its side view (along x, z), then turned upright: filled arches between piers, a deck."""
    span, arches, pier, steps = p["span"], int(p["arches"]), p["pier"], int(p["steps"])
    length = arches * span + (arches + 1) * pier
    spring, top = p["pier_height"], p["pier_height"] + p["rise"] + p["crown"]
    low = [(0.0, 0.0)]
    for n in range(arches):
        x = pier + n * (span + pier)
        low.append((x, 0.0))
        for i in range(steps + 1):
            a = math.pi * (1 - i / steps)
            low.append((x + 0.5 * span * (1 + math.cos(a)), spring + p["rise"] * math.sin(a)))
        low.append((x + span, 0.0))
    low += [(length, 0.0), (length, top)]
    # the deck rises a little to the middle
    deck = [(length * (1 - i / (4 * steps)),
             top + 0.02 * length * math.sin(math.pi * i / (4 * steps)))
            for i in range(1, 4 * steps)]
    ring = low + deck + [(0.0, top)]
    # points (x, z) of the side view stand at (x, y, z): turned about x
    return [tuple((x, p["width"] - y, z) for x, z, y in t) for t in prism(ring, [], 0.0, p["width"])]


def circle(x, y, r, steps, clockwise):
    sign = -1 if clockwise else 1
    return [(x + r * math.cos(sign * 2 * math.pi * i / steps),
             y + r * math.sin(sign * 2 * math.pi * i / steps)) for i in range(steps)]


def part(p):
    """A gear with a bore, holes and a hub that stands out."""
    teeth, steps = int(p["teeth"]), int(p["steps"])
    gear = []
    for i in range(teeth):
        for at, out in ((-0.28, 0), (-0.14, 1), (0.14, 1), (0.28, 0)):
            a, r = 2 * math.pi * (i + at) / teeth, p["radius"] + out * p["tooth"]
            gear.append((r * math.cos(a), r * math.sin(a)))
    middle = 0.5 * (p["hub"] + p["radius"])
    size = 0.3 * (p["radius"] - p["hub"])
    count = int(p["holes"])
    holes = [circle(middle * math.cos(2 * math.pi * i / count),
                    middle * math.sin(2 * math.pi * i / count), size, steps // 2, True)
             for i in range(count)]
    bore, hub_hole = circle(0, 0, p["bore"], steps, True), circle(0, 0, p["hub"], steps, True)
    hub = hub_hole[::-1]
    low, high, top = 0.0, p["thickness"], p["hub_height"]
    faces = flat(gear, holes + [bore], low, False)
    faces += flat(gear, holes + [hub_hole], high, True) + flat(hub, [bore], top, True)
    faces += upright(gear, low, high) + upright(bore, low, top) + upright(hub, high, top)
    for hole in holes:
        faces += upright(hole, low, high)
    return faces


# ---- implicit surfaces ----

def capsule(p, a, b, r):
    """Distance from a rod with round ends."""
    ab = [b[k] - a[k] for k in range(3)]
    ap = [p[k] - a[k] for k in range(3)]
    t = sum(x * y for x, y in zip(ap, ab)) / sum(x * x for x in ab)
    t = min(1.0, max(0.0, t))
    return math.sqrt(sum((ap[k] - t * ab[k]) ** 2 for k in range(3))) - r


def smooth_least(values, k):
    least = min(values)
    return least - k * math.log(sum(math.exp((least - v) / k) for v in values))


def bone_at(x, y, z):
    """A thigh bone of length 1 along z: a shaft, a head on a neck, two condyles."""
    p = (x, y, z)
    bend = 0.02 * math.sin(math.pi * z)
    return smooth_least((
        capsule((x - bend, y, z), (0, 0, 0.12), (0, 0, 0.86), 0.036 + 0.01 * (2 * z - 1) ** 2),
        capsule(p, (0, 0, 0.86), (0.11, 0.01, 0.94), 0.030),
        capsule(p, (0.115, 0.01, 0.945), (0.116, 0.01, 0.946), 0.052),
        capsule(p, (-0.035, 0, 0.89), (-0.034, 0, 0.90), 0.045),
        capsule(p, (0.035, -0.035, 0.06), (0.035, 0.03, 0.06), 0.042),
        capsule(p, (-0.035, -0.035, 0.06), (-0.035, 0.03, 0.06), 0.042)), 0.012)


CORNERS = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))
# Six around the diagonal from 0 to 6, all of one orientation.
TETRAHEDRA = tuple((0, a, b, 6) for a, b in ((1, 2), (2, 3), (3, 7), (7, 4), (4, 5), (5, 1)))
BLOCK = 4  # cells; a block that the surface cannot reach is left out


def march(value, lo, step, cells):
    """The surface value = 0, negative inside; the value must change no faster than the way gone. A
    corner on an edge keeps a twentieth of it from both ends, so that no triangle shrinks to nothing."""
    values = {}
    triangles = []

    def at_node(a):
        if a not in values:
            values[a] = value(*(lo[n] + a[n] * step for n in range(3)))
        return values[a]

    def between(a, b):
        if a > b:
            a, b = b, a
        t = min(0.95, max(0.05, values[a] / (values[a] - values[b])))
        return tuple(lo[n] + step * (a[n] + t * (b[n] - a[n])) for n in range(3))

    def cell(i, j, k):
        at = [(i + c[0], j + c[1], k + c[2]) for c in CORNERS]
        inside = [at_node(a) < 0 for a in at]
        if any(inside) and not all(inside):
            for tetrahedron in TETRAHEDRA:
                march_tetrahedron([at[n] for n in tetrahedron], values, between, triangles)

    for block in boxes([(0, (n + BLOCK - 1) // BLOCK) for n in cells]):
        middle = [lo[n] + (block[n] + 0.5) * BLOCK * step for n in range(3)]
        if abs(value(*middle)) < 0.9 * BLOCK * step:
            for at in boxes([(b * BLOCK, min((b + 1) * BLOCK, n)) for b, n in zip(block, cells)]):
                cell(*at)
    return triangles


def boxes(ranges):
    return itertools.product(*(range(*r) for r in ranges))


def march_tetrahedron(corner, values, between, triangles):
    """Of a tetrahedron of positive orientation."""
    inside = [n for n in range(4) if values[corner[n]] < 0]
    outside = [n for n in range(4) if n not in inside]
    if not inside or not outside:
        return
    order = inside + outside
    odd = sum(order[i] > order[j] for i in range(4) for j in range(i + 1, 4)) % 2
    a, b, c, d = (corner[n] for n in order)
    if len(inside) == 1:
        faces = [(between(a, b), between(a, c), between(a, d))]
    elif len(inside) == 3:
        faces = [(between(a, d), between(b, d), between(c, d))]
    else:
        ac, ad, bc, bd = between(a, c), between(a, d), between(b, c), between(b, d)
        faces = [(ac, ad, bd), (ac, bd, bc)]
    triangles += [(f[0], f[2], f[1]) if odd else f for f in faces]


def bone(p):
    lo, hi = (-0.12, -0.12, -0.03), (0.21, 0.12, 1.05)
    step = 0.33 / p["cells"]
    cells = [math.ceil((hi[k] - lo[k]) / step) for k in range(3)]
    size = p["length"]
    return [tuple(tuple(size * x for x in v) for v in t)
            for t in march(bone_at, lo, step, cells)]


SOLIDS = {"building": building, "bridge": bridge, "part": part, "bone": bone}


def volume(triangles):
    return sum(a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
               a[2] * (b[0] * c[1] - b[1] * c[0]) for a, b, c in triangles) / 6


def make(kind, path, options):
    p = dict(DEFAULTS[kind])
    for option in options:
        key, _, value = option.partition("=")
        if key not in p:
            sys.exit(f"{kind}: {key} is none of {', '.join(p)}")
        p[key] = float(value)
    triangles = SOLIDS[kind](p)
    write_stl(path, triangles, kind)
    print(f"{path}: {len(triangles)} triangles, volume {volume(triangles):.6g}")


def main(arguments):
    if len(arguments) >= 2 and arguments[0] in SOLIDS:
        make(arguments[0], arguments[1], arguments[2:])
    elif len(arguments) == 2 and arguments[0] == "all":
        for kind in SOLIDS:
            make(kind, f"{arguments[1]}/{kind}.stl", [])
    else:
        sys.exit(__doc__)


if __name__ == "__main__":
    main(sys.argv[1:])
