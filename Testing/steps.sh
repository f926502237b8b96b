# SPDX-License-Identifier: BSD-3-Clause
# The steps of scripts that run tests, and their count; to be sourced by bash.

passed=0
failed=0
skipped=0

finish() {
  if ((skipped > 0)); then
    echo "$skipped skipped, which is neither passed nor failed"
  fi
  echo "$passed passed, $failed failed"
  exit $((failed > 0))
}

# check NAME COMMAND...: one test.
check() {
  local name=$1
  shift
  echo "== $name"
  if "$@"; then
    passed=$((passed + 1))
    echo "== $name: passed"
  else
    failed=$((failed + 1))
    echo "== $name: FAILED"
  fi
}

# require NAME COMMAND...: what nothing goes on without.
require() {
  local name=$1
  shift
  echo "== $name"
  if ! "$@"; then
    failed=$((failed + 1))
    echo "== $name: FAILED"
    finish
  fi
}
