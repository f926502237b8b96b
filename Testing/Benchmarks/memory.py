#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What the first frame of each mapper takes and keeps of memory, in bytes for each tetrahedron.

    PYTHONPATH=build/lib/python3.11/dist-packages \\
        python3 Testing/Benchmarks/memory.py [--tetrahedra 1e6,5e6] [--output memory.csv]

Each mapper draws one frame of 256 x 256 of a cube in a process of its own. Columns:
  peak     the largest memory of the process during the frame, without what it held before
  kept     what the process holds behind the frame, without what it held before
  named    what GetStatistics names as kept: the sum of its section "memory"
Textures of software OpenGL are in the memory of the process, those of a graphics card are not.
Linux only: the numbers are those of /proc/self/status.
"""

import argparse
import ctypes
import json
import subprocess
import sys

import tetralux
from benchmark_meshes import make_cube
from benchmark_scene import VolumeWindow, get_statistics, make_property
from benchmark_tables import make_table, write_csv

MAPPERS = {
    "ray caster": tetralux.vtkTetrahedraRayCastMapper,
    "graphics card's ray caster": tetralux.vtkTetrahedraGPURayCastMapper,
    "projection": tetralux.vtkTetrahedraProjectionMapper,
    "isosurfaces": tetralux.vtkTetrahedraIsosurfaceMapper,
}
NODES = ((-2, 0, 0, 1, 0.1), (0, 0, 1, 0, 0.5), (2, 1, 0, 0, 0.2))


def read_status(name):
    """A number of bytes of this process."""
    with open("/proc/self/status", encoding="utf-8") as status:
        for line in status:
            if line.startswith(name + ":"):
                return 1024 * int(line.split()[1])
    raise KeyError(name)


def measure(mapper_name, tetrahedra):
    """Prints what one frame takes, as JSON."""
    grid = make_cube(tetrahedra)
    # A frame without cells first: what OpenGL itself takes is not the mesh's.
    mapper = MAPPERS[mapper_name]()
    mapper.SetInputData(make_cube(6))
    scene = VolumeWindow(mapper, make_property(NODES, 0.3), 256, 256)
    scene.volume.GetProperty().GetIsoSurfaceValues().SetValue(0, 0.3)
    scene.look((2, 1.6, 2.4), (0.5, 0.5, 0.5))
    scene.window.Render()
    mapper.SetInputData(grid)
    ctypes.CDLL(None).malloc_trim(0)  # what making the cube left behind
    before = read_status("VmRSS")
    with open("/proc/self/clear_refs", "w", encoding="utf-8") as reset:
        reset.write("5")  # the peak begins here
    scene.window.Render()
    scene.window.WaitForCompletion()
    cells = grid.GetNumberOfCells()
    statistics = get_statistics(scene)
    row = {
        "mapper": mapper_name,
        "tetrahedra": cells,
        "peak": (read_status("VmHWM") - before) / cells,
        "kept": (read_status("VmRSS") - before) / cells,
        "parts": {
            name: value / cells
            for name, value in statistics["memory"].items()
        },
    }
    print(json.dumps(row))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--tetrahedra", default="1e6,5e6", help="sizes of the cube (1e6,5e6)")
    parser.add_argument("--output", help="a .csv for the table")
    parser.add_argument("--measure", help=argparse.SUPPRESS)
    options = parser.parse_args()
    sizes = [float(size) for size in options.tetrahedra.split(",")]
    if options.measure:
        measure(options.measure, sizes[0])
        return
    rows = []
    for size in sizes:
        for name in MAPPERS:
            command = [sys.executable, __file__, "--measure", name, "--tetrahedra", str(size)]
            run = subprocess.run(command, check=True, capture_output=True, text=True)
            row = json.loads(run.stdout.splitlines()[-1])
            print(json.dumps(row), flush=True)
            rows.append(row)
    table = [
        {
            "mapper": row["mapper"],
            "tetrahedra": f"{row['tetrahedra']:,}",
            "peak": f"{row['peak']:.0f}",
            "kept": f"{row['kept']:.0f}",
            "named": f"{sum(row['parts'].values()):.0f}",
        }
        for row in rows
    ]
    print(make_table(list(table[0]), [row.values() for row in table]))
    if options.output:
        write_csv(options.output, table)


if __name__ == "__main__":
    main()
