#!/usr/bin/env bash
# What `meson install` puts down can be used: the programs of examples/link are made against it
# through pkg-config, with the shared library, with the archive, and through ctypes, and all
# print the same pack.
# usage: link.sh SOURCE_ROOT BUILD_ROOT
set -u
source=$1 build=$2
stage=$(mktemp -d)
trap 'rm -rf "$stage"' EXIT
failed=0

complain() {
  echo "$*"
  failed=1
}

for tool in pkg-config meson; do
  command -v $tool >/dev/null || {
    echo "skipped: $tool is missing"
    exit 77
  }
done

DESTDIR=$stage meson install -C "$build" --no-rebuild --quiet || exit 1
pc=$(find "$stage" -name packing.pc)
lib=$(dirname "$(dirname "$pc")")
export PKG_CONFIG_SYSROOT_DIR=$stage PKG_CONFIG_PATH=${pc%/*}
pkg-config --validate packing || complain "packing.pc is not valid"

include=$(dirname "$(dirname "$(find "$stage" -name packing.h)")")
# What was promised is there.
[ -e "$lib/libpacking.so.0" ] || complain "no libpacking.so.0"
[ -e "$lib/libpacking.a" ] || complain "no libpacking.a"
objdump -p "$lib/libpacking.so.0" | grep -q 'SONAME *libpacking\.so\.0$' || complain "wrong soname"
for header in "$source"/include/packing/*.h; do
  cmp -s "$header" "$include/packing/${header##*/}" ||
    complain "${header##*/} is not installed"
done
[ -n "$(pkg-config --modversion packing)" ] || complain "packing.pc has no version"
if grep -rqF -e "$source" -e "$build" "$pc"; then
  complain "packing.pc names this machine's directories"
fi
if objdump -p "$lib/libpacking.so.0" | grep -E 'RPATH|RUNPATH'; then
  complain "the installed library has a run path"
fi

# try NAME PROGRAM ...: runs it and compares its line with the first one's.
expected=
try() {
  local name=$1 line
  shift
  if ! line=$(LD_LIBRARY_PATH=$lib "$@"); then
    complain "$name: failed"
    return
  fi
  echo "$name: $line"
  [ "$line" = "${expected:=$line}" ] || complain "$name: differs from '$expected'"
}

# make NAME COMPILER SOURCE OPTIONS ...: compiles an example and tries it.
make() {
  local name=$1 compiler=$2 file=$3
  shift 3
  if "$compiler" -Wall -Wextra -Werror -o "$stage/program" "$source/examples/link/$file" "$@"; then
    try "$name" "$stage/program"
  else
    complain "$name: does not link"
  fi
}

read -ra flags <<<"$(pkg-config --cflags --libs packing)"
read -ra static <<<"$(pkg-config --cflags --libs --static packing)"
make 'C' cc pack.c -std=c99 "${flags[@]}"
case $expected in
*' spheres, volume fraction 0.2'*', audit passed') ;;
*) complain "not the pack that was asked for: $expected" ;;
esac
if command -v c++ >/dev/null; then
  make 'C++' c++ pack.cpp -std=c++11 "${flags[@]}"
fi
if [ -x /usr/bin/python3 ]; then
  try 'ctypes' env PYTHONDONTWRITEBYTECODE=1 /usr/bin/python3 "$source/examples/link/pack.py"
fi
make 'C, all static' cc pack.c -std=c99 -static "${static[@]}"
# The archive within a program that is otherwise dynamic.
rm "$lib"/libpacking.so*
make 'C, archive' cc pack.c -std=c99 "${static[@]}"
exit $failed
