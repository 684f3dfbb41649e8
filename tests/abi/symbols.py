#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Holds the library's symbols against packing.map and the headers.

usage: symbols.py SHARED_LIBRARY ARCHIVE MAP INCLUDE_DIRECTORY [asserts]

With `asserts` (a debug build) a failed assert may end the process.

1. exported by the shared library == listed in packing.map == marked PACKING_API in the headers;
2. every global symbol of the archive starts with packing_;
3. nothing writable lives outside handles;
4. nothing is called that ends the process, prints, or changes the process's state, and memory
   comes from the context's allocator.
"""
import pathlib
import re
import subprocess
import sys

FORBIDDEN = re.compile(
    r"""^(
    abort|exit|_exit|_Exit|quick_exit|atexit|
    (v|f|vf|d|vd)?printf|(__)?(v|f|vf)?printf_chk|puts|fputs|putchar|putc|fputc|perror|
    stdout|stderr|stdin|
    s?rand|rand_r|s?random|[dlm]rand48|srand48|
    setlocale|uselocale|newlocale|strtod|strtof|strtold|atof|f?scanf|sscanf|__isoc99_.*scanf|
    signal|sigaction|raise|kill|chdir|fchdir|umask|setenv|putenv|unsetenv|
    fesetround|fesetenv|feenableexcept|fedisableexcept|feupdateenv|
    time|clock|gettimeofday|clock_gettime|
    strtok|localtime|gmtime|asctime|ctime|
    gsl_set_error_handler.*|gsl_.*_alloc|gsl_error|
    malloc|calloc|realloc|aligned_alloc|memalign|valloc|strdup|strndup|asprintf|
    omp_set_.*
    )$""",
    re.VERBOSE,
)
# The default allocator and nothing else touches the C library's.
MEMORY = re.compile(r"^(posix_memalign|free)$")
MEMORY_OWNER = "base_context.c.o"
# The stepper times its own steps to choose how many threads pay; no result depends on it.
CLOCK = re.compile(r"^clock_gettime$")
CLOCK_OWNER = "dem_threads.c.o"
WRITABLE = re.compile(r"^\.(data|bss|tdata|tbss|tm_clone_table)(?!\.rel\.ro)|^\*COM\*")

# A line of objdump -t: value, flags, section, size, visibility, name.
SYMBOL = re.compile(r"^[0-9a-f]{8,} (.{7}) (\S+)\s+[0-9a-f]+ (?:\.\w+ )?(\S+)$")


def run(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def in_headers(include):
    names = set()
    for header in pathlib.Path(include).glob("packing/*.h"):
        text = re.sub(r"/\*.*?\*/", "", header.read_text(), flags=re.DOTALL)
        text = re.sub(r"^#.*?(?<!\\)$", "", text, flags=re.DOTALL | re.MULTILINE)
        for declaration in re.findall(r"PACKING_API\b([^;]*);", text):
            names.add(re.search(r"\b(packing_\w+)\s*\(", declaration).group(1))
    return names


def in_map(path):
    text = re.sub(r"/\*.*?\*/", "", pathlib.Path(path).read_text(), flags=re.DOTALL)
    listed = re.search(r"global:(.*?)local:\s*\*;", text, re.DOTALL).group(1)
    return set(re.findall(r"\w+", listed))


def exported(library):
    lines = run("nm", "-D", "--defined-only", library).splitlines()
    return {f[2].split("@")[0] for f in map(str.split, lines) if f[1] != "A"}


def archive_symbols(archive):
    """(object, name, section, is_global, is_undefined) of each symbol."""
    member = ""
    for line in run("objdump", "-t", "-w", archive).splitlines():
        found = re.match(r"^(\S+\.o):\s+file format", line)
        if found:
            member = found.group(1)
        found = SYMBOL.match(line)
        if found:
            flags, section, name = found.groups()
            if "d" not in flags:
                is_global = flags[0] in "gu!" or "w" in flags
                yield member, name, section, is_global, section == "*UND*"


def is_forbidden(name, member, asserts):
    if name == "__assert_fail":
        return not asserts
    if MEMORY.match(name):
        return not member.endswith(MEMORY_OWNER)
    if CLOCK.match(name):
        return not member.endswith(CLOCK_OWNER)
    return FORBIDDEN.match(name) is not None


def differences(title, left, left_name, right, right_name):
    wrong = [f"{n}: {left_name}, but not {right_name}" for n in sorted(left - right)]
    wrong += [f"{n}: {right_name}, but not {left_name}" for n in sorted(right - left)]
    return [f"{title}: {w}" for w in wrong]


def main(library, archive, map_file, include, asserts=""):
    headers, mapped, shared = in_headers(include), in_map(map_file), exported(library)
    wrong = differences("map", headers, "marked in a header", mapped, "in packing.map")
    wrong += differences("exports", mapped, "in packing.map", shared, "exported")
    members, seen = set(), 0
    for member, name, section, is_global, undefined in archive_symbols(archive):
        members.add(member)
        seen += 1
        if undefined:
            if is_forbidden(name, member, asserts):
                wrong.append(f"{member}: calls {name}")
            continue
        if is_global and not name.startswith("packing_"):
            wrong.append(f"{member}: global {name} does not start with packing_")
        if is_global and name not in headers and not name.startswith("packing_i_"):
            wrong.append(f"{member}: {name} is internal, but does not start with packing_i_")
        if WRITABLE.match(section):
            wrong.append(f"{member}: {name} is writable ({section})")
    if seen < len(shared) or not headers:
        wrong.append("nothing was read: the tools' output is not understood")
    print("\n".join(wrong) or f"{len(shared)} symbols exported, {len(members)} objects clean")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
