# SPDX-License-Identifier: GPL-3.0-or-later
"""What Campello and Cassares (Lat. Am. J. Solids Struct. 13, 23, 2016) print in Tables 1 to 4."""

EXAMPLES = ("5.1", "5.2", "5.3", "5.4")
ROTATIONS = ("on", "off")

# The ten densities of each table, pack 1 first.
ROWS = {
    ("5.1", "on"): (.854, .854, .854, .863, .854, .864, .853, .863, .892, .862),
    ("5.1", "off"): (.813, .838, .841, .830, .838, .837, .840, .839, .846, .846),
    ("5.2", "on"): (.826, .830, .825, .819, .822, .825, .826, .822, .827, .826),
    ("5.2", "off"): (.803, .827, .814, .815, .814, .819, .813, .810, .806, .806),
    ("5.3", "on"): (.560, .576, .572, .608, .564, .559, .563, .560, .564, .561),
    ("5.3", "off"): (.540, .538, .539, .542, .534, .541, .539, .540, .539, .536),
    ("5.4", "on"): (.578, .563, .566, .571, .567, .574, .578, .575, .578, .578),
    ("5.4", "off"): (.548, .543, .552, .547, .542, .552, .553, .542, .546, .538),
}

TITLES = {
    "5.1": "discs, r = 0.01",
    "5.2": "discs, r normal (0.01, 0.001), cut at 3 sigma",
    "5.3": "spheres, r = 0.02",
    "5.4": "spheres, r normal (0.02, 0.002), cut at 3 sigma",
}
DIM = {"5.1": 2, "5.2": 2, "5.3": 3, "5.4": 3}
TABLE = {"5.1": 1, "5.2": 2, "5.3": 3, "5.4": 4}
HEIGHT = 0.5  # of the asked pack; the base has edges of 1
# A layer holds so many particles, and a full bed takes so many layers: for estimates only.
LAYER_COUNT = {"5.1": 128, "5.2": 127, "5.3": 746, "5.4": 724}
LAYERS = {"5.1": 12, "5.2": 12, "5.3": 13, "5.4": 13}

# What the paper claims: the first lies above the second.
ORDERINGS = tuple(((e, "on"), (e, "off")) for e in EXAMPLES) + (
    (("5.1", "on"), ("5.2", "on")), (("5.1", "off"), ("5.2", "off")),
    (("5.4", "on"), ("5.3", "on")), (("5.4", "off"), ("5.3", "off")))
