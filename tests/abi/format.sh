#!/usr/bin/env bash
# Every C file is as clang-format 14 writes it.
# usage: format.sh SOURCE_ROOT
set -u
cd "$1" || exit 1
tool=$(command -v clang-format-14 || command -v clang-format) || tool=
# Other versions lay out some lines otherwise.
if [ -z "$tool" ] || ! "$tool" --version | grep -q 'version 14\.'; then
  echo "skipped: clang-format 14 is missing"
  exit 77
fi
find include lib examples tests -name '*.[ch]' -print0 | xargs -0 "$tool" --dry-run -Werror
