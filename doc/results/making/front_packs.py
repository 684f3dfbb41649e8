# SPDX-License-Identifier: GPL-3.0-or-later
"""Packs beside those of the paper's tables. Each function takes the Maker and the arguments, and
returns Markdown."""
import math
import os

import numpy

from making import grown, stats, stl

MODES = ("paper", "fast", "dense")
ROW = ["N", "whole", "inner", "Z", "time [s]", "particles/s", "KS (limit)", "overlap"]


def count(n):
    return f"{n:,}".replace(",", " ")


def number(value, form=".4f"):
    return "-" if value is None else format(value, form)


def row(pack):
    ks = pack["psd.ks"]
    return [count(pack["particles"]) + " (stopped)" * pack.stopped,
            number(pack["volume_fraction"]),
            number(pack["volume_fraction_inner"]), number(pack["coordination.mean"], ".3f"),
            number(pack["time.place"], ".2f"), number(pack["rate"], ".3g"),
            "-" if ks is None else f"{ks:.4f} ({pack['psd.ks_limit']:.4f})",
            number(pack["audit.max_overlap"], ".1e") +
            " **audit failed**" * (not pack["audit.passed"])]


def table(header, rows):
    lines = [header, ["---"] * len(header), *rows]
    return "\n".join("| " + " | ".join(str(cell) for cell in line) + " |" for line in lines) + "\n"


def short(value):
    return f"{value:.6g}"


# ---- Tables 1 and 2: a cylinder ----

NORMAL = "normal:1,0.1,0.7,1.3"
CYLINDER_R, CYLINDER_N = 31.762, 25400


def cylinder(r):
    return f"cylinder:{short(r)},{short(2 * r)}"


def fixed_count(maker, whole, asked, spec, length, n, psd, mode):
    """A container of the shape of `spec`, of a size that holds n particles at the volume fraction
    that the mode has reached in the one of that length (and 1 % more, for its walls weigh otherwise
    then); then exactly n."""
    size = length * (n / whole["particles"] * 1.01) ** (1 / 3)
    return maker.front("--domain", spec(size), "--psd", psd, "--mode", mode, "--count", str(n),
                       *asked, short=True)


def table2(maker, _):
    r, n = maker.length(CYLINDER_R), maker.number(CYLINDER_N, 50)
    rows = [["paper, Table 2", "", "25 400", "0.5439", "-", "5", "44.3", "573", "-", "-"]]
    for mode, way in [(mode, "outward") for mode in MODES] + [("dense", "inward")]:
        pack = maker.front("--domain", cylinder(r), "--psd", NORMAL, "--mode", mode, "--direction",
                           way)
        same = fixed_count(maker, pack, ("--direction", way), cylinder, r, n, NORMAL, mode)
        name = f"{mode}, {way}"
        rows += [[name, "the container"] + row(pack), [name, "the count"] + row(same)]
    return ("The sizes of Table 1 are lost: radii N(1, 0.1) cut to [0.7, 1.3] in a cylinder of "
            f"R = {CYLINDER_R}, H = 2 R are ours, for there 25 400 spheres are 0.5439. Filled at "
            "that container, and at the paper's count in a cylinder of the same shape that holds "
            "it. One thread.\n\n" + table(["mode", "fixed"] + ROW, rows))


# ---- Tables 3 and 4: a cube ----

UNIFORM = "uniform:0.7,1.3"
CUBE_N, CUBE_FRACTION = 15864150, 0.5503
MEAN_BALL = 4 / 3 * math.pi * (1.3 ** 4 - 0.7 ** 4) / (4 * 0.6)


def cube(edge):
    return f"box:{short(edge)},{short(edge)},{short(edge)}"


def table4(maker, arguments):
    edge = maker.length((CUBE_N * MEAN_BALL / CUBE_FRACTION) ** (1 / 3))
    n = maker.number(CUBE_N, 50)
    rows = [["paper, Table 4", "", "15 864 150", "0.5503", "-", "5", "8067", "1970", "-", "-"]]
    pack = maker.front("--domain", cube(edge), "--psd", UNIFORM, "--mode", "paper", threads=1)
    rows.append(["paper (one thread)", "the container"] + row(pack))
    for mode, fraction in (("fast", 0.59), ("dense", 0.61)):
        size = maker.length((CUBE_N * MEAN_BALL / fraction) ** (1 / 3))
        pack = maker.front("--domain", cube(size), "--psd", UNIFORM, "--mode", mode, "--count",
                           str(n), threads=arguments.threads, short=True)
        rows.append([mode, "the count"] + row(pack))
    return (f"Radii uniform; the bounds of Table 3 are lost, [0.7, 1.3] is our choice. A cube of "
            f"{short(edge)}, where the paper's count is its fraction, and for fast and dense one that "
            f"surely holds the count: what is left empty at its walls and corners makes the whole less, "
            f"see inner. {arguments.threads} threads.\n\n" + table(["mode", "fixed"] + ROW, rows))


# ---- Figure 12: low volume fractions ----

def loosen(maker, _):
    r = maker.length(CYLINDER_R)
    rows = []
    for share in (0.05, 0.023, 0.012):
        for how in ("shrink", "remove"):
            pack = maker.front("--domain", cylinder(r), "--psd", NORMAL, "--target-porosity",
                               repr(1 - share), "--loosen", how)
            rows.append([f"{100 * share:g} %", how, count(pack["particles"]),
                         f"{pack['volume_fraction']:.8f}",
                         f"{pack['psd.ks']:.4f} ({pack['psd.ks_limit']:.4f})",
                         number(pack["audit.max_overlap"], ".1e")])
    return ("The cylinder of Table 2, filled and made looser. Sizes are those before radii shrink, "
            "or of the particles that stay.\n\n" +
            table(["asked", "how", "N", "reached", "KS (limit)", "overlap"], rows))


# ---- Tables 5 and 6: a silo ----

SAND = "curve:examples/data/sand.csv"
SILO_N = 26343


def silo_spec(size):
    return f"silo:{short(size)},{short(3 * size)},{short(0.3 * size)},{short(0.9 * size)}"


def silo_pack(maker, size, mode, outs=()):
    return maker.front("--domain", silo_spec(size), "--psd", SAND, "--mode", mode, outs=outs)


def silo_size(maker):
    """So that the dense mode places about as many as the paper; found from two trials."""
    size, n = maker.length(2.6), maker.number(SILO_N, 50)
    for _ in range(2):
        size *= (n / silo_pack(maker, size, "dense")["particles"]) ** (1 / 3)
    return size


def silo(maker, _):
    size = silo_size(maker)
    rows = [["paper, Table 6", "26 343", "0.442", "-", "5", "180.9", "146", "-", "-"]]
    for mode in MODES:
        pack = silo_pack(maker, size, mode, (("--out", "silo.png"),) if mode == "dense" else ())
        rows.append([mode] + row(pack))
        if mode == "dense":
            keep_image(maker, pack, "silo.png", "front-silo.png")
    return ("The curve of Figure 13 is lost. Ours is CEN standard sand (EN 196-1), by mass, 0.063 to "
            f"2 mm, in a silo {silo_spec(size)} (mm) tuned to about as many spheres as the paper's. "
            "One thread.\n\n" + table(["mode"] + ROW, rows) +
            "\n![the silo](../images/front-silo.png)\n")


def keep_image(maker, pack, name, to):
    (maker.images / to).write_bytes((pack.folder / name).read_bytes())


# ---- Table 7: a foil with two gradings ----

FOIL = (1.5, 1.0, 0.1)
FOIL_N, FOIL_SHARES = 465295, (0.163, 0.837)


def foil_psd(maker, share):
    """The mixture of both curves whose shares by number are these; a SPEC's are by mass, so the
    ratio of the mean masses is asked of a small pack first."""
    curves = [f"curve:{grown.DATA}/foil-{k}.csv,by=number" for k in (1, 2)]
    trial = maker.front("--domain", "box:0.1,0.1,0.1", "--psd",
                        f"0.5*{curves[0]}+0.5*{curves[1]}", "--count", "100", "--mode", "fast")
    of = [trial[f"front.components.{k}.number_asked"] for k in (0, 1)]
    mass = [share[k] / of[k] for k in (0, 1)]
    return "+".join(f"{mass[k] / sum(mass):.12g}*{curves[k]}" for k in (0, 1))


def foil(maker, arguments):
    psd = foil_psd(maker, FOIL_SHARES)
    width = [maker.length(edge) for edge in FOIL[:2]] if maker.scale > 1e-2 else [0.12, 0.12]
    n = round(FOIL_N * width[0] * width[1] / (FOIL[0] * FOIL[1]))
    domain = f"box:{short(width[0])},{short(width[1])},{FOIL[2]}"
    pack = maker.front("--domain", domain, "--psd", psd, "--count", str(n),
                       threads=arguments.threads, short=True,
                       outs=[("--out", "foil.png"), ("--plot-sizes", "sizes.png")])
    rows = []
    for k, share in enumerate(FOIL_SHARES):
        part = pack.report["front"]["components"][k]
        slack = 3 * math.sqrt(share * (1 - share) / pack["particles"])
        off = abs(part["number_placed"] - share)
        limit = 1.36 / math.sqrt(part["particles"])
        rows.append([f"set {k + 1}", ("76 016", "389 279")[k], f"{100 * share:.1f} %",
                     count(part["particles"]), f"{100 * part['number_placed']:.3f} %",
                     f"{100 * off:.4f} % of {100 * slack:.4f} %: {yes(off <= slack)}",
                     f"{part['ks']:.5f} of {limit:.5f}: {yes(part['ks'] <= limit)}"])
    return ("A foil of 1.5 x 1.0 x 0.1 cm with two sets of spheres; shares by number (Table 7 gives "
            "set 1 16.3 %, its text 84 %). Both curves of Figure 15 are lost; ours are "
            "`data/foil-1.csv` and `data/foil-2.csv`. The bound on a share is "
            "3 sqrt(p (1 - p) / N).\n\n" +
            table(["", "paper's N", "share asked", "N", "share placed", "off, of the bound",
                   "KS, of its limit"], rows) + "\n" + table(ROW, [row(pack)]))


def yes(condition):
    return "kept" if condition else "**missed**"


# ---- Tables 8 to 11: glass beads ----

# mean diameter [mm], experiment: e, deviation, samples ((sd / error)^2), paper's packs: e, deviation
BEADS = {"aa": ("AA", 0.45, (0.672, 0.040, 5), (0.652, 0.012)),
         "ah": ("AH", 0.063, (0.797, 0.055, 7), (0.784, 0.006))}


def bead_points(name):
    """Diameters and cumulative percentages of the paper's table (without our row of 0)."""
    lines = [line for line in (grown.ROOT / grown.DATA / f"{name}.csv").read_text().splitlines()
             if line[:1].isdigit()]
    points = numpy.array([[float(word) for word in line.split(",")] for line in lines])
    return points[1:, 0], points[1:, 1]


def bead_packs(maker, name, by, mode, more=(), packs=30):
    _, mean_d, *_ = BEADS[name]
    wide = 40 * mean_d * (maker.scale ** (1 / 3) if maker.scale < 1 else 1)
    domain = f"cylinder:{short(wide / 2)},{short(wide)}"
    psd = f"curve:{grown.DATA}/{name}.csv,by={by}"

    def make(k):
        return maker.front("--domain", domain, "--psd", psd, "--mode", mode, "--stream", str(k),
                           *more, outs=(("--out", "pack.csv"),) if k == 0 else (),
                           short=bool(more))
    made = [make(0)]
    if not made[0].stopped:
        made += maker.side_by_side(make, range(1, maker.number(packs)))
    return made


def curve_errors(maker, pack, name, by):
    """MAE, MSE, RMAE, MRE over the points of Tables 10 and 11, by packing-compare."""
    d, asked = bead_points(name)
    r = numpy.sort(pack.rows()["r"])
    weight = numpy.cumsum(r ** 3 if by == "mass" else numpy.ones(len(r)))
    below = numpy.searchsorted(r, d / 2 * (1 + 1e-12), side="right")
    placed = 100 * numpy.concatenate(([0], weight))[below] / weight[-1]
    off = asked - placed
    return [f"{abs(off).mean():.2f}", f"{(off ** 2).mean():.2f}",
            f"{100 * (abs(off) / asked).mean():.2f} %", f"{100 * (off / asked).mean():.2f} %"]


def beads(maker, _):
    text = []
    for name, (title, mean_d, lab, paper) in BEADS.items():
        rows = [["experiment, Table 8", "", str(lab[2]), f"{lab[0]} ({lab[1]})", "", "", ""],
                ["paper, Table 9", "", "30", f"{paper[0]} ({paper[1]})", "", "", ""]]
        errors = [{"aa": ["paper, Table 10", "0.40", "0.35", "4.59 %", "-3.50 %"],
                   "ah": ["paper, Table 11", "0.78", "1.39", "5.96 %", "-5.96 %"]}[name]]
        for by in ("mass", "number"):
            for mode in ("paper", "dense"):
                packs = bead_packs(maker, name, by, mode)
                rows.append([mode, by] + bead_row(maker, packs, lab))
                errors.append([f"{mode}, by {by}"] + curve_errors(maker, packs[0], name, by))
            asked = lab[0] / (1 + lab[0])
            packs = bead_packs(maker, name, by, "dense", ("--target-porosity", f"{asked:.12g}"), 5)
            rows.append([f"dense, at porosity {asked:.4f}", by] + bead_row(maker, packs, lab))
        text.append(f"**{title}**, mean diameter {mean_d} mm, in a cylinder as wide and as high as 40 "
                    "of these:\n\n" +
                    table(["mode", "curve by", "packs", "void ratio (sd)", "mean N", "KS below limit",
                           "Welch p against the experiment"], rows) +
                    "\nErrors of the cumulative curve, in per cent, of the first pack:\n\n" +
                    table(["", "MAE", "MSE", "RMAE", "MRE"], errors))
    return ("Tables 8 and 9 give void ratios e = void / solid; the samples behind Table 8 are "
            "(sd / error)^2 = 5 and 7. The container is not given; nor whether the curves of Tables "
            "10 and 11 count particles or mass: both readings. The same mode for both beads; nothing "
            "is tuned.\n\n" + "\n".join(text))


def bead_row(maker, packs, lab):
    whole = [pack for pack in packs if not pack.stopped]
    if len(whole) < 2:
        last = packs[-1]
        return [str(len(whole)), f"stopped after {last['time.place']:.0f} s",
                count(last["particles"]) + " by then", "-", "-"]
    e = [pack["void_ratio"] for pack in whole]
    sizes = sum(pack["psd.ks"] <= pack["psd.ks_limit"] for pack in whole)
    said = maker.compare("--summary", f"lab={lab[0]},{lab[1]},{lab[2]}", "--summary",
                         f"packs={stats.mean(e):.12g},{max(stats.deviation(e), 1e-9):.12g},{len(e)}",
                         "--test", "welch")
    p = said.rsplit("p ", 1)[-1].split()[0].rstrip(",;.") if "p " in said else "-"
    return [str(len(e)), f"{stats.mean(e):.4f} ({stats.deviation(e):.4f})",
            count(round(stats.mean([pack["particles"] for pack in whole]))),
            f"{sizes} of {len(e)}", p]


# ---- Figures 23 to 25: meshes ----

# shape, paper's figure, paper's N and fraction, radii, their mean r^3
CUT_NORMAL = "normal:0.3,0.0333,0.2,0.4"
CUT_UNIFORM = "uniform:0.2,0.4"
MESHES = [("building", "Figure 24", 1383973, 0.49, CUT_NORMAL, 0.0279),
          ("bridge", "Figure 24", 6399991, 0.53, CUT_NORMAL, 0.0279),
          ("part", "Figure 25, tool", 3778952, 0.54, CUT_UNIFORM, 0.03),
          ("bone", "Figure 23, hip", 349748, None, CUT_UNIFORM, 0.03)]


def mesh_file(maker, name):
    """The shape scaled so that the paper's count is the paper's fraction of it."""
    _, _, n, fraction, _, cube_mean = next(row for row in MESHES if row[0] == name)
    volume = n * 4 / 3 * math.pi * cube_mean / (fraction or 0.53) * maker.scale
    path = maker.work / f"{name}-{short(volume)}.stl"
    if not path.exists():
        stl.make(name, volume, path)
    return path


def mesh_pack(maker, name, mode, arguments, outs=()):
    psd = next(row[4] for row in MESHES if row[0] == name)
    path = mesh_file(maker, name)
    return maker.front("--domain", f"mesh:{os.path.relpath(path, grown.ROOT)}", "--psd", psd, "--mode", mode,
                       threads=arguments.threads, outs=outs, depends=[path])


def meshes(maker, arguments):
    rows, pictures = [], []
    for name, figure, n, fraction, psd, _ in MESHES:
        rows.append([f"paper, {figure}", "", count(n), number(fraction, ".2f")] + ["-"] * 6)
        for mode in ("fast", "dense"):
            outs = (("--out", "pack.png"),) if mode == "dense" else ()
            pack = mesh_pack(maker, name, mode, arguments, outs)
            rows.append([name, f"{mode}, {psd}"] + row(pack))
        keep_image(maker, pack, "pack.png", f"front-{name}.png")
        pictures.append(f"![{name}](../images/front-{name}.png)")
    return ("The paper's meshes are not published. Ours are made by `making/solids.py`: a building "
            "with rooms and windows, an arch bridge, a gear with a hub and a bore (part), a bone; "
            "each has the volume that makes the paper's count the paper's fraction of it, so the "
            "ratio of mesh to radius is comparable. Radii as in the paper: normal in [0.2, 0.4] "
            "(mean 0.3, deviation 0.0333: ours) or uniform. No sphere may protrude: the audit says "
            f"so. {arguments.threads} threads.\n\n" + table(["mesh", "mode, radii"] + ROW, rows) +
            "\n" + "\n".join(pictures) + "\n")


PARTS = {"table2": ("Tables 1 and 2: a cylinder", table2),
         "table4": ("Tables 3 and 4: 16 million spheres", table4),
         "loosen": ("Figure 12: low volume fractions", loosen),
         "silo": ("Tables 5 and 6: a silo from a grading curve", silo),
         "foil": ("Table 7: a foil with two gradings", foil),
         "beads": ("Tables 8 to 11: glass beads", beads),
         "meshes": ("Figures 23 to 25: closed meshes", meshes)}
