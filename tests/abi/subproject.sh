#!/usr/bin/env bash
# A meson project takes libpacking as a subproject: the library is built, nothing else is.
# usage: subproject.sh SOURCE_ROOT
set -u
source=$1
host=$(mktemp -d)
trap 'rm -rf "$host"' EXIT
mkdir -p "$host/subprojects/packing"
cp -r "$source"/{meson.build,packing.pc.in,include,lib,COPYING} "$host/subprojects/packing/" || exit 1
cp "$source/examples/link/pack.c" "$host/"
cat >"$host/meson.build" <<'END'
project('host', 'c', default_options: ['buildtype=plain', 'default_library=shared'])
packing_dep = dependency('packing', fallback: ['packing', 'packing_dep'])
executable('pack', 'pack.c', dependencies: packing_dep)
END
cd "$host" || exit 1
# An installed libpacking must not stand in for the subproject.
if ! { meson setup build --wrap-mode=forcefallback && ninja -C build pack; } >log 2>&1; then
  cat log
  exit 1
fi
build/pack
