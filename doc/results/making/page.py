# SPDX-License-Identifier: GPL-3.0-or-later
"""What heads and closes every page of results: the machine, the source, the notes by hand."""
import os
import re
import subprocess


def shell(root, *command):
    done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=root)
    return done.stdout.strip() or "unknown"


def machine():
    with open("/proc/cpuinfo", encoding="ascii") as file:
        found = re.search(r"model name\s*: (.*)", file.read())
    with open("/etc/os-release", encoding="utf-8") as file:
        system = re.search(r'PRETTY_NAME="(.*)"', file.read())
    return (f"{os.cpu_count()} cores of {found.group(1) if found else 'an unknown processor'}, "
            f"{system.group(1) if system else 'an unknown system'}")


def version(root):
    """The commit, and whether what makes packs differs from it; pages and pictures do not matter."""
    changed = subprocess.run(["git", "status", "--porcelain", "--", "include", "lib", "examples",
                              "tests/bench"], capture_output=True, text=True, check=False, cwd=root)
    return shell(root, "git", "describe", "--always") + "-dirty" * bool(changed.stdout)


def read_notes(path):
    """Sections of a file of notes by the name of their part."""
    if not path.exists():
        return {}
    pieces = re.split(r"^## (\w+)\n", path.read_text(encoding="utf-8"), flags=re.M)
    return {name: body.strip() for name, body in zip(pieces[1::2], pieces[2::2])}
