# SPDX-License-Identifier: GPL-3.0-or-later
"""How ordered a pack is: means of what packing-measure finds of each particle (--order-list),
over particles away from walls and surface."""
import csv
import pathlib
import subprocess
import tempfile

import numpy

# Neighbours are at most so many r_i + r_j apart: between the first and the second shell of the
# close-packed lattices (1 and sqrt 2), in both dimensions.
REACH = "1.2"


def of_each(program, pack):
    """The columns of --order-list by name; that of structures is text. packing-measure, file."""
    with tempfile.TemporaryDirectory() as folder:
        table = pathlib.Path(folder) / "order.csv"
        command = [program, "--in", str(pack), "--order", REACH, "--order-list", str(table),
                   "--threads", "1", "--quiet", "--report", str(pathlib.Path(folder) / "r.json")]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise SystemExit(f"{' '.join(command)}\nexit {done.returncode}\n{done.stderr}")
        with open(table, encoding="ascii") as file:
            header, *rows = csv.reader(file)
    return {name: numpy.array(column, dtype=str if name == "structure" else float)
            for name, column in zip(header, zip(*rows))}


def wall_distance(x, edge, height):
    """From the centres to the nearest of the walls of [0, edge]^(dim - 1) x [0, height]; the
    free surface counts as a wall."""
    top = numpy.array([edge] * (x.shape[1] - 1) + [height])
    return numpy.minimum(x, top - x).min(axis=1)


def discs(x, r, height, found):
    """Measures of one 2D pack; only discs at least two mean diameters from walls and surface
    count. local: mean |psi_6|; mean: |mean psi_6|; six: share of discs with six neighbours."""
    inside = wall_distance(x, 1, height) >= 4 * r.mean()
    if not inside.any():
        inside[:] = True
    return {"local": float(found["psi6"][inside].mean()),
            "mean": float(numpy.hypot(found["psi6_re"][inside].mean(),
                                      found["psi6_im"][inside].mean())),
            "six": float((found["neighbours"][inside] == 6).mean())}


def spheres(x, r, height, bins, found):
    """Measures of one 3D pack by distance to walls and surface in mean diameters: for each bin
    its count, mean q_6, shares of fcc and hcp; bins are [0, 1), [1, 2), ..., the last open."""
    depth = numpy.floor(wall_distance(x, 1, height) / (2 * r.mean())).astype(int)
    depth = numpy.clip(depth, 0, bins - 1)
    out = []
    for b in range(bins):
        here = depth == b
        n = int(here.sum())
        share = lambda name: float((found["structure"][here] == name).mean()) if n else 0.0
        out.append({"from": b, "count": n, "q6": float(found["q6"][here].mean()) if n else 0.0,
                    "fcc": share("fcc"), "hcp": share("hcp")})
    return out
