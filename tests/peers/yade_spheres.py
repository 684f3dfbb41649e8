# SPDX-License-Identifier: GPL-3.0-or-later
# Run by yade: reads pack.txt as a SpherePack.
from yade import pack

spheres = pack.SpherePack()
spheres.load("pack.txt")
rows = spheres.toList()
print("FOUND", len(rows), repr(sum(row[1] for row in rows)),
      repr(sum(row[0][0] for row in rows)))
