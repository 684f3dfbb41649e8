#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""GenGeo (ESyS-Particle's pack generator): spheres with radii in [RMIN, RMAX] filling a box by
insertion. Run it with the Python that Debian's package python3-gengeo is made for.

usage: gengeo_box.py RMIN RMAX EDGE FAILS
"""
import sys
import time

from gengeo import BoxWithPlanes3D, InsertGenerator3D, MNTable3D, Plane, Vector3

rmin, rmax, edge, fails = *map(float, sys.argv[1:4]), int(sys.argv[4])
lo, hi = Vector3(0, 0, 0), Vector3(edge, edge, edge)
table = MNTable3D(minPoint=lo, maxPoint=hi, gridSize=2.2 * rmax, numGroups=1)
box = BoxWithPlanes3D(minPoint=lo, maxPoint=hi)
for point, sign in ((lo, 1), (hi, -1)):
    for normal in ((sign, 0, 0), (0, sign, 0), (0, 0, sign)):
        box.addPlane(Plane(point, Vector3(*normal)))
generator = InsertGenerator3D(minRadius=rmin, maxRadius=rmax, insertFails=fails,
                              maxIterations=1000, tolerance=1.0e-6)
start = time.time()
generator.generatePacking(volume=box, ntable=table, groupID=0, tag=1)
wall = time.time() - start
count = len(table.getSphereListFromGroup(0))
fraction = table.getSumVolume(groupID=0) / edge**3
print("GenGeo n %d phi %.4f wall %.2f s rate %.4g /s" % (count, fraction, wall, count / wall))
