# SPDX-License-Identifier: GPL-3.0-or-later
"""Packs that the library wrote, accepted by another program:
    python3 accept.py PEER MAKE_PACK
Every particle is there; after 1000 steps without gravity none has moved; with gravity the walls
of the deck hold all. Skipped (exit code 77) where the program is missing."""
import os
import shutil
import subprocess
import sys
import tempfile

SKIP = 77
STILL = 1e-12  # of lengths that are of the order of 1
SINK = 0.1  # into a wall, in radii: they fall at up to 10 m/s
FLAT = ("rectangle", "circle", "annulus")
SOLID = ("box", "open", "periodic", "cylinder", "tube", "cone", "silo", "sphere", "bonded")


def skip(word):
    print("skipped: no", word)
    sys.exit(SKIP)


def need(name):
    return shutil.which(name) or skip(name)


def need_module(name):
    if subprocess.run([sys.executable, "-c", "import " + name],
                      stderr=subprocess.DEVNULL).returncode != 0:
        skip("python3 module " + name)


def run(command, folder):
    done = subprocess.run(command, cwd=folder, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, errors="replace",
                          timeout=250)
    if done.returncode != 0:
        raise SystemExit("%s failed:\n%s" % (" ".join(command), done.stdout[-3000:]))
    return done.stdout


def make(program, scene, folder):
    """Writes the files; the rows x, y, z, r and the number of bonds."""
    count, bonds = map(int, run([program, scene, folder], folder).split())
    with open(os.path.join(folder, "pack.csv")) as file:
        lines = [line.strip().split(",") for line in file if not line.startswith("#")]
    at = {name: k for k, name in enumerate(lines[0])}
    rows = [tuple(float(line[at[name]]) if name in at else 0.0 for name in "xyzr")
            for line in lines[1:]]
    assert len(rows) == count > 0, (scene, len(rows), count)
    return rows, bonds


def frames(path):
    """The frames of a dump: {id: row of numbers}."""
    found, lines = [], open(path).read().split("\n")
    for n, line in enumerate(lines):
        if line.startswith("ITEM: ATOMS"):
            names = line.split()[2:]
            where = [names.index(name) for name in ("x", "y", "z", "radius")]
            frame = {}
            for row in lines[n + 1:]:
                if row.startswith("ITEM") or not row.strip():
                    break
                words = row.split()
                frame[int(words[names.index("id")])] = tuple(float(words[k]) for k in where)
            found.append(frame)
    return found


def same(scene, wanted, got, tolerance=STILL):
    """Both are lists of x, y, z, r in the order of the ids."""
    assert len(wanted) == len(got), (scene, len(wanted), len(got))
    worst = max(abs(a - b) for one, other in zip(wanted, got) for a, b in zip(one, other))
    assert worst <= tolerance, (scene, worst)
    return worst


def settle(command, name, folder, maker, scene, rows):
    """Runs a deck of LAMMPS's kind: still without gravity, held by its walls with it."""
    dump = os.path.join(folder, "run.dump")
    variables = ["-log", "none", "-var", "steps", "1000", "-var", "every", "1000"]
    run([command, "-in", name, *variables, "-var", "gravity", "0"], folder)
    first, last = frames(dump)[0], frames(dump)[-1]
    ids = range(1, len(rows) + 1)
    assert len(frames(dump)) == 2
    same(scene, rows, [first[i] for i in ids])
    worst = same(scene, rows, [last[i] for i in ids])
    variables[4] = variables[7] = "8000"
    run([command, "-in", name, *variables], folder)
    last = frames(dump)[-1]
    text = "".join("%.17g %.17g %.17g %.17g\n" % last[i] for i in ids)
    done = subprocess.run([maker, scene, "-"], input=text, text=True, check=True,
                          stdout=subprocess.PIPE)
    count, least = done.stdout.split()
    assert int(count) == len(rows) and float(least) > -SINK, (scene, done.stdout)
    moved = max(abs(a - b) for i in ids for a, b in zip(rows[i - 1], last[i]))
    assert moved > 0.05 or scene == "periodic", (scene, moved)
    return "%d still to %.1e, then moved %.2g, walls to %s radii" % (
        len(rows), worst, moved, least)


def lammps(maker, scene, folder):
    rows, bonds = make(maker, scene, folder)
    program = need("lmp")
    said = settle(program, "in.lammps", folder, maker, scene, rows)
    script = os.path.join(folder, "again.in")
    with open(script, "w") as file:  # the same pack from its dump
        file.write("units si\natom_style sphere\nboundary f f %s\nregion r block -20 20 "
                   "-20 20 -20 20\ncreate_box 1 r\nread_dump pack.dump 0 x y z "
                   "box yes add yes\npair_style none\nrun 0\nwrite_dump all custom again.dump"
                   " id type radius x y z modify sort id format float %%.17g\n"
                   % ("p" if scene in FLAT else "f"))
    run([program, "-in", script, "-log", "none"], folder)
    again = frames(os.path.join(folder, "again.dump"))[-1]
    assert len(again) == len(rows)
    print(scene, said, "bonds", bonds)


def liggghts(maker, scene, folder):
    rows, _ = make(maker, scene, folder)
    print(scene, settle(need("liggghts"), "in.liggghts", folder, maker, scene, rows))


YADE = """
from yade import pack, ymport
import sys
def report(name, bodies):
    print("FOUND", name, *["%.17g,%.17g,%.17g,%.17g" % (*b.state.pos, b.shape.radius)
                           for b in bodies])
spheres = pack.SpherePack()
spheres.load("pack.spheres" if FLAG else "pack.txt")
print("CELL", *spheres.cellSize)
print("FOUND spheres", *["%.17g,%.17g,%.17g,%.17g" % (*row[0], row[1])
                         for row in spheres.toList()])
geo = ymport.gengeoFile("pack.geo")
report("geo", geo)
bodies = ymport.text("pack.txt")
for b in bodies: O.bodies.append(b)
O.engines = [ForceResetter(), InsertionSortCollider([Bo1_Sphere_Aabb()]),
    InteractionLoop([Ig2_Sphere_Sphere_ScGeom()], [Ip2_FrictMat_FrictMat_FrictPhys()],
                    [Law2_ScGeom_FrictPhys_CundallStrack()]),
    NewtonIntegrator(gravity=(0, 0, 0))]
O.dt = 0.3 * PWaveTimeStep()
O.run(1000, True)
report("text", O.bodies)
"""


def yade(maker, scene, folder):
    rows, _ = make(maker, scene, folder)
    has_pack = os.path.exists(os.path.join(folder, "pack.spheres"))
    with open(os.path.join(folder, "load.py"), "w") as file:
        file.write(YADE.replace("FLAG", str(has_pack)))
    said = run([need("yade"), "-n", "-x", "-j1", "load.py"], folder)
    for name in ("spheres", "geo", "text"):
        line = [line for line in said.splitlines() if line.startswith("FOUND " + name)][0]
        got = [tuple(map(float, word.split(","))) for word in line.split()[2:]]
        same((scene, name), rows, got)
    cell = [line for line in said.splitlines() if line.startswith("CELL")][0].split()[1:]
    if scene == "periodic":
        assert list(map(float, cell)) == [4.0, 4.0, 4.0], cell
    print(scene, len(rows), "still")


ESYS = """
from esys.lsm import *
sim = LsmMpi(numWorkerProcesses=1, mpiDimList=[1, 1, 1])
sim.initNeighbourSearch(particleType="NRotSphere", gridSpacing=0.9, verletDist=0.1)
sim.setNumTimeSteps(1000)
sim.setTimeStepSize(1e-4)
sim.readGeometry("pack.geo")
sim.createInteractionGroup(NRotElasticPrms(name="repel", normalK=1e4, scaling=True))
sim.createCheckPointer(CheckPointPrms(fileNamePrefix="last", beginTimeStep=0,
                                      endTimeStep=1000, timeStepIncr=1000))
sim.run()
"""


def esys(maker, scene, folder):
    """Its checkpoints have 9 digits: x y z r id tag mass, where it began, where it was
    (three each), velocity, force, spin."""
    rows, bonds = make(maker, scene, folder)
    if not (shutil.which("esysparticle") and shutil.which("mpirun")):
        skip("esysparticle")
    with open(os.path.join(folder, "load.py"), "w") as file:
        file.write(ESYS)
    run(["mpirun", "--oversubscribe", "-np", "2", shutil.which("esysparticle"), "load.py"],
        folder)
    with open(os.path.join(folder, "last_t=1000_1.txt")) as file:
        lines = [line.split() for line in file][1:len(rows) + 1]
    found = sorted(lines, key=lambda words: int(words[4]))
    assert [int(words[4]) for words in found] == list(range(len(rows)))
    same(scene, rows, [tuple(map(float, words[:4])) for words in found], 5e-8)
    for words in found:
        assert words[:3] == words[7:10] and set(map(float, words[13:16])) == {0.0}, words
    print(scene, len(rows), "still, bonds", bonds)


VTK = """
import os
import vtk
from vtk.util.numpy_support import vtk_to_numpy
def read(reader, name):
    reader.SetFileName(name)
    reader.Update()
    assert reader.GetErrorCode() == 0
    return reader.GetOutput()
names = ["pack"] + (["zlib"] if os.path.exists("zlib.vtp") else [])  # built with zlib?
for name in names:
    for data in (read(vtk.vtkXMLPolyDataReader(), name + ".vtp"),
                 read(vtk.vtkXMLUnstructuredGridReader(), name + ".vtu")):
        radius = data.GetPointData().GetArray("radius")
        n = data.GetNumberOfPoints()
        lines = [c for c in range(data.GetNumberOfCells()) if data.GetCellType(c) == 3]
        verts = [c for c in range(data.GetNumberOfCells()) if data.GetCellType(c) == 1]
        assert len(verts) == n and all(data.GetCell(c).GetPointId(0) == c for c in verts)
        if lines:
            bond = data.GetCellData().GetArray("bond")
            pairs = [(data.GetCell(c).GetPointId(0), data.GetCell(c).GetPointId(1),
                      bond.GetValue(c)) for c in lines]
            assert all(i < j and t == 1 + j % 2 for i, j, t in pairs), pairs[:5]
        print("FOUND", len(lines), *["%.17g,%.17g,%.17g,%.17g" % (*data.GetPoint(i),
                                     radius.GetValue(i)) for i in range(n)])
for name in ("binary.stl", "text.stl"):
    if not os.path.exists(name):
        continue
    mesh = read(vtk.vtkSTLReader(), name)
    edges = vtk.vtkFeatureEdges()
    edges.SetInputData(mesh)
    edges.FeatureEdgesOff()
    edges.Update()
    mass = vtk.vtkMassProperties()
    mass.SetInputData(mesh)
    mass.Update()
    print("MESH", edges.GetOutput().GetNumberOfCells(), mesh.GetNumberOfCells(),
          mass.GetVolume())
"""


def vtk(maker, scene, folder):
    need_module("vtk")
    rows, bonds = make(maker, scene, folder)
    with open(os.path.join(folder, "load.py"), "w") as file:
        file.write(VTK)
    said = run([sys.executable, "load.py"], folder).splitlines()
    found = [line.split() for line in said if line.startswith("FOUND")]
    assert len(found) in (2, 4), said
    for words in found:
        assert int(words[1]) == bonds
        same(scene, rows, [tuple(map(float, word.split(","))) for word in words[2:]])
    for line in (line for line in said if line.startswith("MESH")):
        if scene not in ("open", "silo"):  # those have an open top
            assert line.split()[1] == "0", (scene, line)
        print(scene, line)


def ase(maker, scene, folder):
    need_module("ase")
    rows, _ = make(maker, scene, folder)
    said = run([sys.executable, "-c", "from ase.io import read; a = read('pack.xyz', "
                "format='extxyz'); print(*['%.17g,%.17g,%.17g,%.17g' % (*p, r) for p, r in "
                "zip(a.positions, a.arrays['radius'])]); print(*a.pbc)"], folder)
    lines = said.strip().splitlines()
    same(scene, rows, [tuple(map(float, word.split(","))) for word in lines[-2].split()])
    periodic = {"periodic": "True True True", "open": "True False False"}
    assert lines[-1] == periodic.get(scene, "False False False"), lines[-1]
    print(scene, len(rows))


def povray(maker, scene, folder):
    program = need("povray")
    rows, _ = make(maker, scene, folder)
    said = run([program, "+Ipack.pov", "+Opack.png", "+W96", "+H72", "-D", "-GA"], folder)
    assert os.path.getsize(os.path.join(folder, "pack.png")) > 500, said
    print(scene, len(rows))


PEERS = {"lammps": (lammps, SOLID + FLAT), "liggghts": (liggghts, SOLID + FLAT),
         "yade": (yade, ("cylinder", "periodic", "rectangle")),
         "esys": (esys, ("box", "bonded")), "vtk": (vtk, SOLID + FLAT),
         "ase": (ase, ("open", "periodic", "rectangle")),
         "povray": (povray, ("silo", "circle"))}


def main():
    peer, maker = sys.argv[1], os.path.abspath(sys.argv[2])
    test, scenes = PEERS[peer]
    for scene in sys.argv[3:] or scenes:
        with tempfile.TemporaryDirectory() as folder:
            test(maker, scene, folder)


main()
