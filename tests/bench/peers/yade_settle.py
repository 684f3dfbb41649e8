# SPDX-License-Identifier: GPL-3.0-or-later
"""The same settling in YADE: Mindlin's contact law, infinite walls. Run by yade, which brings
the names that are not imported here.

usage: yade -j1 -n -x yade_settle.py START.txt EDGE SETTLE TIMED
"""
import math
import sys
import time

from yade import utils, O

start, edge = sys.argv[1], float(sys.argv[2])
settle, timed = int(sys.argv[3]), int(sys.argv[4])
material = O.materials.append(
    FrictMat(young=1e8, poisson=0.25, density=1000, frictionAngle=math.atan(0.2)))
with open(start) as rows:
    for row in rows:
        x, y, z, r = map(float, row.split())
        O.bodies.append(utils.sphere((x, y, z), r, material=material))
for position, axis in ((0, 0), (edge, 0), (0, 1), (edge, 1), (0, 2)):
    O.bodies.append(utils.wall(position, axis, sense=0, material=material))
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb()], verletDist=0.002),
    InteractionLoop([Ig2_Sphere_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom()],
                    [Ip2_FrictMat_FrictMat_MindlinPhys(betan=0.1, betas=0.1)],
                    [Law2_ScGeom_MindlinPhys_Mindlin()]),
    NewtonIntegrator(gravity=(0, 0, -2), damping=0.0),
]
O.dt = 1e-4
O.run(settle, True)
begin = time.time()
O.run(timed, True)
wall = time.time() - begin
count = sum(1 for b in O.bodies if isinstance(b.shape, Sphere))
print("YADE particle-steps/s %.4g wall %.3f ke %.4g"
      % (count * timed / wall, wall, utils.kineticEnergy()))
sys.exit(0)
