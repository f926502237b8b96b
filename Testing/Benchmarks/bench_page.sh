#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Measures again what Documentation/bench shows, with one command on a quiet machine (about a
# quarter of an hour on two cores):
#
#   TETRALUX_DATA=FOLDER Testing/Benchmarks/bench_page.sh [build/bin/tetralux [OPTIONS OF bench...]]
#
# The page is complete in itself; of the other files, those come along that something refers to: the
# numbers, and the chart that the README shows. The folder with all pictures is left where the last
# line says. The table of how stable the integrals are goes beside the page.
set -eu

root=$(cd "$(dirname "$0")/../.." && pwd)
tool=${1:-$root/build/bin/tetralux}
[ $# -gt 0 ] && shift
: "${TETRALUX_DATA:?must name the folder with bluntfinxyz.bin, bluntfinq.bin and can.vtu}"
page=$root/Documentation/bench
largest=2000 # kilobytes, for all that is committed

result=$(mktemp -d)/bench
"$tool" bench --data "$TETRALUX_DATA" --features "$@" --output "$result"
mkdir -p "$page"
"$tool" bench --stability > "$page/stability.txt"
cp "$result/index.html" "$result/results.csv" "$result/charts/blunt-fin-smooth.png" "$page"
size=$(du -sk "$page" | cut -f1)
if [ "$size" -gt "$largest" ]; then
  echo "bench_page.sh: $page has $size kB, more than $largest" >&2
  exit 1
fi
echo "$page: $size kB; all pictures: $result"
