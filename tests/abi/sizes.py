#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Prints how long functions and files are, and fails above the caps of doc/style.md.

usage: sizes.py SOURCE_ROOT
"""
import pathlib
import sys

FILE_CAP, FUNCTION_CAP = 1000, 120


def functions(lines):
    """(first line number, length) of each; the format puts both braces into column one."""
    start = None
    for number, line in enumerate(lines, 1):
        if line == "{":
            start = number
        elif line == "}" and start is not None:
            yield start, number - start - 1
            start = None


def rank(values, share):
    values = sorted(values)
    return values[min(len(values) - 1, int(share * len(values)))] if values else 0


def main(root):
    root, failed = pathlib.Path(root), False
    for part in ("lib", "include", "examples", "tests"):
        files, lengths = [], []
        for path in sorted((root / part).rglob("*.[ch]")):
            lines = path.read_text(encoding="utf-8").splitlines()
            files.append(len(lines))
            if len(lines) > FILE_CAP and part != "include":
                print(f"{path.relative_to(root)}: {len(lines)} lines, at most {FILE_CAP}")
                failed = True
            for line, length in functions(lines):
                lengths.append(length)
                if length > FUNCTION_CAP:
                    print(f"{path.relative_to(root)}:{line}: a function of {length} lines, "
                          f"at most {FUNCTION_CAP}")
                    failed = True
        if part == "lib" and not lengths:
            print("no functions found")
            failed = True
        print(f"{part}: {len(files)} files of {sum(files)} lines, median {rank(files, 0.5)}, "
              f"longest {max(files, default=0)}; {len(lengths)} functions, "
              f"median {rank(lengths, 0.5)}, p90 {rank(lengths, 0.9)}, "
              f"longest {max(lengths, default=0)}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
