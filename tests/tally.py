#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Counts what meson's JSON logs say: `N passed, N failed, N skipped`.

usage: tally.py [STAGE=LOG ...]

A TAP test counts by its points, any other test as one. A program that ends badly though all
its points are fine (a crash after the last, a leak, a timeout) counts as one failure more, and
so does a stage whose log is absent or empty. The log of every test that failed is printed.
CMocka 1.1 writes a skipped point as `not ok N # SKIP`; here that is a skip.
"""
import json
import re
import sys

POINT = re.compile(r"^(not )?ok\b\s*\d*\s*(?:-\s*)?([^#]*)(?:#\s*(\S+))?", re.IGNORECASE)
PLAN = re.compile(r"^1\.\.(\d+)", re.MULTILINE)
SKIP_STATUS = 77
BROKEN = ("TIMEOUT", "INTERRUPT")


def tap_points(text):
    passed, failed, skipped = 0, [], 0
    for line in text.splitlines():
        match = POINT.match(line)
        if match is None:
            continue
        bad, name, directive = match.groups()
        if (directive or "").upper().startswith("SKIP"):
            skipped += 1
        elif bad:
            failed.append(name.strip())
        else:
            passed += 1
    return passed, failed, skipped


def tally_test(test):
    """(passed, failed, skipped, what went wrong) of one record of the log."""
    text = test.get("stdout") or ""
    result, code = test["result"], test.get("returncode")
    plan = PLAN.search(text)
    if plan is None:
        if result == "SKIP" and code == SKIP_STATUS:
            return 0, 0, 1, None
        fine = result in ("OK", "EXPECTEDFAIL")
        # A TAP test that says nothing is a skip to meson.
        return int(fine), int(not fine), 0, None if fine else f"{result.lower()}, status {code}"
    planned = int(plan.group(1))
    if planned == 0 and code == 0:
        return 0, 0, 1, None
    passed, failed, skipped = tap_points(text)
    if failed:
        return passed, len(failed), skipped, ", ".join(failed)
    if result in BROKEN or code != 0 or planned != passed + skipped:
        return passed, 1, skipped, f"{result.lower()}, exit status {code}"
    return passed, 0, skipped, None


def main(arguments):
    total = [0, 0, 0]
    for argument in arguments:
        stage, _, path = argument.partition("=")
        try:
            with open(path, encoding="utf-8") as log:
                tests = [json.loads(line) for line in log if line.strip()]
        except OSError:
            tests = []
        if not tests:
            print(f"{stage}: no tests ran")
            total[1] += 1
        for test in tests:
            passed, failed, skipped, wrong = tally_test(test)
            total = [a + b for a, b in zip(total, (passed, failed, skipped))]
            if wrong is not None:
                print(f"--- {stage}: {test['name']}: FAILED: {wrong}")
                print((test.get("stdout") or "") + (test.get("stderr") or ""), end="\n\n")
            elif skipped:
                text = (test.get("stdout") or "") + (test.get("stderr") or "")
                word = next((line for line in text.splitlines() if "skip" in line.lower()), "")
                print(f"--- {stage}: {test['name']}: skipped {skipped}: {word.strip()}")
    print("%d passed, %d failed, %d skipped" % tuple(total))
    return 1 if total[1] or not total[0] else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
