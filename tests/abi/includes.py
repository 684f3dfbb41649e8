#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Holds the #include lines against "Who may include whom" of doc/design.md.

usage: includes.py SOURCE_ROOT
"""
import pathlib
import re
import sys

# Each module may see those named, and itself.
BELOW = {
    "base": set(),
    "math": {"base"},
    "rng": {"base", "math"},
    "psd": {"base", "math", "rng"},
    "mesh": {"base", "math", "delaunay"},
    "shape": {"base", "math", "domain"},
    "domain": {"base", "math", "mesh"},
    "particles": {"base", "math"},
    "grid": {"base", "math", "domain", "particles"},
    "delaunay": {"base", "math"},
    "place": {"base", "math", "rng", "psd", "shape", "domain", "particles", "grid",
              "delaunay"},
    "dem": {"base", "math", "rng", "psd", "shape", "domain", "particles", "grid"},
    "measure": {"base", "math", "rng", "psd", "shape", "domain", "particles", "grid",
                "delaunay"},
    "io": {"base", "math", "rng", "psd", "shape", "mesh", "domain", "particles", "grid"},
}
# Public headers named otherwise than their module.
MODULE_OF = {"types": "base", "placer": "place", "contacts": "measure", "order": "measure",
             "pores": "measure", "porosity": "measure", "sizes": "measure", "readers": "io",
             "writers": "io", "front": "place", "loosen": "place", "tangency": "place",
             "solids": "domain"}
# What only some modules may use.
RESERVED = {
    "gsl/": {"rng", "psd", "measure", "place"},
    "zlib.h": {"io"},
    "omp.h": {"base"},
    "immintrin.h": {"rng", "grid", "place", "dem", "measure"},
}
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.MULTILINE)


def module_of_public(name):
    stem = pathlib.PurePath(name).stem
    return MODULE_OF.get(stem, stem)


def sources(folder):
    return sorted(p for p in folder.rglob("*.[ch]") if p.is_file())


def includes(path):
    return INCLUDE.findall(path.read_text(encoding="utf-8"))


def check_module_line(module, quote, name, owners):
    """What is wrong with one line of a file of `module`, or None."""
    if name.startswith("packing/"):
        other = module_of_public(name)
        if other == "packing":
            return "the umbrella header is for users"
        if other != module and other not in BELOW[module]:
            return f"{module} may not see {other}"
    elif quote == '"':
        other = owners.get(pathlib.PurePath(name).name)
        if other is None:
            return "no such private header"
        if other != module and other not in BELOW[module]:
            return f"{module} may not see {other}"
    for prefix, modules in RESERVED.items():
        if name.startswith(prefix) and module not in modules:
            return f"{module} may not use {prefix}"
    return None


def check_library(root):
    headers = [p for p in sources(root / "lib") if p.suffix == ".h"]
    owners = {p.name: p.relative_to(root / "lib").parts[0] for p in headers}
    for path in sources(root / "lib"):
        module = path.relative_to(root / "lib").parts[0]
        if module not in BELOW:
            yield path, module, "an unknown module"
            continue
        for quote, name in includes(path):
            wrong = check_module_line(module, quote, name, owners)
            if wrong:
                yield path, name, wrong
    public = {p.name for p in sources(root / "include")}
    for path in headers:
        if path.name in public:
            yield path, path.name, "shares its basename with a public header"


def check_public(root):
    for path in sources(root / "include"):
        module = module_of_public(path.name)
        for quote, name in includes(path):
            if quote == '"' or ("/" in name and not name.startswith("packing/")):
                yield path, name, "a public header includes standard headers and ours only"
            elif name.startswith("packing/") and module != "packing":
                other = module_of_public(name)
                if other != module and other not in BELOW[module]:
                    yield path, name, f"{module} may not see {other}"


def check_users(root):
    """Programs and tests see the public headers only; tests/internal may see more."""
    private = {p.name for p in sources(root / "lib") if p.suffix == ".h"}
    for path in sources(root / "examples") + sources(root / "tests"):
        if path.is_relative_to(root / "tests" / "internal"):
            continue
        for _, name in includes(path):
            if (path.parent / name).is_file():
                continue
            if pathlib.PurePath(name).name in private or name.startswith("lib/"):
                yield path, name, "a private header of the library"


def main(root):
    root = pathlib.Path(root)
    wrong = [*check_library(root), *check_public(root), *check_users(root)]
    for path, name, why in wrong:
        print(f"{path.relative_to(root)}: {name}: {why}")
    if not sources(root / "lib"):
        print("no sources found")
        return 1
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
