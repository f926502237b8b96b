#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Tests of the plugin for ParaView, from a fresh machine: installs what is missing, builds the tool
# and the plugin, installs the plugin, moves the plugin's build tree away, and compares ParaView's
# pictures with the tool's. The plugin has the objects of Core that the tool has.
# TETRALUX_DATA: the folder with the data sets, without which nothing can be compared.
# Ends with "N passed, N failed"; the exit status is 0 where none failed.
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.." || exit 1

source Testing/steps.sh

export TETRALUX_PARAVIEW_FOLDER="$PWD/build-paraview-tests"
prefix="$TETRALUX_PARAVIEW_FOLDER/prefix"
export PYTHONPATH="$PWD/Testing/ParaView" PYTHONDONTWRITEBYTECODE=1
# Processes of a parallel run share few cores, and may be the superuser's in a container.
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMP_WAIT_POLICY=passive

# At the end, whatever it is: nothing that was started or moved is left so.
display_process=
restore() {
  if [[ -n "$display_process" ]]; then
    kill "$display_process"
  fi
  if [[ -d "$TETRALUX_PARAVIEW_FOLDER/moved" ]]; then
    mv "$TETRALUX_PARAVIEW_FOLDER/moved" build-paraview
  fi
}
trap restore EXIT

# timed COMMAND...: and how long it took.
timed() {
  local start=$SECONDS status
  "$@"
  status=$?
  echo "$((SECONDS - start)) s"
  return $status
}

# in_paraview PROCESSES SCRIPT ARGUMENTS...: by pvbatch.
in_paraview() {
  local processes=$1
  shift
  mpirun --oversubscribe -np "$processes" "$paraview/usr/bin/pvbatch" "$@"
}

# A display without a screen, with the first number that is free. It must not start anew when its
# last client leaves: the next one would be turned away.
start_display() {
  local number
  exec {number}< <(exec Xvfb -displayfd 1 -screen 0 1280x1024x24 -nolisten tcp -noreset 2>/dev/null)
  display_process=$!
  read -r -t 60 -u "$number" DISPLAY || return 1
  export DISPLAY=":$DISPLAY"
}

# A server and its client.
check_server() {
  local port status
  port=$("$python" -c 'import socket
free = socket.socket()
free.bind(("", 0))
print(free.getsockname()[1])')
  local log="$TETRALUX_PARAVIEW_FOLDER/server.log"
  "$paraview/usr/bin/pvserver" --server-port="$port" >"$log" &
  local server=$!
  for _ in {1..120}; do
    grep -q "Accepting connection" "$log" && break
    sleep 0.5
  done
  timeout 300 "$paraview/usr/bin/pvpython" Testing/ParaView/TestServer.py "$port"
  status=$?
  kill "$server" 2>/dev/null
  return $status
}

if [[ -z "${TETRALUX_DATA:-}" ]]; then
  echo "test_paraview.sh: TETRALUX_DATA must name the folder of the data sets" >&2
  exit 1
fi
require "setup" timed Examples/setup.sh test paraview
paraview=$(ParaView/prefix.sh) || exit 1
require "configure the tool" cmake --preset release
require "build the tool" timed cmake --build --preset release --target tetralux
require "configure the plugin" cmake --preset paraview -DTETRALUX_WARNINGS_AS_ERRORS=ON \
  -DTETRALUX_CORE_OBJECTS="$PWD/build/Module/CMakeFiles/Core.dir"
require "build the plugin" timed cmake --build --preset paraview
rm -rf "$TETRALUX_PARAVIEW_FOLDER"
require "install the plugin" cmake --install build-paraview --prefix "$prefix"
require "move the build tree away" mv build-paraview "$TETRALUX_PARAVIEW_FOLDER/moved"
TETRALUX_PLUGIN=$(find "$prefix" -name Tetralux.so)
export TETRALUX_PLUGIN

# The interpreter that VTK was wrapped for, which need not come first.
python=$(PATH="/usr/bin:$PATH" type -P python3)
require "display" start_display
require "pictures of the tool" timed "$python" Testing/ParaView/prepare.py \
  build/bin/tetralux "$TETRALUX_DATA" "$TETRALUX_PARAVIEW_FOLDER"
check "representations" timed in_paraview 1 Testing/ParaView/TestRepresentations.py
check "colours" timed in_paraview 1 Testing/ParaView/TestColors.py
check "what is rebuilt" timed in_paraview 1 Testing/ParaView/TestRebuilt.py
check "server" timed check_server
check "menus" timed in_paraview 1 Testing/ParaView/TestMenus.py
check "example" timed in_paraview 1 Testing/ParaView/TestExample.py
require "pictures of one process" timed in_paraview 1 Testing/ParaView/TestParallel.py reference
for processes in 2 3; do
  check "$processes processes" timed in_paraview "$processes" \
    Testing/ParaView/TestParallel.py compare
done
finish
