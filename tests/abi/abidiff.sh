#!/usr/bin/env bash
# The ABI is the one that packing-0.abi records, or has grown as the suppressions allow.
# usage: abidiff.sh SOURCE_ROOT SHARED_LIBRARY
# To record the ABI of a build with debug information (-Ddebug=true):
#   tests/abi/abidiff.sh SOURCE_ROOT SHARED_LIBRARY --record
set -u
source=$1 library=$2
recorded=$source/tests/abi/packing-0.abi
for tool in abidw abidiff readelf; do
  command -v $tool >/dev/null || {
    echo "skipped: $tool is missing"
    exit 77
  }
done
if [ "$(uname -m)" != x86_64 ]; then
  echo "skipped: the ABI was recorded on x86-64"
  exit 77
fi
if ! readelf -S -W "$library" | grep -q '\.debug_info'; then
  echo "skipped: $library has no debug information (meson setup -Ddebug=true)"
  exit 77
fi
if [ "${3-}" = --record ]; then
  # No paths, so that the file is the same from any machine.
  abidw --headers-dir "$source/include/packing" --drop-private-types --no-corpus-path \
    --no-comp-dir-path --no-show-locs --no-elf-needed --exported-interfaces-only \
    --type-id-style hash "$library" |
    sed -e "s|$source/||g" >"$recorded"
  exit
fi
# The record knows handles by name only, so that what is inside them may change.
compare() {
  abidiff --no-added-syms "$@" "$recorded" "$library"
}
compare --suppressions "$source/tests/abi/packing-0.suppr" || exit 1
# libabigail 2.2 takes a struct none of whose members is new for one that grew at its end.
if compare | grep -E 'data member (change|deletion)'; then
  compare
  exit 1
fi
