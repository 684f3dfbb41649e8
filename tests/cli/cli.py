# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs a program in an empty folder and says what came of it, as TAP."""
import os
import subprocess
import sys
import tempfile
import traceback

DONE, SHORT, BAD_INPUT, SYSTEM, INTERRUPTED = 0, 1, 2, 3, 130


class Result:
    def __init__(self, code, out, err, files):
        self.code, self.out, self.err, self.files = code, out, err, files


class Skip(Exception):
    """Raised where the machine lacks what a test needs; says what."""


class Folder:
    """A folder that goes away, with the program's output and files in it."""

    def __init__(self, program):
        self.program = program

    def __enter__(self):
        self.hold = tempfile.TemporaryDirectory()
        self.path = self.hold.name
        return self

    def __exit__(self, *ignored):
        self.hold.cleanup()

    def write(self, name, text):
        with open(os.path.join(self.path, name), "w") as file:
            file.write(text)

    def read(self, name):
        with open(os.path.join(self.path, name), "rb") as file:
            return file.read()

    def run(self, *arguments, **more):
        done = subprocess.run([self.program, *arguments], cwd=self.path,
                              stdin=subprocess.DEVNULL, capture_output=True,
                              timeout=100, **more)
        return Result(done.returncode, done.stdout, done.stderr.decode(),
                      sorted(os.listdir(self.path)))


def equal(got, wanted, what):
    if got != wanted:
        raise AssertionError("%s: %r instead of %r" % (what, got, wanted))


def holds(condition, what):
    if not condition:
        raise AssertionError(what)


def one_line(result, *words):
    """One line on standard error that has all the words."""
    lines = result.err.splitlines()
    equal(len(lines), 1, "lines on standard error: %r" % result.err)
    for word in words:
        holds(word in lines[0], "%r is not in %r" % (word, lines[0]))


def refuses(arguments, words, code=BAD_INPUT, files=(), out=True):
    """A test that a command line ends with a line of these words and writes nothing."""
    def test(program):
        with Folder(program) as folder:
            for name, text in files:
                folder.write(name, text)
            before = sorted(os.listdir(folder.path))
            where = ["--out", "pack.csv", "--report", "report.json"] if out else []
            result = folder.run(*arguments, *where)
            equal(result.code, code, "exit code (%s)" % result.err)
            equal(result.out, b"", "standard output")
            equal(result.files, before, "files")
            one_line(result, os.path.basename(program), *words)
    return test


def main(tests):
    """Runs (name, function of the program's path) pairs; argv[1] is the program."""
    failed = 0
    print("1..%d" % len(tests))
    for number, (name, test) in enumerate(tests, 1):
        try:
            test(os.path.abspath(sys.argv[1]))
            print("ok %d - %s" % (number, name))
        except Skip as word:
            print("ok %d - %s # SKIP %s" % (number, name, word))
        except Exception:  # a test that stops is a test that failed
            failed += 1
            print("not ok %d - %s" % (number, name))
            for line in traceback.format_exc().splitlines():
                print("# " + line)
        sys.stdout.flush()
    sys.exit(failed > 0)
