#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Measures again what Documentation/bench shows, with one command on a quiet machine (about
# five minutes on two cores):
#
#   TETRALUX_DATA=FOLDER Testing/Benchmarks/bench_page.sh [build/bin/tetralux [OPTIONS OF bench...]]
#
# PAGE=FOLDER writes another folder; with the option --quick, that shows whether all works. Without
# options of bench, the page has the scenes listed here; all that there are take three times as
# long, and more than may be committed.
#
# The page is complete in itself. Beside it go the numbers, the table of how stable the integrals
# are, and the page's first chart, which the README shows. Chromium draws the chart by running the
# page's script (apt-get install chromium). The folder with all pictures is left where the last line
# says.
set -eu

root=$(cd "$(dirname "$0")/../.." && pwd)
tool=${1:-$root/build/bin/tetralux}
[ $# -gt 0 ] && shift
: "${TETRALUX_DATA:?must name the folder of bluntfinxyz.bin, bluntfinq.bin, can.vtu, engine.vti}"
page=${PAGE:-$root/Documentation/bench}
largest=2000 # kilobytes, for all that is committed

if [ $# -eq 0 ]; then
  for scene in blunt-fin-smooth blunt-fin-diverging blunt-fin-needle engine-smooth engine-opaque \
    signal-smooth; do
    set -- "$@" --scene "$scene"
  done
fi

scratch=$(mktemp -d)
result=$scratch/bench
"$tool" bench --data "$TETRALUX_DATA" --features "$@" --output "$result"
mkdir -p "$page"
"$tool" bench --stability > "$page/stability.txt"
cp "$result/index.html" "$result/results.csv" "$page"
chromium --headless --no-sandbox --disable-gpu --disable-background-networking \
  --user-data-dir="$scratch/browser" --dump-dom "file://$result/index.html" 2> "$scratch/chromium" |
  python3 -c 'import re, sys
chart = re.search("<svg .*?</svg>", sys.stdin.read(), re.DOTALL)[0]
print(chart.replace("<svg", "<svg xmlns=\"http://www.w3.org/2000/svg\"", 1))' > "$page/chart.svg"
size=$(du -sk "$page" | cut -f1)
if [ "$size" -gt "$largest" ]; then
  echo "bench_page.sh: $page has $size kB, more than $largest" >&2
  exit 1
fi
echo "$page: $size kB; all pictures: $result"
