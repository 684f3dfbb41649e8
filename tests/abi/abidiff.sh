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
if ! readelf -S -W "$library" | grep -q '\.debug_info'; then
  echo "skipped: $library has no debug information (meson setup -Ddebug=true)"
  exit 77
fi
if [ "${3-}" = --record ]; then
  # No paths, so that the file is the same from any machine.
  abidw --headers-dir "$source/include/packing" --drop-private-types --no-corpus-path \
    --no-comp-dir-path --no-show-locs --short-locs --type-id-style hash "$library" |
    sed -e "s|$source/||g" >"$recorded"
  exit
fi
abidiff --headers-dir2 "$source/include/packing" --drop-private-types --no-added-syms \
  --suppressions "$source/tests/abi/packing-0.suppr" "$recorded" "$library"
