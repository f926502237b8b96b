#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# From a fresh machine to a picture: installs what is missing, builds, generates a mesh, renders it
# without a display, and says where the picture is and what it cost: Examples/demo.sh [FILE.png]
set -euo pipefail
picture=$(realpath -m "${1:-"$(dirname "${BASH_SOURCE[0]}")/../build/demo.png"}")
cd "$(dirname "${BASH_SOURCE[0]}")/.."

now() { date +%s.%N; }
since() { awk -v from="$1" -v to="$(now)" 'BEGIN { printf "%.1f s", to - from }'; }

start=$(now)
Examples/setup.sh
setup=$(since "$start")

start=$(now)
cmake --preset release -DTETRALUX_BUILD_TESTING=OFF -DTETRALUX_WRAP_PYTHON=OFF >/dev/null
cmake --build --preset release
build=$(since "$start")

# 324,000 tetrahedra: a wavy ring, in whose field strands wind around each other.
start=$(now)
build/bin/tetralux generate ring --output build/demo.vtu
generate=$(since "$start")

start=$(now)
build/bin/tetralux render build/demo.vtu --method ray-cast --stats build/demo.json \
  --transfer Examples/demo.json --opacity-unit-distance 0.02 --background 0.02,0.03,0.06 \
  --camera-position 1.9,1.3,3.2 --camera-focal-point 0,-0.05,0 --camera-view-angle 42 \
  --size 1024,768 --output "$picture"
render=$(since "$start")

# statistic NAME: a number from the renderer's own account.
statistic() { sed -n "s/.*\"$1\": *\([-+.0-9e]*\).*/\1/p" build/demo.json | head -n 1; }

echo
echo "set-up $setup, build $build, mesh $generate, picture $render from file to file, of which:"
awk -v intake="$(statistic intake)" -v mesh="$(statistic mesh)" -v cast="$(statistic cast)" \
  -v tetrahedra="$(statistic tetrahedra)" -v bytes="$(statistic bytes)" \
  -v threads="$(statistic threads)" -v error="$(statistic estimate)" 'BEGIN {
    printf "  tables of %d tetrahedra: %.2f s once, %.1f MB\n", tetrahedra, intake + mesh,
      bytes / 1e6
    printf "  rays: %.2f s a frame on %d threads\n", cast, threads
    printf "  estimated error of a colour channel: %.1e\n", error
  }'
echo "picture: $picture"
