# SPDX-License-Identifier: GPL-3.0-or-later
"""packing-compare, bad input: exit code 2 (or 3), one line that names the option, nothing
written."""
from cli import BAD_INPUT, SYSTEM, main, refuses

REPORT = '{"volume_fraction": 0.6, "coordination": {"mean": null}, "list": [1, 2], "text": "x"}'
PACK = "x,y,z,r\n0,0,0,1\n"
FILES = [("a.json", REPORT), ("p.csv", PACK), ("bad.csv", "x,y,z,r\n0,0,0\n"),
         ("empty.csv", "x,y,z,r\n"), ("broken.json", '{"volume_fraction": '),
         ("after.json", REPORT + "x"), ("packs.json", '{"packs": [%s, {}]}' % REPORT),
         ("v.txt", "1,2\n3,4\n"), ("ragged.txt", "1,2\n3\n"), ("word.txt", "1\ntwo\n"),
         ("nan.txt", "1\nnan\n"), ("none.txt", "# nothing\n\n"), ("names.txt", "a,b\n"),
         ("hole.txt", "1,,3\n"), ("zero.txt", "1\n\0\n"),
         ("p.doc", PACK), ("wide.txt", ",".join(["1"] * 101) + "\n"),
         ("long.txt", "1" * 9000 + "\n")]
SUMMARY = ["--summary", "1,1,5"]


def case(arguments, words, code=BAD_INPUT):
    return (" ".join(arguments)[:60] or "nothing",
            refuses([*arguments, "--report", "report.json"], words, code, FILES, out=False))


TESTS = [
    case([], ["--a", "missing"]),
    case(["a.json"], ["'a.json'", "no option"]),
    case([*SUMMARY, "a.json"], ["'a.json'", "no option"]),
    case(["--a", "a.json"], ["--key", "a.json"]),
    case(["--a", ""], ["--a", "file name"]),
    case(["--a", "no.json", "--key", "x"], ["--a", "no.json"], SYSTEM),
    case(["--a", "a.json", "--key", "density"], ["--key", "density", "a.json"]),
    case(["--a", "a.json", "--key", "coordination.mean"], ["--key", "coordination.mean", "null"]),
    case(["--a", "a.json", "--key", "coordination"], ["--key", "no number"]),
    case(["--a", "a.json", "--key", "text"], ["--key", "no number"]),
    case(["--a", "a.json", "--key", "list.2"], ["--key", "list.2"]),
    case(["--a", "a.json", "--key", "list.x"], ["--key", "list.x"]),
    case(["--a", "a.json", "--key", ""], ["--key"]),
    case(["--a", "a.json", "--key", "x", "--key", "y"], ["--key", "twice"]),
    case(["--a", "packs.json", "--key", "volume_fraction"], ["--key", "packs.json"]),
    case(["--a", "broken.json", "--key", "x"], ["--a", "broken.json", "JSON"]),
    case(["--b", "after.json", "--key", "x"], ["--b", "after.json", "JSON"]),
    case(["--a", "bad.csv"], ["--a", "bad.csv", "line 2"]),
    case(["--a", "empty.csv"], ["--a", "empty.csv", "particles"]),
    case(["--a", "p.doc"], ["--a", "p.doc", "FORMAT", "xyz"]),
    case(["--a", "no:p.csv"], ["--a", "no:p.csv"], SYSTEM),
    case(["--a", "xyz:p.csv"], ["--a", "p.csv", "line 1"]),
    case(["--a", "p.csv", "a.json", "--key", "volume_fraction"], ["--a", "a.json", "packs"]),
    case(["--a", "p.csv", "--a", "p.csv"], ["--a", "two sets"]),
    case(["--set", "p.csv"], ["--set", "NAME=FILE"]),
    case(["--set", "=p.csv"], ["--set", "NAME=FILE"]),
    case(["--set", "x=p.csv", "--summary", "x=1,1,5"], ["--summary", "two sets", "x"]),
    case(["--values", "ragged.txt"], ["--values", "ragged.txt", "line 2", "1 columns"]),
    case(["--values", "word.txt"], ["--values", "word.txt", "line 2", "'two'"]),
    case(["--values", "nan.txt"], ["--values", "nan.txt", "line 2", "'nan'"]),
    case(["--values", "none.txt"], ["--values", "none.txt", "no numbers"]),
    case(["--values", "names.txt"], ["--values", "names.txt", "no numbers"]),
    case(["--values", "hole.txt"], ["--values", "hole.txt", "line 1", "missing"]),
    case(["--values", "zero.txt"], ["--values", "zero.txt", "no text"]),
    case(["--values", "wide.txt"], ["--values", "wide.txt", "line 1", "100"]),
    case(["--values", "long.txt"], ["--values", "long.txt", "line 1", "8192"]),
    case(["--values", "v.txt", "v.txt"], ["'v.txt'", "no option"]),
    case(["--summary", "1,2"], ["--summary", "'1,2'", "MEAN,SD,N"]),
    case(["--summary", "x,2,5"], ["--summary", "MEAN", "'x'"]),
    case(["--summary", "1,0,5"], ["--summary", "SD"]),
    case(["--summary", "1,2,1"], ["--summary", "1,2,1"]),
    case(["--summary", "1,2,2.5"], ["--summary", "N", "2.5"]),
    case(["--summary", "1,2,se=0"], ["--summary", "se"]),
    case(["--summary", "1,2,se=3"], ["--summary", "se=3"]),
    case([*SUMMARY, "--test", "t"], ["--test", "'t'", "welch"]),
    case([*SUMMARY, "--fit", "beta"], ["--fit", "'beta'", "chi-square"]),
    case([*SUMMARY, "--bootstrap", "-1"], ["--bootstrap"]),
    case([*SUMMARY, "--seed", "1.5"], ["--seed"]),
    case([*SUMMARY, "--domain", "box:1,1,1"], ["--domain"]),
    case(SUMMARY * 101, ["--summary", "100"]),
    ("report twice", refuses([*SUMMARY, "--report", "a", "--report", "b"], ["--report", "twice"],
                             out=False)),
    ("report over an input", refuses(["--values", "v.txt", "--report", "v.txt"],
                                     ["--report", "v.txt"], files=FILES, out=False)),
    ("report nowhere", refuses([*SUMMARY, "--report", "no/r.json"], ["--report", "no/r.json"],
                               SYSTEM, out=False)),
    ("disk full", refuses([*SUMMARY, "--quiet", "--report", "/dev/full"], ["/dev/full"], SYSTEM,
                          out=False)),
]
main(TESTS)
