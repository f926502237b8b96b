#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Compiles the core for 64-bit ARM and runs the tests of its lanes and kernels on an emulated
# processor. Installs what is missing. The emulator is slow: the longest tests are left out.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

Examples/setup.sh test neon
cmake -S Testing/Neon -B build-neon -G Ninja -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_TOOLCHAIN_FILE=toolchain.cmake
cmake --build build-neon
slow='*Lit*:*DrawsRandomScenes:*LightsAllMeshes:*ForPolygons*:*BothTrees:*GenericKernel*'
OMP_WAIT_POLICY=passive qemu-aarch64 -L /usr/aarch64-linux-gnu build-neon/NeonTests \
  --gtest_filter="-$slow"
