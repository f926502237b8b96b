#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs what is missing from the distribution's packages (Debian 12 or later, and what derives
# from it): Examples/setup.sh [test] [neon] [paraview]. With "test", also what the tests need; with
# "neon", a compiler for 64-bit ARM and an emulator; with "paraview", what the plugin needs.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

packages=(
  cmake g++ ninja-build
  libvtk9-dev python3-vtk9 # VTK and its Python package
  libcgal-dev # triangulations, with exact signs
  libegl-dev libegl1 libegl-mesa0 libgl1-mesa-dri # rendering without a display
  nlohmann-json3-dev # statistics
  libcli11-dev # the command-line tool
)
want_paraview=false
for wish in "$@"; do
  case "$wish" in
    test)
      packages+=(libgtest-dev libbenchmark-dev libboost-dev python3-numpy python3-h5py
        clang-format clang-tidy xvfb xauth) # windows without a screen
      ;;
    neon)
      packages+=(g++-aarch64-linux-gnu libc6-dev-arm64-cross qemu-user)
      ;;
    paraview)
      want_paraview=true
      packages+=(paraview-dev
        # what ParaView's CMake package looks for, without depending on it
        libdouble-conversion-dev libfreetype-dev libglew-dev liblz4-dev libopenmpi-dev
        libqt5svg5-dev libtiff-dev openmpi-bin python3-dev qttools5-dev
        xvfb xauth) # its pvpython and pvbatch need a display
      ;;
    *)
      echo "usage: setup.sh [test] [neon] [paraview]" >&2
      exit 2
      ;;
  esac
done

# Beside VTK's Python package there is no room for ParaView's: it is unpacked.
set_paraview_up() {
  if $want_paraview; then
    echo "setup: ParaView is in $(ParaView/prefix.sh)"
  fi
}

if ! command -v dpkg-query >/dev/null; then
  echo "setup: no dpkg-query here; make sure that what these Debian packages hold is installed:" \
    "${packages[*]}" >&2
  exit 0
fi

missing=()
for package in "${packages[@]}"; do
  status=$(dpkg-query --show --showformat='${db:Status-Status}' "$package" 2>/dev/null || true)
  if [[ "$status" != *installed* || "$status" == *not-installed* ]]; then
    missing+=("$package")
  fi
done
if ((${#missing[@]} == 0)); then
  set_paraview_up
  exit 0
fi

as_root=()
if ((EUID != 0)); then
  if ! command -v sudo >/dev/null; then
    echo "setup: missing packages, and no sudo to install them; as root run:" \
      "apt-get install --no-install-recommends ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
  echo "setup: sudo is asked for to install packages"
fi
echo "setup: installing ${missing[*]} (up to 0.5 GB to download)"
"${as_root[@]}" apt-get -qq update
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -qq -o Acquire::Retries=3 \
  install --yes --no-install-recommends --no-remove "${missing[@]}" </dev/null >/dev/null
set_paraview_up
