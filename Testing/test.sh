#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# All tests, from a fresh machine: installs what is missing, builds, runs every test, the core tests
# once more under the sanitizers but for those of numbers alone, those of lanes on an emulated
# processor, and the checks of format, text and static analysis. Warnings of the compiler are
# errors.
# TETRALUX_DATA: a folder with the data sets that some tests need; without it they are skipped.
# Ends with "N passed, N failed"; the exit status is 0 where none failed.
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.." || exit 1

source Testing/steps.sh

# run_tests PRESET: counts what ctest ran.
run_tests() {
  local report="$PWD/$2/ctest.xml"
  rm -f "$report"
  ctest --preset "$1" -j2 --output-junit "$report"
  local status=$?
  if [[ ! -f "$report" ]]; then
    failed=$((failed + 1))
    return
  fi
  local suite tests failures missed
  suite=$(grep -m1 -A6 '<testsuite ' "$report" | tr '\n' ' ')
  tests=$(attribute tests "$suite")
  failures=$(attribute failures "$suite")
  missed=$(($(attribute skipped "$suite") + $(attribute disabled "$suite")))
  passed=$((passed + tests - failures - missed))
  failed=$((failed + failures))
  skipped=$((skipped + missed))
  if ((status != 0 && failures == 0)); then
    failed=$((failed + 1))
  fi
}

attribute() {
  sed -n "s/.*[[:space:]]$1=\"\([0-9]*\)\".*/\1/p" <<<"$2"
}

sources() {
  find Module Filters Rendering Evaluation Application ParaView Testing Examples \
    -name '*.h' -o -name '*.cxx' -o -name '*.inl'
}

check_format() {
  sources | xargs clang-format --dry-run -Werror
}

check_text() {
  python3 Testing/check_text.py
}

# All that was compiled but what the build made itself, and kernels for other instruction sets than
# the portable one, which have the same source. Testing/.clang-tidy has a shorter list.
# The build's -Werror is taken back, since it makes errors of warnings in VTK's own headers, too.
check_statically() {
  sed -n 's/^ *"file": "\(.*\)",\{0,1\}$/\1/p' build/compile_commands.json | grep -v "^$PWD/build" |
    grep -v 'KernelAvx[0-9]*\.cxx$' | sort -u |
    xargs -P 2 -n 1 clang-tidy -p build --quiet --extra-arg=-Wno-error
}

require "setup" Examples/setup.sh test
require "configure" cmake --preset release -DTETRALUX_BUILD_TESTING=ON -DTETRALUX_WRAP_PYTHON=ON \
  -DTETRALUX_BUILD_BENCHMARKS=ON -DTETRALUX_WARNINGS_AS_ERRORS=ON
require "build" cmake --build --preset release
run_tests release build

require "configure with sanitizers" cmake --preset sanitize -DTETRALUX_WARNINGS_AS_ERRORS=ON
require "build with sanitizers" cmake --build --preset sanitize
run_tests sanitize build-sanitize

check "lanes and kernels for 64-bit ARM" Testing/test_neon.sh
check "clang-format" check_format
check "text" check_text
check "clang-tidy" check_statically
finish
