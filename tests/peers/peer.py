# SPDX-License-Identifier: GPL-3.0-or-later
"""Loads the program's files into another program: python3 peer.py PEER PACKING-CLOUD SCRIPTS.
Skipped (exit code 77) where that is not installed."""
import json
import math
import os
import shutil
import subprocess
import sys
import tempfile

SKIP = 77
PACKS = {  # name: arguments; a wall, a periodic cell, two dimensions
    "cylinder": ["--domain", "cylinder:2,5", "--psd", "uniform:0.1,0.3", "--count", "300"],
    "periodic": ["--domain", "box:4,4,4+periodic", "--psd",
                 "0.5*mono:0.3+0.5*mono:0.15", "--count", "200"],
    "flat": ["--domain", "rect:8,8", "--psd", "uniform:0.1,0.3", "--count", "100"],
}
FILES = ["pack.csv", "pack.data", "pack.vtp", "yade:pack.txt"]


def skip(word):
    print("skipped: no", word)
    sys.exit(SKIP)


def need(name):
    return shutil.which(name) or skip(name)


def make(program, folder, arguments):
    """Makes the files and returns what every reader must find: count, sums of r and of x."""
    outs = [word for name in FILES for word in ("--out", name)]
    done = subprocess.run([program, *arguments, *outs], cwd=folder, check=True,
                          stdout=subprocess.PIPE)
    with open(os.path.join(folder, "pack.csv")) as file:
        lines = [line.split(",") for line in file if not line.startswith("#")]
    head = [name.strip() for name in lines[0]]
    x, r = head.index("x"), head.index("r")
    found = (len(lines) - 1, math.fsum(float(row[r]) for row in lines[1:]),
             math.fsum(float(row[x]) for row in lines[1:]))
    assert found[0] == json.loads(done.stdout)["particles"]
    return found


def answer(command, folder):
    """Runs a peer; its line `FOUND count sum_r sum_x` is the answer."""
    done = subprocess.run(command, cwd=folder, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True,
                          errors="replace", timeout=200)
    for line in done.stdout.splitlines():
        if line.startswith("FOUND "):
            words = line.split()
            return int(float(words[1])), float(words[2]), float(words[3])
    raise SystemExit("no answer from %s:\n%s" % (command[0], done.stdout))


def read_data(program, folder, name, script):
    dim = "2" if name == "flat" else "3"
    edges = {"flat": ("f", "f", "p"), "periodic": ("p", "p", "p")}.get(name, ("f",) * 3)
    return [answer([need(program), "-in", script, "-log", "none", "-var", "dim", dim,
                    "-var", "edges", " ".join(edges)], folder)]


def lammps(folder, name, scripts):
    return read_data("lmp", folder, name, os.path.join(scripts, "lammps.in"))


def liggghts(folder, name, scripts):
    return read_data("liggghts", folder, name, os.path.join(scripts, "liggghts.in"))


def vtk(folder, name, scripts):
    if subprocess.run([sys.executable, "-c", "import vtk"],
                      stderr=subprocess.DEVNULL).returncode != 0:
        skip("vtk module of python3")
    return [answer([sys.executable, os.path.join(scripts, "vtk_read.py")], folder)]


def yade(folder, name, scripts):
    command = [need("yade"), "-n", "-x", "-j1"]
    found = []
    for script in ("yade_text.py", "yade_spheres.py"):
        found.append(answer([*command, os.path.join(scripts, script)], folder))
    return found


PEERS = {"lammps": lammps, "liggghts": liggghts, "vtk": vtk, "yade": yade}


def main():
    peer, program, scripts = sys.argv[1], *map(os.path.abspath, sys.argv[2:])
    for name, arguments in PACKS.items():
        with tempfile.TemporaryDirectory() as folder:
            wanted = make(program, folder, arguments)
            for found in PEERS[peer](folder, name, scripts):
                assert found[0] == wanted[0], (name, found, wanted)
                for got, sum_of in zip(found[1:], wanted[1:]):
                    assert abs(got - sum_of) <= 1e-6 * (1 + abs(sum_of)), (name, found,
                                                                           wanted)
                print(name, "particles %d, sum of radii %.9g" % found[:2])


main()
