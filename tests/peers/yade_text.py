# SPDX-License-Identifier: GPL-3.0-or-later
# Run by yade: reads pack.txt as bodies.
from yade import ymport

bodies = ymport.text("pack.txt")
print("FOUND", len(bodies), repr(sum(b.shape.radius for b in bodies)),
      repr(sum(b.state.pos[0] for b in bodies)))
