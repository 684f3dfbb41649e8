# SPDX-License-Identifier: GPL-3.0-or-later
"""packing-measure, bad input: exit code 2 (or 3), one line that names the option, nothing
written."""
import os
from cli import BAD_INPUT, SYSTEM, main, refuses

PACK = ("p.csv", "x,y,z,r\n1,1,1,0.5\n2,1,1,0.5\n1,2,1,0.5\n3,3,3,0.5\n")
FLAT = ("f.csv", "x,y,r\n1,1,0.5\n2,1,0.5\n")
FILES = [PACK, FLAT]
IN = ["--in", "p.csv", "--domain", "box:4,4,4"]
IN_FLAT = ["--in", "f.csv", "--domain", "rect:4,4"]


def test(name, arguments, words, code=BAD_INPUT, files=FILES):
    return (name, refuses(arguments, words, code, files, out=False))


def option(*arguments, words, start=IN, name=None, code=BAD_INPUT):
    return test(name or " ".join(arguments), [*start, *arguments], words, code)


def real(name, *bad):
    return [option(name, value, words=[name]) for value in (*bad, "nan", "x", "")]


def pack(name, text, *words, file="q.csv", more=()):
    return test(name, ["--in", file, "--domain", "box:4,4,4", *more],
                ["--in", file.split(":")[-1], *words], files=[(file.split(":")[-1], text)])


TESTS = [
    test("nothing asked", [], ["--in", "missing"]),
    test("no container", ["--in", "p.csv"], ["--domain", "missing", "p.csv"]),
    test("a file that is not there", ["--in", "none.csv"], ["--in", "none.csv"], SYSTEM),
    test("a folder", ["--in", "csv:."], ["--in"], SYSTEM),
    test("unknown extension", ["--in", "p.doc"], ["--in", "'p.doc'", "csv", "dump"]),
    test("unknown format", ["--in", "obj:p.csv"], ["--in", "'obj'", "yade-pack"]),
    test("a format too long to be one", ["--in", "a" * 40 + ":p.csv"], ["--in", "unknown"]),
    test("format without a file", ["--in", "csv:"], ["--in", "missing"]),
    option("--in", "p.csv", words=["--in", "twice"]),
    pack("an empty table", "", "q.csv"),
    pack("a table without radii", "x,y,z\n1,1,1\n", "line 1"),
    pack("a broken number", "x,y,z,r\n1,1,1,0.5\n1,1,x,0.5\n", "line 3"),
    pack("a radius of 0", "x,y,z,r\n1,1,1,0\n", "line 2"),
    pack("a number that is none", "x,y,z,r\n1,nan,1,0.5\n", "line 2"),
    pack("another format than said", PACK[1], file="vtp:q.vtp"),
    test("two containers", [*IN, "--domain", "sphere:3"], ["--domain", "twice"]),
    test("a container that is none", ["--in", "p.csv", "--domain", "ball:3"],
         ["--domain", "'ball'"]),
    test("a container of no size", ["--in", "p.csv", "--domain", "box:4,4,0"],
         ["--domain", "size"]),
    test("a flat container of a pack that is not", ["--in", "p.csv", "--domain", "rect:4,4"],
         ["--domain", "flat"]),
    test("a note that is no container", ["--in", "q.csv"], ["--in", "'heap'"],
         files=[("q.csv", "# domain: heap:1\n" + PACK[1])]),
    option("--dim", "4", words=["--dim"]),
    option("--dim", "2", words=["--dim", "p.csv"]),
    option("--dim", "3", words=["--dim", "rect:4,4"], start=IN_FLAT),
    option("--frame", "-1", words=["--frame"]),
    option("--frame", "7", words=["--in", "frame"]),
    option("--sort", words=["--in", "id"], name="sort without ids"),
    option("--radius-array", "r", words=["--radius-array", "csv"]),
    option("--diameter-array", "d", words=["--diameter-array", "csv"]),
    option("--radius-array", "r", "--diameter-array", "d", words=["only one"]),
    option("--psd", "mono", words=["--psd", "R is missing"]),
    option("--psd", "curve:none.csv", words=["--psd", "none.csv"], code=SYSTEM),
    *real("--tolerance", "0", "-1", "1"),
    *real("--rdf", "0", "-1"),
    option("--rdf", "3,0", words=["--rdf"]),
    option("--rdf", "3,10,2", words=["--rdf", "RMAX,BINS"]),
    option("--up", "1", words=["--up", "X,Y,Z"]),
    option("--up", "0,0,0", words=["--up", "direction"]),
    option("--up", "1,x,0", words=["--up", "'x'"]),
    option("--up", "0,0,1", words=["--up"], start=IN_FLAT),
    option("--order", "0", words=["--order"]),
    option("--order", "all", words=["--order", "'all' is not a factor, nearest:N or none"]),
    option("--order", "nearest:0", words=["--order"]),
    option("--order", "nearest:257", words=["--order"]),
    option("--profile", "w", words=["--profile", "'w'", "radius"]),
    option("--profile", "radius-w", words=["--profile", "'radius-w'"]),
    option("--profile", "radius-xx", words=["--profile", "'radius-xx'"]),
    option("--profile", "z,0", words=["--profile"]),
    option("--profile", "z,3,3", words=["--profile", "BINS"]),
    option("--profile", "z", words=["--profile"], start=IN_FLAT, name="profile across discs"),
    option("--section", "z", words=["--section", "AXIS=H"]),
    option("--section", "w=1", words=["--section", "'w=1'"]),
    option("--section", "z=", words=["--section", "missing"]),
    option("--section", "z,0", words=["--section"]),
    option("--section", "z,5000", words=["--section"]),
    option("--section", "z=1", words=["--section", "two dimensions"], start=IN_FLAT,
           name="section of discs"),
    option("--map", "2", words=["--map", "NX,NY,NZ"]),
    option("--map", "2,2,0", words=["--map"]),
    option("--map", "100000,100000,1", words=["--map", "cells"]),
    option("--map", "2,2,2:", words=["--map", "missing"]),
    option("--map", "2,2,2", "--map", "2,2,2", words=["--map", "twice"]),
    option("--map", "2,2,2", words=["--map", "two dimensions"], start=IN_FLAT,
           name="map of discs with layers"),
    option("--pore-merge", "2", words=["--pore-merge"]),
    option("--pore-merge", "x", words=["--pore-merge"]),
    option("--pore-network", "", words=["--pore-network", "missing"]),
    option("--pore-network", "no/n", words=["--pore-network", "no/n"], code=SYSTEM),
    option("--bonds", "0.1", words=["--bonds", "GAP:FILE"]),
    option("--bonds", "x:b.csv", words=["--bonds", "'x'"]),
    option("--bonds", "-1:b.csv", words=["--bonds", "below 0"]),
    option("--bonds", "1:b.csv", "--bonds", "1:c.csv", words=["--bonds", "twice"]),
    option("--contacts", "", words=["--contacts", "missing"]),
    option("--contacts", "c.csv", "--contacts", "d.csv", words=["--contacts", "twice"]),
    option("--order-list", "", words=["--order-list", "missing"]),
    option("--order-list", "c.csv", "--order-list", "d.csv", words=["--order-list", "twice"]),
    option("--order-list", "c.csv", "--order", "none", words=["--order-list", "none"]),
    option("--normals", "1", words=["--normals"]),
    option("--normals", "1001", words=["--normals"]),
    option("--sieves", "1,,2", words=["--sieves", "missing"]),
    option("--sieves", "1,0", words=["--sieves", "above 0"]),
    option("--sieves", "1,0.5,1", words=["--sieves", "twice"]),
    option("--sieves", "none.txt", words=["--sieves", "none.txt"], code=SYSTEM),
    option("--sieves", "p.csv", words=["--sieves", "p.csv", "line 1"]),
    option("--plot", "", words=["--plot", "missing"]),
    option("--plot", "no/a", words=["--plot", "no/a"], code=SYSTEM),
    option("--plot-format", "gif", words=["--plot-format", "'gif'"]),
    option("--plot-format", "svg", words=["--plot-format", "--plot"]),
    option("--max-overlap", "1", words=["--max-overlap"]),
    option("--threads", "0", words=["--threads"]),
    option("--isa", "mmx", words=["--isa", "'mmx'"]),
    option("--out", "a.csv", words=["--out"]),
    option("--seed", "1", words=["--seed"]),
    option("loose", words=["'loose'"]),
    option("--contacts", "p.csv", words=["--contacts", "input"], name="output over the input"),
    option("--contacts", "a.csv", "--report", "a.csv", words=["--report", "twice"],
           name="report over a table"),
    option("--bonds", "1:b.csv", "--contacts", "/dev/full", words=["--contacts", "/dev/full"],
           code=SYSTEM, name="disk full"),
]
assert len({name for name, _ in TESTS}) == len(TESTS), "two tests of one name"
main(TESTS)
