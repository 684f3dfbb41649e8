#!/usr/bin/env bash
# Times the same gravity settling in LAMMPS, LIGGGHTS and YADE, whichever are installed
# (tests/deps --peers), and prints particle-steps per second of each.
# usage: settle.sh [N=8000] [SETTLE=15000] [TIMED=5000]
# Radius 0.02, base 1 x 1, the 3D material of Campello and Cassares (2016).
set -eu
here=$(cd "$(dirname "$0")" && pwd)
n=${1:-8000} settle=${2:-15000} timed=${3:-5000} L=1
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
cd "$dir"
cc -O2 -o gen_rsa "$here/gen_rsa.c" -lm
read -r _ H _ < <(./gen_rsa "$n" 0.02 $L 0.25 1 start.data start.txt)
H=$(awk -v h="$H" 'BEGIN { print 1.03 * h }')

rate() {
  awk -v n="$n" -v s="$timed" '/^Loop time/ { t = $4 }
    END { if (t) printf "%.4g particle-steps/s (%.2f s)\n", n * s / t, t; else print "failed" }'
}

export OMP_NUM_THREADS=1
if command -v lmp >/dev/null; then
  printf 'LAMMPS    '
  lmp -in "$here/lammps_settle.in" -var data start.data -var L $L -var settle "$settle" \
    -var timed "$timed" -log none 2>&1 | rate
fi
if command -v liggghts >/dev/null; then
  printf 'LIGGGHTS  '
  sed 's/Atoms # sphere/Atoms/' start.data >start.lig
  liggghts -in "$here/liggghts_settle.in" -var data start.lig -var L $L -var H "$H" \
    -var settle "$settle" -var timed "$timed" -log none 2>&1 | rate
fi
if command -v yade >/dev/null; then
  printf 'YADE      '
  yade -j1 -n -x "$here/yade_settle.py" start.txt $L "$settle" $((timed / 5)) 2>&1 |
    sed -n 's/^YADE //p'
fi
