#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Makes a folder in which Debian's paraview-dev configures where VTK's Python package is installed,
# too: ParaView/prefix.sh, without arguments. paraview-dev needs files of python3-paraview, which
# conflicts with python3-vtk9. That package is unpacked here instead of installed, and links lead to
# the rest of the system. Prints the folder, ${XDG_CACHE_HOME:-~/.cache}/tetralux/paraview, whose
# usr/bin has pvpython, pvbatch and paraview. CMake finds it there.
set -euo pipefail

prefix="${XDG_CACHE_HOME:-$HOME/.cache}/tetralux/paraview"
version=$(dpkg-query --show --showformat='${Version}' paraview-dev)
if [[ "$(cat "$prefix/version" 2>/dev/null)" == "$version" ]]; then
  echo "$prefix"
  exit 0
fi

rm -rf "$prefix"
mkdir -p "$prefix/download"
(cd "$prefix/download" && apt-get -qq -o APT::Sandbox::User=root -o Acquire::Retries=3 \
  download "python3-paraview=$version") >&2
dpkg -x "$prefix"/download/python3-paraview_*.deb "$prefix/unpacked"
rm -r "$prefix/download"

arch=$(g++ -print-multiarch)
unpacked="$prefix/unpacked/usr"
usr="$prefix/usr"
mkdir -p "$usr/bin" "$usr/lib/$arch/cmake" "$usr/lib/python3"
ln -s /usr/include "$usr/include"
ln -s "$unpacked/lib/python3/dist-packages" "$usr/lib/python3/dist-packages"
find "/usr/lib/$arch" -mindepth 1 -maxdepth 1 ! -name cmake ! -name vtk \
  -exec ln -st "$usr/lib/$arch" {} +
# The hierarchy files that each build of a module reads, of ParaView's VTK instead of VTK's own.
ln -s "$unpacked/lib/$arch/vtk" "$usr/lib/$arch/vtk"
# Copied, since CMake resolves links and would look for all else beside what they lead to.
cp -a "/usr/lib/$arch"/cmake/paraview-* "$usr/lib/$arch/cmake/"
find /usr/bin "$unpacked/bin" -mindepth 1 -maxdepth 1 \
  \( -name 'pv*' -o -name 'vtk*' -o -name 'paraview*' -o -name 'smTest*' \) \
  -exec ln -sft "$usr/bin" {} +
echo "$version" >"$prefix/version"
echo "$prefix"
