#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Equal spheres at random in a box, audited; the library is loaded by ctypes.

usage: pack.py [LIBRARY]
"""
import ctypes as c
import sys

lib = c.CDLL(sys.argv[1] if len(sys.argv) > 1 else "libpacking.so.0")
size, real, handle, many = c.c_size_t, c.c_double, c.c_void_p, c.c_uint64


def struct(*fields):
    return type("Struct", (c.Structure,), {"_fields_": [("struct_size", size), *fields]})


Vec3 = real * 3
Box = struct(("size", Vec3), ("corner", Vec3), ("periodic", c.c_uint), ("open_top", c.c_int))
Mono = struct(("r", real), ("by", c.c_int), ("dim", c.c_int))
Rsa = struct(("seed", many), ("stream", many), ("count", size), ("volume_fraction", real),
             ("order", c.c_int), ("max_failures", many))
Report = struct(("state", c.c_int), ("placed", size), ("unplaced", size), ("attempts", many),
                ("solid_volume", real), ("volume_fraction", real), ("progress", real))
Audit = struct(("passed", c.c_int), ("the_rest", real * 16))
View = struct(("count", size), ("columns", (handle * 2) * 17))


def options(kind, fill, **values):
    made = kind()
    getattr(lib, f"packing_{fill}_def_fill")(c.byref(made), size(c.sizeof(made)))
    for name, value in values.items():
        setattr(made, name, value)
    return made


def call(name, *arguments):
    status = getattr(lib, "packing_" + name)(*arguments)
    if status:
        sys.exit(f"packing_{name}: status {status}")


domain, psd, pack, placer = handle(), handle(), handle(), handle()
box = options(Box, "domain_box", size=Vec3(10, 10, 10))
call("domain_create_box", None, c.byref(box), c.byref(domain))
call("psd_create_mono", None, c.byref(options(Mono, "psd_mono", r=0.5)), c.byref(psd))
call("particles_create", None, None, c.byref(pack))
rsa = options(Rsa, "rsa", volume_fraction=0.25)
call("rsa_create", None, c.byref(rsa), domain, psd, pack, c.byref(placer))
report, view, audit = (kind(struct_size=c.sizeof(kind)) for kind in (Report, View, Audit))
while report.state == 0:
    call("placer_step", placer, size(1), c.byref(report))
lib.packing_particles_view(pack, c.byref(view))
call("audit", None, None, domain, c.byref(view), c.byref(audit))
print(f"{report.placed} spheres, volume fraction {report.volume_fraction:.6f}, audit "
      f"{'passed' if audit.passed else 'failed'}")
for noun, made in (("placer", placer), ("particles", pack), ("psd", psd), ("domain", domain)):
    getattr(lib, f"packing_{noun}_destroy")(made)
sys.exit(0 if audit.passed else 1)
