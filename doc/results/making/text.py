# SPDX-License-Identifier: GPL-3.0-or-later
"""The sections of layers.md. Each function takes the groups of its part, a Results to read them
by, and returns Markdown; numbers that the notes may quote go into results.values."""
import math

from making import order, paper, parts, pictures, stats

NAMES = {"on": "on", "off": "off"}


class Results:
    def __init__(self, store, images, height=paper.HEIGHT):
        self.store, self.images, self.height = store, images, height
        self.values = {}
        self.kept = {}

    def densities(self, runs):
        return [self.store.report(run)["volume_fraction"] for run in runs]

    def height_of(self, run):
        options = run.options
        return float(options[options.index("--height") + 1]) if "--height" in options \
            else self.height

    def measured(self, run):
        """Measures of order of a 2D pack."""
        if run.options not in self.kept:
            self.kept[run.options] = order.discs(
                *self.store.pack(run), self.height_of(run), self.store.order(run))
        return self.kept[run.options]

    def spheres(self, run, bins):
        key = run.options + (bins,)
        if key not in self.kept:
            self.kept[key] = order.spheres(
                *self.store.pack(run), self.height_of(run), bins, self.store.order(run))
        return self.kept[key]

    def note(self, name, values):
        """Makes mean and deviation quotable as {{name.mean}}, {{name.sd}}."""
        self.values[name + ".n"] = str(len(values))
        self.values[name + ".mean"] = f"{stats.mean(values):.4f}"
        self.values[name + ".sd"] = number(stats.deviation(values))
        self.values[name + ".min"] = f"{min(values):.4f}"
        self.values[name + ".max"] = f"{max(values):.4f}"

    def image(self, name):
        return str(self.images / f"layers-{name}.png")


def number(value, digits=4):
    return "-" if value is None or math.isnan(value) else f"{value:.{digits}f}"


def probability(p):
    return f"{p:.1e}" if p < .001 else f"{p:.3f}"


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + " --- |" * len(head)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows]) + "\n"


def picture(results, name, words):
    return f"![{words}](../images/layers-{name}.png)\n"


def summary(results, groups, label):
    """Mean, deviation, variation of each example beside the paper's."""
    rows = []
    for (example, rotations), runs in groups.items():
        ours, theirs = results.densities(runs), paper.ROWS[example, rotations]
        reports = [results.store.report(run) for run in runs]
        layers = sum(r["layers"]["count"] for r in reports)
        results.note(f"{label}.{example}.{rotations}", ours)
        away = (stats.mean(ours) - stats.mean(theirs)) / stats.deviation(theirs)
        results.values[f"{label}.{example}.{rotations}.away"] = f"{away:+.1f}"
        rows.append([
            example, rotations, str(len(ours)),
            f"{stats.mean(ours):.4f} ({number(stats.deviation(ours))}, "
            f"{number(stats.variation(ours))})",
            f"{stats.mean(theirs):.4f} ({stats.deviation(theirs):.4f}, "
            f"{stats.variation(theirs):.4f})",
            f"{away:+.1f}" + (" *" if abs(away) > 2 else ""),
            f"{stats.mean([r['particles'] for r in reports]):.0f}",
            f"{stats.mean([r['layers']['count'] for r in reports]):.1f}",
            f"{sum(r['layers']['simulated'] for r in reports) / layers:.2f}",
            f"{sum(r['layers']['ended_by_time'] for r in reports) / layers:.0%}",
            f"{max(r['audit']['max_overlap'] or 0 for r in reports):.1e}",
            str(sum(not r["audit"]["passed"] for r in reports) or "none")])
    return table(["example", "rotations", "packs", "density: mean (sd, cv)", "paper",
                  "difference in the paper's sd", "particles", "layers", "seconds a layer",
                  "layers ended by time", "largest overlap", "failed audits"], rows)


STARRED = ("A star marks a mean farther from the paper's than two of the paper's standard "
           "deviations.\n")


def tables(results, groups):
    out = [summary(results, groups, "table"), STARRED]
    for example in paper.EXAMPLES:
        ours = {rot: results.densities(groups[example, rot]) for rot in paper.ROTATIONS}
        theirs = {rot: paper.ROWS[example, rot] for rot in paper.ROTATIONS}
        rows = [[str(k + 1)] + [f"{ours[rot][k]:.4f}" if source is ours else
                                f"{theirs[rot][k]:.3f}" if k < 10 else ""
                                for rot in paper.ROTATIONS for source in (ours, theirs)]
                for k in range(len(ours["on"]))]
        for name, of, digits in (("mean", stats.mean, 4), ("standard deviation",
                                 stats.deviation, 4), ("coefficient of variation",
                                                       stats.variation, 4)):
            rows.append([name] + [number(of(source[rot]), digits) for rot in paper.ROTATIONS
                                  for source in (ours, theirs)])
        out += [f"### Table {paper.TABLE[example]}: example {example}, "
                f"{paper.TITLES[example]}\n",
                table(["pack", "on", "on, paper", "off", "off, paper"], rows),
                sheet(results, example, groups)]
    return "\n".join(out)


def sheet(results, example, groups):
    """Pictures of the packs: the paper's Figures 4 to 11."""
    lines = []
    for rotations in paper.ROTATIONS:
        runs = groups[example, rotations]
        name = f"{example.replace('.', '-')}-{rotations}"
        titles = [f"pack {k + 1}: {phi:.3f}" for k, phi in enumerate(results.densities(runs))]
        if paper.DIM[example] == 2:
            pictures.sheet_of_discs(results.image(name), [
                (title, *results.store.pack(run), results.store.order(run)["psi6"])
                for title, run in zip(titles, runs)],
                results.height_of(runs[0]))
        else:
            pictures.sheet_of_images(results.image(name), [
                (title, results.store.folder(run) / "pack.png")
                for title, run in zip(titles, runs)])
        lines.append(picture(results, name, f"Example {example}, rotations {rotations}"))
    return "\n".join(lines)


def ordering_table(results, groups, label):
    rows = []
    for above, below in paper.ORDERINGS:
        row = [f"{above[0]} {above[1]} > {below[0]} {below[1]}"]
        for source, of in (("ours", lambda key: results.densities(groups[key])),
                           ("paper", lambda key: paper.ROWS[key])):
            a, b = of(above), of(below)
            gap, p = stats.mean(a) - stats.mean(b), stats.permutation_p(a, b)
            name = f"{label}.{above[0]}{above[1]}-{below[0]}{below[1]}.{source}"
            results.values[name + ".gap"] = f"{gap:+.4f}"
            results.values[name + ".p"] = probability(p)
            row += [f"{gap:+.4f}", probability(p)]
            if source == "ours":
                verdict = ("no: the other way" if gap <= 0 else
                           "yes" if p < .05 else "not significant")
        rows.append(row + [verdict])
    return table(["density", "difference", "p", "paper's difference", "paper's p", "came out"],
                 rows)


def orderings(results, groups):
    return ("One-sided permutation test on the means, exact (184756 splits for 10 and 10 "
            "packs); p is the share of splits with at least this difference, and \"came out\" "
            "means p < 0.05.\n\n" + ordering_table(results, groups, "ordering"))


def rest(results, groups):
    return (f"A layer ends at rest, or after {parts.REST_TIME_MAX:g} s where it finds none: the "
            "column says how many did.\n\n" +
            summary(results, groups, "rest") + "\n" + STARRED + "\n" +
            ordering_table(results, groups, "rest.ordering"))


def rules(results, groups):
    return ("Layers until the highest particle reaches the asked height (the tables above: "
            "until no column two mean diameters wide ends below it).\n\n" +
            summary(results, groups, "highest") + "\n" + STARRED)


def time(results, groups):
    rows, lines = [], {}
    for rotations in paper.ROTATIONS:
        line = lines.setdefault(("rotations " + rotations, rotations), [])
        ends = lines  # one panel
        for t in parts.LAYER_TIMES:
            phi = results.densities(groups[rotations, t])
            results.note(f"time.{rotations}.{t:g}", phi)
            line.append((t, stats.mean(phi), stats.deviation(phi)))
            rows.append([rotations, f"{t:g}", str(len(phi)), number(stats.mean(phi)),
                         number(stats.deviation(phi))])
    pictures.curves(results.image("time"), [("density of example 5.1", ends)],
                    "time given to a layer [s]", log=True)
    return (table(["rotations", "seconds a layer", "packs", "density", "sd"], rows) + "\n" +
            picture(results, "time", "Density against the time given to a layer"))


def slip(results, groups):
    rows = []
    for (example, rotations, factor), runs in groups.items():
        phi, base = results.densities(runs), results.densities(groups[example, rotations, 1])
        results.note(f"slip.{example}.{rotations}.{factor:g}", phi)
        row = [example, rotations, f"{factor:g}", str(len(phi)), number(stats.mean(phi)),
               number(stats.deviation(phi))]
        if factor == 1:
            row += ["", "", ""]
        else:
            gap = stats.mean(phi) - stats.mean(base)
            error = stats.standard_error(phi, base)
            row += [f"{gap:+.4f}", number(error), "yes" if abs(gap) <= 2 * error else "no"]
        rows.append(row)
    known = ", ".join(f"{results.values[f'slip.default.{e}']} in {e}" for e in
                      parts.SLIP_EXAMPLES)
    return (f"The regularising velocity v0 of the friction law, by default {known}, tenfold "
            "smaller and larger.\n\n" +
            table(["example", "rotations", "v0 over the default", "packs", "density", "sd",
                   "difference", "its standard error", "within two"], rows))


def friction(results, groups):
    rows, density, ordered = [], {}, {}
    for (example, rotations, mu), runs in groups.items():
        phi = results.densities(runs)
        if paper.DIM[example] == 2:
            seen = [results.measured(run) for run in runs]
            tidy, kind = [m["local"] for m in seen], "mean abs psi6"
        else:
            seen = [results.spheres(run, 4) for run in runs]
            tidy = [weighted(bins, "fcc", 2) + weighted(bins, "hcp", 2) for bins in seen]
            kind = "share fcc + hcp"
        name = f"friction.{example}.{rotations}.{mu:g}"
        results.note(name, phi)
        results.note(name + ".order", tidy)
        for lines, of in ((density, phi), (ordered, tidy)):
            lines.setdefault((f"{example}, rotations {rotations}", rotations, example),
                             []).append((mu, stats.mean(of), stats.deviation(of)))
        rows.append([example, rotations, f"{mu:g}", str(len(phi)), number(stats.mean(phi)),
                     number(stats.deviation(phi)), f"{kind} {number(stats.mean(tidy), 3)}"])
    for example in ("5.1", "5.3"):
        panels = [(label, {key[:2]: line for key, line in lines.items() if key[2] == example})
                  for label, lines in (
                      ("density of example " + example, density),
                      (r"order: mean $|\psi_6|$" if example == "5.1" else
                       "order: share fcc + hcp", ordered))]
        pictures.curves(results.image("friction-" + example.replace(".", "-")), panels,
                        r"coefficient of friction $\mu$")
    return (table(["example", "rotations", "mu", "packs", "density", "sd", "order"], rows) +
            "\n" + picture(results, "friction-5-1", "2D: density and order against friction") +
            "\n" + picture(results, "friction-5-3", "3D: density and order against friction"))


def weighted(bins, key, first):
    """Mean over the spheres of bins `first` and on."""
    count = sum(b["count"] for b in bins[first:])
    return sum(b[key] * b["count"] for b in bins[first:]) / count if count else 0.0


def order_of_tables(results, groups):
    flat, solid = [], []
    for (example, rotations), runs in groups.items():
        if paper.DIM[example] == 2:
            seen = [results.measured(run) for run in runs]
            cells = []
            for key in ("local", "mean", "six"):
                values = [m[key] for m in seen]
                results.note(f"order.{example}.{rotations}.{key}", values)
                cells.append(f"{stats.mean(values):.3f} ({number(stats.deviation(values), 3)})")
            flat.append([example, rotations, str(len(runs))] + cells)
        else:
            seen = [results.spheres(run, 4) for run in runs]
            cells = []
            for key in ("q6", "fcc", "hcp"):
                values = [weighted(bins, key, 2) for bins in seen]
                results.note(f"order.{example}.{rotations}.{key}", values)
                cells.append(f"{stats.mean(values):.3f} ({number(stats.deviation(values), 3)})")
            solid.append([example, rotations, str(len(runs))] + cells)
    return (
        "By `packing-measure --order 1.2 --order-list`: neighbours are at most 1.2 (r_i + r_j) "
        "apart; only particles at least two mean "
        "diameters from walls and surface count. psi6 of a disc is the mean of exp(6 i theta) "
        "over its neighbours, 1 in the hexagonal lattice: the mean of its absolute value says "
        "how ordered the surroundings are, the absolute value of its mean whether one "
        "orientation prevails.\n\n" +
        table(["example", "rotations", "packs", "mean abs psi6 (sd)", "abs mean psi6 (sd)",
               "share with six neighbours (sd)"], flat) +
        "\nq6 of a sphere (fcc 0.5745, hcp 0.4848); a sphere is fcc or hcp by its "
        "common-neighbour signatures (twelve 421; six 421 and six 422).\n\n" +
        table(["example", "rotations", "packs", "mean q6 (sd)", "share fcc (sd)",
               "share hcp (sd)"], solid))


def fine(results, groups):
    rows, bins = [], 8
    for rotations, runs in groups.items():
        run = runs[0]
        report = results.store.report(run)
        results.values[f"fine.{rotations}.density"] = f"{report['volume_fraction']:.4f}"
        results.values[f"fine.{rotations}.particles"] = str(report["particles"])
        seen = results.spheres(run, bins)
        inner = {key: weighted(seen, key, 3) for key in ("q6", "fcc", "hcp")}
        for key, value in inner.items():
            results.values[f"fine.{rotations}.{key}"] = f"{value:.3f}"
        for b in seen:
            span = f"{b['from']}-{b['from'] + 1}" if b["from"] < bins - 1 else f"{bins - 1}-"
            rows.append([rotations, span, str(b["count"]), f"{b['q6']:.3f}", f"{b['fcc']:.3f}",
                         f"{b['hcp']:.3f}"])
        rows.append([rotations, "3-", str(sum(b["count"] for b in seen[3:])),
                     *(f"{inner[key]:.3f}" for key in ("q6", "fcc", "hcp"))])
    pictures.sheet_of_images(results.image("fine"), [
        (f"rotations {rotations}", results.store.folder(runs[0]) / "pack.png")
        for rotations, runs in groups.items()], columns=2)
    said = "; ".join(
        f"rotations {rot}: {results.values[f'fine.{rot}.particles']} spheres, density "
        f"{results.values[f'fine.{rot}.density']}" for rot in groups)
    return (said + ". By distance to the nearest wall or the surface, in diameters:\n\n" +
            table(["rotations", "distance", "spheres", "mean q6", "share fcc", "share hcp"],
                  rows) + "\n" + picture(results, "fine", "The packs of r = 0.01"))


SECTIONS = {
    "tables": ("Tables 1 to 4", tables),
    "orderings": ("The paper's orderings", orderings),
    "rest": ("The same, each layer settled to rest", rest),
    "rules": ("The other rule for a full bed", rules),
    "time": ("Density against the time given to a layer", time),
    "slip": ("The regularising velocity", slip),
    "friction": ("Friction", friction),
    "order": ("Order", order_of_tables),
    "fine": ("Example 5.3 with r = 0.01", fine),
}
