#!/usr/bin/env bash
# Times libpacking and LAMMPS in turn on the same settling bed, one thread each, and prints the
# medians and their ratio.
# usage: compare.sh [-b BUILD=build] [-n RUNS=5] [-s SETTLE=15000] [-t TIMED=5000]
# Input: 8000 spheres, radius 0.02, base 1 x 1, by gen_rsa.c; each run settles, then is timed.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
build=build runs=5 settle=15000 timed=5000
while getopts b:n:s:t: option; do
  case $option in
  b) build=$OPTARG ;;
  n) runs=$OPTARG ;;
  s) settle=$OPTARG ;;
  t) timed=$OPTARG ;;
  *) exit 2 ;;
  esac
done
ours=$(realpath "$build/tests/bench/bench-dem")
[ -x "$ours" ] || {
  echo "$ours is missing: ninja -C $build" >&2
  exit 2
}
command -v lmp >/dev/null || {
  echo "LAMMPS (lmp) is missing: tests/deps --peers" >&2
  exit 2
}
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
cd "$dir"
cc -O2 -o gen_rsa "$here/gen_rsa.c" -lm
./gen_rsa 8000 0.02 1 0.25 1 start.data start.txt >/dev/null
export OMP_NUM_THREADS=1

# lammps DECK
lammps() {
  lmp -in "$here/$1" -var data start.data -var L 1 -var settle "$settle" \
    -var timed "$timed" -log none 2>&1 |
    awk -v s="$timed" '/^Loop time/ { t = $4 }
      END { if (!t) exit 1; printf "%.4g particle-steps/s (%.2f s)\n", 8000 * s / t, t }'
}

# median FILE: of the first column
median() {
  sort -g "$1" | awk '{ v[NR] = $1 }
    END { print NR % 2 ? v[(NR + 1) / 2] : (v[NR / 2] + v[NR / 2 + 1]) / 2 }'
}

lmp -h 2>/dev/null | grep -m 1 '^Large-scale' || :
sed -n 's/^model name.*: //p' /proc/cpuinfo | head -n 1
echo "8000 spheres, $settle steps to settle, $timed timed, one thread, $runs runs in turn"
echo "libpacking: friction slides continuously, no history (Campello and Cassares)"
echo "LAMMPS:     gran/hertz/history, with the tangential history of each contact"
echo "LAMMPS nh:  pair style granular, hertz/material, linear_nohistory"
for run in $(seq "$runs"); do
  printf '%s  libpacking  ' "$run"
  "$ours" start.txt "$settle" "$timed" | tee -a ours
  printf '%s  LAMMPS      ' "$run"
  lammps lammps_settle.in | tee -a theirs
  printf '%s  LAMMPS nh   ' "$run"
  lammps lammps_settle_no_history.in | tee -a theirs_nh
done
awk -v a="$(median ours)" -v b="$(median theirs)" -v c="$(median theirs_nh)" 'BEGIN {
  printf "medians: libpacking %.3g, LAMMPS %.3g (ratio %.2f), LAMMPS nh %.3g (ratio %.2f)\n",
    a, b, a / b, c, a / c }'
