# SPDX-License-Identifier: GPL-3.0-or-later
"""What README.md shows is what is there: readme.py PROGRAM SOURCE_ROOT PROGRAM ..."""
import os
import re
import subprocess
import sys
from cli import equal, holds, main

ROOT = sys.argv[2]


def text_of(*path):
    with open(os.path.join(ROOT, *path), encoding="utf-8") as file:
        return file.read()


def program_is_the_example(_):
    shown = re.search(r"```c\n(.*?)```", text_of("README.md"), re.S).group(1)
    equal(shown.splitlines(), text_of("examples", "link", "pack.c").splitlines(), "pack.c")


def links_lead_somewhere(_):
    for target in re.findall(r"\]\(([^)#:]+)\)", text_of("README.md")):
        holds(os.path.exists(os.path.join(ROOT, target)), target)


def options_exist(_):
    """Of the commands in blocks of their own, line by line."""
    programs = {os.path.basename(path): path for path in (sys.argv[1], *sys.argv[3:])}
    known = {name: subprocess.run([path, "--help"], capture_output=True, text=True,
                                  check=True).stdout for name, path in programs.items()}
    seen = set()
    for block in re.findall(r"```\n(packing-.*?)```", text_of("README.md"), re.S):
        for command in block.replace("\\\n", " ").splitlines():
            name = command.split()[0]
            seen.add(name)
            for option in re.findall(r"--[a-z-]+", command):
                holds(re.search(re.escape(option) + r"\b", known[name]), command)
    equal(seen, set(programs), "programs with a command")


def handles_are_in_the_headers(_):
    table = text_of("README.md").split("## The handles at a glance")[1].split("##")[0]
    for names, header in re.findall(r"^\| (`[^|]+) \|[^|]*\| `([^`]+)` \|$", table, re.M):
        declared = text_of("include", *header.split("/"))
        for name in re.findall(r"packing_\w+", names):
            holds(name in declared, "%s is not in %s" % (name, header))


def coverage_names_what_is_there(_):
    """Files of doc/coverage.md exist, and each test named after a file stands in it."""
    seen = 0
    for row in text_of("doc", "coverage.md").splitlines():
        for part in re.split(r"[;|]", row):
            file = re.search(r"`((?:lib|tests|doc|examples)/[\w./-]+)`(.*)", part)
            if file is None:
                continue
            name, rest = file.groups()
            holds(os.path.exists(os.path.join(ROOT, name)), name)
            if name.startswith("tests/") and os.path.isfile(os.path.join(ROOT, name)):
                for test in re.findall(r"\b[a-z0-9]+(?:_[a-z0-9]+)+\b", rest):
                    holds(test in text_of(*name.split("/")), "%s: %s" % (name, test))
                    seen += 1
    holds(seen > 30, "%d tests are named" % seen)


main([(test.__name__.replace("_", " "), test) for test in (
    program_is_the_example, links_lead_somewhere, options_exist,
    handles_are_in_the_headers, coverage_names_what_is_there)])
