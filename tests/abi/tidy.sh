#!/usr/bin/env bash
# clang-tidy 14 with the checks of .clang-tidy finds nothing in the library.
# usage: tidy.sh SOURCE_ROOT BUILD_ROOT
set -u
root=$1 build=$2
tool=$(command -v clang-tidy-14 || command -v clang-tidy) || tool=
if [ -z "$tool" ] || ! "$tool" --version | grep -q 'version 14\.'; then
  echo "skipped: clang-tidy 14 is missing"
  exit 77
fi
# -quiet leaves a count of what was suppressed in system headers, which is noise. The database
# is of gcc, whose warnings clang does not all know.
find "$root/lib" -name '*.c' -print0 |
  xargs -0 -n 1 -P "$(nproc)" "$tool" -quiet -p "$build" --warnings-as-errors='*' \
    --extra-arg=-UNDEBUG --extra-arg=-Wno-unknown-warning-option --extra-arg=-Wno-ignored-optimization-argument \
    2> >(grep -v '^[0-9]* warnings\? generated' >&2)
