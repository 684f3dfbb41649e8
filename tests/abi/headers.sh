#!/usr/bin/env bash
# Every public header compiles alone, without a warning, as C99, C11 and C++11.
# usage: headers.sh INCLUDE_DIRECTORY
set -u
include=$1
failed=0
tried=0
warnings=(-Wall -Wextra -pedantic -Werror -Wshadow -Wundef)

# check COMPILER LANGUAGE STANDARD
check() {
  local header name
  for header in "$include"/packing/*.h; do
    name=packing/$(basename "$header")
    tried=$((tried + 1))
    # Twice: the include guard is tried too.
    if ! printf '#include <%s>\n#include <%s>\n' "$name" "$name" |
      "$1" -x "$2" -std="$3" "${warnings[@]}" -I"$include" -fsyntax-only -; then
      echo "$name: not clean as $3 with $1"
      failed=1
    fi
  done
}

for compiler in gcc clang-14 clang; do
  command -v "$compiler" >/dev/null || continue
  check "$compiler" c c99
  check "$compiler" c c11
done
for compiler in g++ clang++-14 clang++; do
  command -v "$compiler" >/dev/null || continue
  check "$compiler" c++ c++11
done

# A header that stood in no install list would be missing at the user's.
list=$include/meson.build
for header in "$include"/packing/*.h; do
  if ! grep -q "'packing/$(basename "$header")'" "$list"; then
    echo "packing/$(basename "$header"): not in include/meson.build"
    failed=1
  fi
done

if [ $tried -eq 0 ]; then
  echo "skipped: no compiler found"
  exit 77
fi
exit $failed
