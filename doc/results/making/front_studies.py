# SPDX-License-Identifier: GPL-3.0-or-later
"""Claims of the paper put to the test: selections, ways of contact, time, fabric, directions."""
import itertools
import math

import numpy

from making import front_packs, stats
from making.front_packs import CYLINDER_R, NORMAL, UNIFORM, count, cube, cylinder, number, table

WORDS = ("random", "fifo", "lifo")


def spread(values, form=".4f"):
    return f"{stats.mean(values):{form}} ({stats.deviation(values):{form}})"


# ---- section 3.3: nine selections ----

def selections(maker, _):
    r, seeds = maker.length(CYLINDER_R), max(2, min(10, round(10 * maker.scale ** 0.2)))
    rows, means = [], {}
    for pair in itertools.product(WORDS, repeat=2):
        packs = [maker.front("--domain", cylinder(r), "--psd", NORMAL, "--mode", "paper", "--select",
                             ",".join(pair), "--seed", str(seed + 1)) for seed in range(seeds)]
        means[pair] = [pack["volume_fraction"] for pack in packs]
        rows.append([*pair, spread(means[pair]),
                     spread([pack["volume_fraction_inner"] for pack in packs if
                             pack["volume_fraction_inner"] is not None] or [math.nan]),
                     f"{stats.mean([pack['coordination.mean'] for pack in packs]):.3f}",
                     spread([pack["time.place"] for pack in packs], ".2f")])
    best = max(means, key=lambda pair: stats.mean(means[pair]))
    first = means["random", "random"]
    if best == ("random", "random"):
        verdict = "Random from both is the densest, as section 3.3 says."
    else:
        p = stats.permutation_p(means[best], first)
        verdict = (f"The densest is {best[0]} from the front, {best[1]} among the neighbours, by "
                   f"{stats.mean(means[best]) - stats.mean(first):.4f} over random from both, which "
                   f"section 3.3 calls the densest (permutation test, one-sided: p = {p:.2g}).")
    return (f"The cylinder of Table 2, mode paper, {seeds} seeds each; means and deviations (n - 1)."
            "\n\n" + table(["of the front", "of the neighbours", "whole", "inner", "Z", "time [s]"],
                           rows) + "\n" + verdict + "\n")


# ---- section 3.4: four ways of contact ----

def contacts(maker, _):
    r, seeds = maker.length(CYLINDER_R), 3
    rows = []
    for method in ("wrappers", "potential", "binary", "direct"):
        packs = [maker.front("--domain", cylinder(r), "--psd", NORMAL, "--mode", "paper",
                             "--contact", method, "--seed", str(seed + 1)) for seed in range(seeds)]
        rows.append([method, count(round(stats.mean([pack["particles"] for pack in packs]))),
                     spread([pack["volume_fraction"] for pack in packs]),
                     spread([pack["coordination.mean"] for pack in packs], ".3f"),
                     spread([pack["time.place"] for pack in packs], ".2f"),
                     f"{stats.mean([pack['rate'] for pack in packs]):.3g}"])
    return (f"The cylinder of Table 2, mode paper, {seeds} seeds each. Section 3.4 claims that "
            "approximate methods (binary, direct) are cheaper and less dense.\n\n" +
            table(["method", "N", "whole", "Z", "time [s]", "particles/s"], rows))


# ---- Figure 11: time against particles ----

def straight(x, y):
    """Slope, intercept and R^2."""
    slope, at = numpy.polyfit(x, y, 1)
    left = y - slope * x - at
    return slope, at, 1 - (left @ left) / ((y - y.mean()) @ (y - y.mean()))


def time(maker, _):
    edge = cube(maker.length(195))
    rows, curves = [], {}
    for mode in front_packs.MODES:
        pack = maker.front("--domain", edge, "--psd", UNIFORM, "--mode", mode,
                           outs=[("--trace", "trace.csv")])
        trace = pack.rows("trace.csv")
        n, t = trace["particles"], trace["seconds"]
        slope, at, r2 = straight(n, t)
        curves[mode] = n, t, slope, at
        rows.append([mode, count(pack["particles"]), f"{t[-1]:.2f}", f"{1e6 * slope:.3f}",
                     f"{at:.3f}", f"{r2:.5f}"])
    draw_time(maker, curves)
    return ("Within one run in a cube of about a million spheres, radii U[0.7, 1.3], one thread: the "
            "time after each step against the particles placed until then, and the straight line of "
            "least squares.\n\n" +
            table(["mode", "N", "time [s]", "slope [us a particle]", "intercept [s]", "R^2"], rows) +
            "\n![time against particles](../images/front-time.png)\n")


def draw_time(maker, curves):
    from making import pictures  # matplotlib
    figure, axis = pictures.pyplot.subplots(figsize=(6, 4), layout="constrained")
    for (mode, (n, t, slope, at)), colour in zip(curves.items(), ("#0072B2", "#D55E00", "#009E73")):
        some = slice(None, None, max(1, len(n) // 2000))
        axis.plot(n[some] / 1e6, t[some], color=colour, label=mode)
        axis.plot(n[[0, -1]] / 1e6, slope * n[[0, -1]] + at, "k:", linewidth=1)
    axis.set_xlabel("particles placed [millions]")
    axis.set_ylabel("time [s]")
    axis.legend(title="dotted: regression", fontsize=8)
    axis.grid(alpha=.3)
    pictures.save(figure, maker.images / "front-time.png")


# ---- Table 18: fabric ----

PAPER_FABRIC = {"cylinder": ("0.355, 0.351, 0.294", 0.0345451),
                "silo": ("0.340, 0.337, 0.323", 0.00935224),
                "building": ("0.359, 0.348, 0.293", 0.0354539)}


def fabric(maker, arguments):
    size = front_packs.silo_size(maker)
    rows = []
    for mode in ("paper", "dense"):
        packs = {"cylinder": maker.front("--domain", cylinder(maker.length(CYLINDER_R)), "--psd",
                                         NORMAL, "--mode", mode),
                 "silo": front_packs.silo_pack(maker, size, mode, (("--out", "silo.png"),)
                                               if mode == "dense" else ()),
                 "building": front_packs.mesh_pack(maker, "building", mode, arguments,
                                                   (("--out", "pack.png"),) if mode == "dense"
                                                   else ())}
        for name, pack in packs.items():
            values = pack["fabric.eigenvalues"] or []
            rows.append([name, mode, PAPER_FABRIC[name][0], f"{PAPER_FABRIC[name][1]:.4f}",
                         ", ".join(f"{value:.4f}" for value in sorted(values, reverse=True)),
                         number(pack["fabric.sd"], ".4f"),
                         number(pack["fabric.noise_floor"], ".4f")])
    return ("Eigenvalues of the fabric tensor of the contact normals and their deviation (n - 1), "
            "beside Table 18, whose own deviations are 3.2 to 7.7 times each other. 304L steel, sandstone "
            "and Daytona sand need what is not built yet.\n\n" +
            table(["pack", "mode", "paper", "paper's sd", "eigenvalues", "sd", "noise floor"], rows))


# ---- section 3.2: outward and inward ----

def middle_pore(maker, pack, r, half):
    """The largest empty sphere with its centre within a fifth of the radius from the middle."""
    found = maker.measure(pack, "--pores", outs=[("--pore-network", "pores")])
    pores = found.rows("pores-pores.csv")
    off = numpy.sqrt(pores["x"] ** 2 + pores["y"] ** 2 + (pores["z"] - half) ** 2)
    near = off < 0.2 * r
    return float(pores["radius"][near].max()) if near.any() else math.nan


def directions(maker, _):
    r = maker.length(CYLINDER_R)
    rows, profiles = [], {}
    for mode, way in itertools.product(("paper", "dense"), ("outward", "inward")):
        pack = maker.front("--domain", cylinder(r), "--psd", NORMAL, "--mode", mode, "--direction",
                           way, outs=[("--out", "pack.csv")])
        profile = maker.measure(pack, "--profile", f"radius,{max(10, round(8 * r))}")
        at, value = wall_profile(profile, r)
        profiles[mode, way] = at, value
        rows.append([mode, way, count(pack["particles"]), number(pack["volume_fraction"]),
                     number(pack["volume_fraction_inner"]), f"{pack['time.place']:.2f}",
                     f"{middle_pore(maker, pack, r, r):.3f}",
                     f"{value[at < 2].mean():.4f}", f"{value[at > 6].mean():.4f}"
                     if (at > 6).any() else "-"])
    draw_profiles(maker, profiles)
    return ("The cylinder of Table 2. Section 3.2 claims that inward packs fit the walls exactly, with "
            "a pore in the middle that is smaller than the mean particle (radius 1), and that outward "
            "packs leave gaps at the walls. Pore: radius of the largest empty sphere with its centre "
            "within R / 5 of the middle.\n\n" +
            table(["mode", "direction", "N", "whole", "inner", "time [s]", "pore in the middle",
                   "porosity within 2 radii of the wall", "beyond 6"], rows) +
            "\n![porosity from the wall](../images/front-wall.png)\n")


def wall_profile(measured, r):
    """Distance from the mantle in mean radii, and porosity, from the wall inwards."""
    found = measured.report["measures"]["profiles"][0]
    middle = [(a + b) / 2 for a, b in zip(found["from"], found["to"])]
    return r - numpy.array(middle)[::-1], numpy.array(found["porosities"], float)[::-1]


def draw_profiles(maker, profiles):
    from making import pictures  # matplotlib
    figure, axes = pictures.pyplot.subplots(1, 2, figsize=(9, 3.4), layout="constrained",
                                            sharey=True)
    for axis, mode in zip(axes, ("paper", "dense")):
        for way, colour in (("outward", "#0072B2"), ("inward", "#D55E00")):
            at, value = profiles[mode, way]
            axis.plot(at[at < 12], value[at < 12], color=colour, label=way)
        axis.set_title(f"mode {mode}")
        axis.set_xlabel("distance from the mantle [mean radii]")
        axis.legend(fontsize=8)
        axis.grid(alpha=.3)
    axes[0].set_ylabel("porosity")
    pictures.save(figure, maker.images / "front-wall.png")


# ---- Figures 3 and 4: the growth ----

def growth(maker, _):
    edge = short_square(maker)
    lines = []
    for way in ("outward", "inward"):
        for mode in ("paper", "dense"):
            name = f"front-growth-{way}-{mode}.png"
            pack = maker.front("--domain", edge, "--psd", UNIFORM, "--mode", mode, "--direction",
                               way, outs=[("--frames", "growth.png")])
            front_packs.keep_image(maker, pack, "growth.png", name)
            lines.append(f"{way.capitalize()}, mode {mode}, {count(pack['particles'])} discs, area "
                         f"fraction {pack['volume_fraction']:.4f}:\n\n![{way}](../images/{name})\n")
    return ("Discs in a square, as in Figures 3 (outward) and 4 (inward); section 3.0 swaps the two "
            "words, 3.2 holds. The front is red.\n\n" + "\n".join(lines))


def short_square(maker):
    edge = 80 * max(maker.scale, 0.05) ** 0.5
    return f"rect:{edge:.6g},{edge:.6g}"


# ---- bars ----

def bench(maker, *runs):
    """What the runs of bench-front print; a trial has the usual one only."""
    asked = runs if maker.scale == 1 else ((),)
    return "".join(maker.bench(*words) for words in asked)


def bars(maker, _):
    return ("What `bench-front` prints, and after it `bench-front periodic`, of which nothing has walls: "
            "rate, volume fractions, sizes, overlap and memory together. Bytes are the most that store "
            "and placer held, for each particle placed.\n\n"
            f"```\n{bench(maker, (), ('periodic',))}```\n")


def millions(maker, _):
    runs = [(*cell, word) for word in ("table4", "exponent") for cell in ((), ("periodic",))]
    return ("What `bench-front table4` and `bench-front exponent` print, each followed by the same in "
            f"periodic cells (`bench-front periodic ...`).\n\n```\n{bench(maker, *runs)}```\n")


PARTS = {"bars": ("Bars", bars),
         "millions": ("Bars: from 1e5 to 16 million spheres", millions),
         "selections": ("Section 3.3: nine selections", selections),
         "contacts": ("Section 3.4: four ways of contact", contacts),
         "time": ("Figure 11: time against particles", time),
         "fabric": ("Table 18: fabric", fabric),
         "directions": ("Section 3.2: outward and inward", directions),
         "growth": ("Figures 3 and 4: the growth", growth)}
