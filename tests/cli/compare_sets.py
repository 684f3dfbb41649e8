# SPDX-License-Identifier: GPL-3.0-or-later
"""packing-compare: where numbers come from, the tables of the advancing-front paper, and what
stands in the report."""
import hashlib
import json
import math
from cli import DONE, Folder, equal, holds, main

TABLE_14 = """# binary occupation ratio of five slices, porosity of five packs
glass 0.5 mm,packing 0.5 mm,glass 1 mm,packing 1 mm,sand,packing of sand
0.455,0.454,0.453,0.489,0.461,0.454
0.458,0.461,0.444,0.473,0.439,0.466
0.457,0.456,0.437,0.501,0.435,0.464
0.446,0.460,0.442,0.473,0.439,0.458
0.461,0.461,0.395,0.490,0.495,0.460
"""


def near(got, wanted, error, what):
    holds(abs(got - wanted) <= error, "%s: %r instead of %r" % (what, got, wanted))


def compare(folder, *arguments):
    result = folder.run(*arguments, "--report", "report.json")
    equal(result.code, DONE, result.err)
    equal(result.out, b"", "standard output")
    return json.loads(folder.read("report.json")), result


def pair_of(report, a, b):
    return next(p for p in report["pairs"] if (p["a"], p["b"]) == (a, b))


def tables_8_and_9(program):
    """By the printed standard errors t is 1.10 and .62; with five and seven experiments, which
    they suggest, it is 1.11 and .62: no difference either way."""
    with Folder(program) as folder:
        for first, second, t in (("se=0.018", "se=0.021", (1.10, 0.62)), ("5", "7", (1.11, 0.62))):
            report, result = compare(
                folder, "--summary", "AA=0.672,0.040," + first, "--summary", "aa=0.652,0.012,30",
                "--summary", "AH=0.797,0.055," + second, "--summary", "ah=0.784,0.006,30")
            for k, names in enumerate((("AA", "aa"), ("AH", "ah"))):
                welch = pair_of(report, *names)["welch"]
                near(welch["t"], t[k], 0.005, "t")
                holds(welch["p"] > 0.3, "p %g" % welch["p"])
                holds("%s and %s: Welch t" % names in result.err, result.err)
            near(report["sets"][1]["confidence95"], 0.004, 0.0005, "printed in Table 9")
            near(report["sets"][3]["confidence95"], 0.002, 0.0005, "printed in Table 9")
            equal(pair_of(report, "AA", "aa")["ks"], {"d": None, "p": None, "method": None}, "KS")


TABLE_10 = """AA,virtual AA
0.3,0.305
1.94,1.86877
2.26,2.33738
3.91,4.40837
10.94,11.7401
39.7,40.9511
96.13,96.0188
99.83,99.8178
100,100
"""
TABLE_11 = """AH,virtual AH
0.98,0.980272
2.58,2.59155
2.74,2.89303
3.87,4.24557
5.16,5.34449
6.45,6.646
7.74,7.91426
20.32,22.41333
33.39,35.6489
53.72,54.28313
71.72,72.06208
83.78,83.8994
100,100
"""


def tables_10_and_11(program):
    """By the points there are; the paper divides by 7."""
    wanted = {"AA": (.3141, .2753, .03567, -.02722), "AH": (.4978, .7847, .03336, -.03336)}
    with Folder(program) as folder:
        folder.write("t10.csv", TABLE_10)
        folder.write("t11.csv", TABLE_11)
        report, result = compare(folder, "--values", "t10.csv", "--values", "t11.csv", "--test",
                                 "curves")
        for name, errors in wanted.items():
            found = pair_of(report, name, "virtual " + name)["curves"]
            for key, value, slack in zip(("mae", "mse", "rmae", "mre"), errors,
                                         (5e-5, 5e-5, 5e-6, 5e-6)):
                near(found[key], value, slack, key)
        equal(set(pair_of(report, "AA", "AH")["curves"].values()), {None}, "9 and 13 points")
        equal(pair_of(report, "AA", "virtual AA")["welch"]["p"], None, "not asked for")
        holds("MAE 0.3141" in result.err, result.err)
        report, _ = compare(folder, "--values", "t10.csv")
        equal(set(report["pairs"][0]["curves"].values()), {None}, "unless asked for")


def table_14(program):
    """Slice C5 of the glass of 1 mm is the only outlier, and with it that glass is the only
    material whose slices differ from its packs."""
    means = [0.4554, 0.4584, 0.4342, 0.4852, 0.4538, 0.4604]
    with Folder(program) as folder:
        folder.write("t14.csv", TABLE_14)
        report, result = compare(folder, "--values", "t14.csv")
        sets = report["sets"]
        for k, one in enumerate(sets):
            near(one["mean"], means[k], 1e-12, one["name"])
            equal(one["dixon"]["outlier95"], k == 2, one["name"])
            equal((one["n"], one["dixon"]["critical"]["0.95"]), (5, 0.71), "limit")
        near(sets[2]["dixon"]["q"], 0.724, 0.0005, "Q of C5")
        equal(sets[2]["dixon"]["suspect"], 0.395, "C5")
        holds("Dixon Q 0.724" in result.err, result.err)
        for k in range(3):
            pair = pair_of(report, sets[2 * k]["name"], sets[2 * k + 1]["name"])
            for test in ("welch", "mann_whitney"):
                equal(pair[test]["p"] < 0.05, k == 1, test)
        equal(report["anova"]["dof_within"], 24, "degrees")
        digest = hashlib.sha256(TABLE_14.encode()).hexdigest()
        equal(report["input"], [{"file": "t14.csv", "sha256": digest}], "input")


def pack_report(fraction, contacts):
    return {"program": "packing-layers", "volume_fraction": fraction,
            "coordination": {"mean": contacts}, "fabric": {"eigenvalues": [contacts, 0.3]}}


def reports(program):
    """One pack, several, sets of several; numbers found by dotted keys."""
    packs = [pack_report(0.5 + 0.01 * k, 4 + k) for k in range(6)]
    files = {"one.json": packs[0], "two.json": {"packs": packs[1:3], "mean": packs[0]},
             "sets.json": {"sets": [{"packs": packs[3:5]}, {"packs": packs[5:]}],
                           "mean": packs[0]}}
    with Folder(program) as folder:
        for name, content in files.items():
            folder.write(name, "\n " + json.dumps(content))
        for key, values in (("volume_fraction", [0.5 + 0.01 * k for k in range(6)]),
                            ("coordination.mean", [4 + k for k in range(6)]),
                            ("fabric.eigenvalues.0", [4 + k for k in range(6)])):
            report, _ = compare(folder, "--a", "one.json", "two.json", "sets.json", "--key", key,
                                "--set", "rest=sets.json", "--b=two.json")
            found = report["sets"]
            equal([s["name"] for s in found], ["a", "rest", "b"], "names")
            equal([s["n"] for s in found], [6, 3, 2], "sizes")
            equal(found[0]["what"], key, "what")
            near(found[0]["mean"], sum(values) / 6, 1e-12, "mean")
            equal((found[0]["min"], found[0]["max"]), (values[0], values[5]), "ends")
            near(found[0]["median"], (values[2] + values[3]) / 2, 1e-12, "median")
            equal(len(report["pairs"]), 3, "pairs")


def packs(program):
    """Radii of packs of two and three dimensions; two halves of one set of sizes."""
    with Folder(program) as folder:
        for number in range(2):
            radii = [1 + (2 * k + number) / 200 for k in range(100)]
            folder.write("p%d.csv" % number, "# domain: box:9,9,9\nr,z,y,x\n" + "".join(
                "%.17g,0,%d,0\n" % (r, k) for k, r in enumerate(radii)))
        folder.write("flat.doc", "x,y,r\n0,0,1.5\n5,5,2.5\n")
        report, _ = compare(folder, "--a", "p0.csv", "--b", "p1.csv", "csv:flat.doc")
        equal([(s["n"], s["what"]) for s in report["sets"]], [(100, "r"), (102, "r")], "sets")
        pair = report["pairs"][0]
        equal((pair["ks"]["method"], pair["mann_whitney"]["method"]), ("exact", "normal"), "ways")
        near(pair["ks"]["d"], 1 - 101 / 102 + 0.01, 0.01, "D")
        holds(pair["ks"]["p"] > 0.999 and pair["welch"]["p"] > 0.5, "equal sizes")


def a_pack_of_any_format(program):
    with Folder(program) as folder:
        folder.write("p.csv", "x,y,z,r\n0,0,0,1\n5,5,5,2.5\n")
        folder.write("p.txt", "0\t0\t0\t1\n5\t5\t5\t2.5\n")
        report, _ = compare(folder, "--a", "p.csv", "--b", "yade:p.txt")
        equal([(s["min"], s["max"], s["n"]) for s in report["sets"]], [(1, 2.5, 2)] * 2, "radii")
        equal([i["file"] for i in report["input"]], ["p.csv", "p.txt"], "input")


def weibull(count):
    """Quantiles of a Weibull law of scale 120 and shape 1.5."""
    return [120 * (-math.log(1 - (k + 0.5) / count)) ** (1 / 1.5) for k in range(count)]


def fits(program):
    """Table 16 has Weibull first and exponential, chi-square and uniform hopeless; its histogram
    is not printed, so ideal Weibull grains stand in. The seed decides the bootstrap alone."""
    with Folder(program) as folder:
        folder.write("grains.txt", "".join("%.17g\n" % v for v in weibull(400)))
        arguments = ["--values", "grains.txt", "--fit", "all", "--bootstrap", "99"]
        report, result = compare(folder, *arguments)
        found = report["sets"][0]["fits"]
        equal([f["rank"] for f in found], list(range(1, 9)), "ranks")
        equal(found[0]["name"], "weibull", "first")
        near(found[0]["parameters"]["shape"], 1.5, 0.02, "shape")
        near(found[0]["parameters"]["scale"], 120, 0.5, "scale")
        equal(found[0]["p"], 1, "p of the ideal sample")
        hopeless = {f["name"] for f in found if f["p"] == 0.01}
        holds({"exponential", "chi-square", "uniform"} <= hopeless, str(hopeless))
        holds({f["name"] for f in found[5:]} <= hopeless, "the last")
        holds("weibull" in result.err, result.err)
        again, _ = compare(folder, *arguments)
        other, _ = compare(folder, *arguments, "--seed", "2", "--bootstrap", "98")
        equal(again["sets"], report["sets"], "the same seed")
        holds(other["sets"] != report["sets"], "another seed")
        equal([f["ks"] for f in other["sets"][0]["fits"] if f["name"] == "weibull"],
              [found[0]["ks"]], "fit under another seed")
        none, _ = compare(folder, *arguments[:-1], "0")
        equal({f["p"] for f in none["sets"][0]["fits"]}, {None}, "no bootstrap")


def fits_that_do_not_apply(program):
    with Folder(program) as folder:
        folder.write("v.txt", "-1 1\n0.5 2\n2 4\n")
        report, _ = compare(folder, "--values", "v.txt", "--fit", "gamma,normal",
                            "--bootstrap", "9", "--test", "none")
        first = {f["name"]: f for f in report["sets"][0]["fits"]}
        equal((first["gamma"]["fitted"], first["gamma"]["p"], first["gamma"]["rank"],
               first["gamma"]["parameters"]), (False, None, None, {"scale": None, "shape": None}),
              "gamma of -1")
        equal(first["normal"]["rank"], 1, "normal")
        equal({p["welch"]["p"] for p in report["pairs"]}, {None}, "no tests")
        equal(report["sets"][1]["dixon"]["q"], None, "no tests")


def chosen_tests(program):
    with Folder(program) as folder:
        report, result = compare(folder, "--summary", "1,1,9", "--summary", "2,1,9",
                                 "--summary", "3,1,9", "--test", "anova", "--quiet")
        equal(result.err, "", "quiet")
        equal(report["pairs"][0]["welch"], {"t": None, "dof": None, "p": None}, "not asked for")
        near(report["anova"]["f"], 9, 1e-12, "F")
        near(report["anova"]["p"], (1 + 18 / 24) ** -12, 1e-12, "p")
        equal([s["name"] for s in report["sets"]], ["1", "2", "3"], "names")


def standard_output(program):
    """Without --report the report goes there, and people read standard error."""
    with Folder(program) as folder:
        result = folder.run("--summary", "a=1,1,9", "--summary", "b=2,1,9")
        equal((result.code, result.files), (DONE, []), result.err)
        report = json.loads(result.out)
        equal(list(report), ["program", "version", "command", "options", "input", "seed", "sets",
                             "pairs", "anova"], "keys")
        equal((report["program"], report["input"]), ("packing-compare", None), "head")
        holds("a and b" in result.err, result.err)


def people_read_whole_counts(program):
    """Sizes of sets stand in full, and what one number does not tell is left out."""
    with Folder(program) as folder:
        folder.write("one.csv", "one\n5\n")
        folder.write("v.csv", "many\n" + "1\n" + "2\n" * 12344)
        _, result = compare(folder, "--values", "one.csv", "--values", "v.csv",
                            "--summary", "q=0.6,0.1,se=0.03")
        lines = [line.split() for line in result.err.splitlines()]
        equal(lines[0], ["one", "n", "1", "mean", "5"], result.err)
        equal(lines[1][:3], ["many", "n", "12345"], result.err)
        equal(lines[2][:3], ["q", "n", "11.11"], result.err)
        holds("nan" not in result.err, result.err)


main([(test.__name__.replace("_", " "), test) for test in (
    tables_8_and_9, tables_10_and_11, table_14, reports, packs, a_pack_of_any_format,
    fits, fits_that_do_not_apply, chosen_tests, people_read_whole_counts, standard_output)])
