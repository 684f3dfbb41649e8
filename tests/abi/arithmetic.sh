#!/usr/bin/env bash
# The same bytes everywhere: no multiply and add is contracted into one rounding, and no file is
# compiled with options that relax IEEE arithmetic.
# usage: arithmetic.sh ARCHIVE BUILD_ROOT
set -u
archive=$1 build=$2
fused='vf(n?m(add|sub)|madd|msub)|\bf(n?m(add|sub)|mla|mls)\b|\bfml[as]\b'
failed=0

# The search finds what it looks for.
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
echo 'double f(double a, double b, double c) { return a * b + c; }' >"$work/f.c"
case $(uname -m) in
x86_64) arch=(-mfma) ;;
*) arch=() ;;
esac
cc -O2 "${arch[@]}" -ffp-contract=fast -c "$work/f.c" -o "$work/fused.o" || exit 1
cc -O2 "${arch[@]}" -ffp-contract=off -c "$work/f.c" -o "$work/plain.o" || exit 1
if ! objdump -d "$work/fused.o" | grep -qE "$fused"; then
  echo "the search finds no fused instruction in code that has one"
  failed=1
fi
if objdump -d "$work/plain.o" | grep -E "$fused"; then
  echo "-ffp-contract=off does not keep the compiler from contracting"
  failed=1
fi

if objdump -d "$archive" | grep -E "$fused|\.o: " | grep -B1 -E "$fused"; then
  echo "fused instructions in the library"
  failed=1
fi
objdump -d "$archive" | grep -q mul || {
  echo "no code was read from $archive"
  failed=1
}

commands=$build/compile_commands.json
count=$(grep -c '"command":.*/lib/\|"command":.* \.\./lib/' "$commands")
exact=$(grep '"command":.*/lib/\|"command":.* \.\./lib/' "$commands" |
  grep -c -e '-ffp-contract=off')
if [ "$count" -eq 0 ] || [ "$count" -ne "$exact" ]; then
  echo "$exact of $count files of the library are compiled with -ffp-contract=off"
  failed=1
fi
if grep -E '"command":.*-(ffast-math|Ofast|funsafe-math|fassociative-math|freciprocal-math|mrecip|fno-signed-zeros|ffinite-math)' \
  "$commands"; then
  echo "an option relaxes IEEE arithmetic"
  failed=1
fi
exit $failed
