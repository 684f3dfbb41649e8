# SPDX-License-Identifier: GPL-3.0-or-later
"""Each request of packing-compare for memory is refused once: compare_memory.py PROGRAM MODULE.

It ends with exit code 3, one line and no file, or, where the C library does without, with the
very report of an undisturbed run."""
import os
import sys
from cli import DONE, SYSTEM, Folder, equal, holds, main, one_line

MODULE = os.path.abspath(sys.argv[2])
FILES = {"a.json": '{"packs": [{"k": {"x": 1}}, {"k": {"x": 2}}, {"k": {"x": 4}}]}',
         "p.csv": "x,y,r\n0,0,1\n1,1,3\n5,5,2\n", "v.txt": "a b\n1 2\n2 5\n4 3\n"}
ALWAYS = ["--bootstrap", "1", "--quiet", "--report", "report.json"]
RUNS = {
    "reports and packs": ["--a", "a.json", "--key", "k.x", "--b", "p.csv", "--fit", "gamma"],
    "tables and figures": ["--values", "v.txt", "--summary", "1,1,9", "--test", "ks,dixon"],
}


def run(program, arguments, fail_at):
    with Folder(program) as folder:
        for name, text in FILES.items():
            folder.write(name, text)
        result = folder.run(*arguments, *ALWAYS,
                            env=dict(os.environ, LD_PRELOAD=MODULE, FAIL_AT=str(fail_at)))
        made = [name for name in result.files if name not in FILES]
        return result, {name: folder.read(name) for name in made}


def survives(arguments):
    def test(program):
        whole, files = run(program, arguments, 0)
        equal((whole.code, list(files)), (DONE, ["report.json"]), whole.err)
        refused, fail_at, unnoticed = 0, 1, 0
        while unnoticed < 50:  # more than the C library does without in a row
            result, made = run(program, arguments, fail_at)
            if result.code == DONE:
                holds(made == files, "the report differs, request %d" % fail_at)
                unnoticed += 1
            else:
                equal(result.code, SYSTEM, "exit code, request %d (%s)" % (fail_at, result.err))
                equal(made, {}, "files, request %d" % fail_at)
                one_line(result, "packing-compare", "out of memory")
                refused, unnoticed = refused + 1, 0
            fail_at += 1
        holds(refused > 200, "only %d requests were refused" % refused)
    return test


main([(name, survives(arguments)) for name, arguments in RUNS.items()])
