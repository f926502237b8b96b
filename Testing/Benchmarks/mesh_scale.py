#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What the ray caster's preparation and frames take as a mesh grows and the picture stays.

    PYTHONPATH=build/lib/python3.11/dist-packages \\
        python3 Testing/Benchmarks/mesh_scale.py [--tetrahedra 1e5,1e6,1e7] [--size 512]
            [--frames 5] [--output scale.csv]

A cube with the same field, of so many tetrahedra, each in a process of its own. Columns:
  intake, order, neighbors  nanoseconds a tetrahedron of stages of the first frame, processor time
                   of all threads; they end where progress is reported. "intake" includes cleaning
  mesh of clock    nanoseconds a tetrahedron of all of the mesh, by the clock
  processor of first  the same of the whole first frame, by all threads
  peak, kept       bytes a tetrahedron that the process held more at most and behind the first
                   frame, without the input
  silence          longest time without a report of progress, seconds
  first, next      the first frame and the median of others from new places, milliseconds by the
                   clock; "processor" of the others, by all threads
  segments         cells that a frame's rays go through, millions
Linux only: memory is that of /proc/self/status.
"""

import argparse
import ctypes
import json
import math
import statistics
import subprocess
import sys
import time

import tetralux
from benchmark_meshes import make_cube
from benchmark_scene import VolumeWindow, get_statistics, make_property
from benchmark_tables import make_table, write_csv
from memory import read_status
from vtkmodules.util.misc import calldata_type
from vtkmodules.util.vtkConstants import VTK_DOUBLE

NODES = ((-2, 0, 0, 1, 0.1), (0, 0, 1, 0, 0.5), (2, 1, 0, 0, 0.2))

# Shares of progress where stages end: ScenePreparation.cxx, WalkMesh.cxx.
STAGES = {"intake": 0.28, "order": 0.6, "neighbors": 0.96}


class ProgressTimes:
    """When a mapper reported which progress of its mesh: clock, and processor time."""

    def __init__(self, mapper):
        self.times = []

        @calldata_type(VTK_DOUBLE)
        def note(_caller, _event, share):
            self.times.append((share, time.perf_counter(), time.process_time()))

        mapper.AddObserver("ProgressEvent", note)  # of the mesh
        mapper.AddObserver("VolumeMapperRenderProgressEvent", note)  # of the picture

    def start(self):
        self.times = [(0, time.perf_counter(), time.process_time())]

    def get_stages(self):
        """Processor seconds of each stage."""
        seconds = {}
        before = self.times[0]
        for name, share in STAGES.items():
            end = next(entry for entry in self.times if abs(entry[0] - share) < 1e-6)
            seconds[name] = end[2] - before[2]
            before = end
        return seconds

    def get_longest_silence(self):
        return max(b[1] - a[1] for a, b in zip(self.times, self.times[1:]))


def look(scene, turn):
    angle = 0.9 + 0.05 * turn
    scene.look((0.5 + 2.6 * math.sin(angle), 1.6, 0.5 + 2.6 * math.cos(angle)), (0.5, 0.5, 0.5))


def measure(tetrahedra, size, frames):
    """Prints what the frames of one mesh take, as JSON."""
    grid = make_cube(tetrahedra)
    mapper = tetralux.vtkTetrahedraRayCastMapper()
    mapper.SetAutoAdjustSampleDistances(False)
    # A frame of six cells first: OpenGL and threads are there then.
    mapper.SetInputData(make_cube(6))
    scene = VolumeWindow(mapper, make_property(NODES, 0.3), size, size)
    look(scene, 0)
    scene.window.Render()
    mapper.SetInputData(grid)
    ctypes.CDLL(None).malloc_trim(0)  # what making the cube left behind
    progress = ProgressTimes(mapper)
    before = read_status("VmRSS")
    with open("/proc/self/clear_refs", "w", encoding="utf-8") as reset:
        reset.write("5")  # the peak begins here
    progress.start()
    scene.window.Render()
    scene.window.WaitForCompletion()
    first = time.perf_counter() - progress.times[0][1]
    processor_of_first = time.process_time() - progress.times[0][2]
    cells = grid.GetNumberOfCells()
    parts = get_statistics(scene)["seconds"]
    row = {"tetrahedra": cells}
    row |= {name: 1e9 * seconds / cells for name, seconds in progress.get_stages().items()}
    row["mesh of clock"] = 1e9 * (parts["intake"] + parts["mesh"]) / cells
    row["processor of first"] = 1e9 * processor_of_first / cells
    row["peak"] = (read_status("VmHWM") - before) / cells
    row["kept"] = (read_status("VmRSS") - before) / cells
    row["silence"] = progress.get_longest_silence()
    row["first"] = 1e3 * first
    clock, processor = [], []
    for turn in range(1, frames + 1):
        look(scene, turn)
        used, begin = time.process_time(), time.perf_counter()
        scene.window.Render()
        scene.window.WaitForCompletion()
        clock.append(time.perf_counter() - begin)
        processor.append(time.process_time() - used)
    row["next"] = 1e3 * statistics.median(clock)
    row["processor"] = 1e3 * statistics.median(processor)
    row["segments"] = get_statistics(scene)["rays"]["segments"] / 1e6
    print(json.dumps(row))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--tetrahedra", default="1e5,1e6,1e7", help="sizes (1e5,1e6,1e7)")
    parser.add_argument("--size", type=int, default=512, help="pixels along an edge (512)")
    parser.add_argument("--frames", type=int, default=5, help="frames behind the first (5)")
    parser.add_argument("--output", help="a .csv for the table")
    parser.add_argument("--measure", action="store_true", help=argparse.SUPPRESS)
    options = parser.parse_args()
    sizes = [float(size) for size in options.tetrahedra.split(",")]
    if options.measure:
        measure(sizes[0], options.size, options.frames)
        return
    rows = []
    for size in sizes:
        command = [sys.executable, __file__, "--measure", "--tetrahedra", str(size)]
        command += ["--size", str(options.size), "--frames", str(options.frames)]
        output = subprocess.run(command, check=True, capture_output=True, text=True).stdout
        rows.append(json.loads(output.splitlines()[-1]))
        print(rows[-1], flush=True)
    table = [[f"{value:.3g}" for value in row.values()] for row in rows]
    print(make_table(list(rows[0]), table))
    if options.output:
        write_csv(options.output, rows)


if __name__ == "__main__":
    main()
