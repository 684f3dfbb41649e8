# SPDX-License-Identifier: GPL-3.0-or-later
"""Closed meshes in binary STL: those of solids.py, scaled to a volume."""
import pathlib
import subprocess
import sys

import numpy

HERE = pathlib.Path(__file__).resolve().parent
RECORD = [("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("more", "<u2")]


def read(path):
    """Corners, (n, 3, 3)."""
    return numpy.frombuffer(pathlib.Path(path).read_bytes()[84:], dtype=RECORD)["corners"]


def volume_of(corners):
    a, b, c = numpy.moveaxis(corners.astype(float), 1, 0)
    return float((a * numpy.cross(b, c)).sum()) / 6


def write(path, corners):
    """Equal corners stay equal, so a closed surface stays closed."""
    record = numpy.zeros(len(corners), dtype=RECORD)
    record["corners"] = corners
    pathlib.Path(path).write_bytes(bytes(80) + numpy.uint32(len(corners)).tobytes() +
                                   record.tobytes())


def make(name, volume, path):
    """The solid of that name in a file, of that volume but for rounding to single precision."""
    subprocess.run([sys.executable, str(HERE / "solids.py"), name, str(path)], check=True,
                   stdout=subprocess.DEVNULL)
    corners = read(path)
    write(path, corners * (volume / volume_of(corners)) ** (1 / 3))
