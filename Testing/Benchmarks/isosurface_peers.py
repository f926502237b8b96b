#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Isosurfaces beside those of other libraries: frame times over the number of tetrahedra.

    TETRALUX_DATA=FOLDER python3 Testing/Benchmarks/isosurface_peers.py \
        [--program build/bin/IsosurfacePeers] [--output Documentation/bench]

Runs the program IsosurfacePeers, which is built where Embree 3 is found, on rings of 1e4 to 1e7
tetrahedra, and on the blunt fin if TETRALUX_DATA names its folder. Each run measures these cases
  same view     nothing changes from frame to frame
  new isovalue  each frame has another isovalue
  new step      each frame has other scalars
  shadows       nothing changes; one positional light casts shadows
  two layers    nothing changes; the surface is translucent
by these ways, which take turns frame by frame, each on the same number of threads
  isosurface mapper        rays of vtkTetrahedraIsosurfaceMapper
  isosurface mapper alone  the same without the window: until the picture is in memory
  ray caster               rays of vtkTetrahedraRayCastMapper; it has no shadows, and blends all
                           layers
  extraction + rasteriser  triangles of vtkContour3DLinearGrid that OpenGL draws
  extraction + Embree      the same triangles, traced by Embree: hierarchies of low and of medium
                           quality, and of low quality where VTK's scalar tree finds the cells
All others but Embree draw into a window without a display; the empty frame is the window's own part
of their time. Embree's picture stays in memory. A frame's time is the median.

Writes isosurface_peers.csv and the chart isosurface_peers.svg, which has the rings, and of Embree
the fastest setting of each case and mesh. Prints a table of all.
"""

import argparse
import csv
import io
import os
import subprocess

from benchmark_chart import BLACK, BLUE, GREEN, RED, Axis, Panel, write_chart
from benchmark_tables import make_table, write_csv

CASES = ("same view", "new isovalue", "new step", "shadows", "two layers")
# Names of ways, or how they begin: Embree has several settings.
# Colour, and whether the line is dashed: pictures that go into no window.
WAYS = {
    "isosurface mapper": (RED, False),
    "isosurface mapper alone": (RED, True),
    "ray caster": (GREEN, False),
    "extraction + rasteriser": (BLUE, False),
    "extraction + Embree": (BLACK, True),
}

SIZES = (1e4, 3e4, 1e5, 3e5, 1e6, 3e6, 1e7)
QUICK_SIZES = (1e4, 3e4)

# Of a ring: hexahedra around over those across, even ones; five tetrahedra each.
SLENDERNESS = 18.75
RING_VALUE = 0.5
RING_VIEW = ("--camera-position", "1.6,-2.1,4.6", "--camera-focal-point", "0,0,0")

BLUNT_FIN_VALUE = 1
BLUNT_FIN_VIEW = (
    "--camera-position", "30,25,35", "--camera-focal-point", "3.3,4.2,2.9",
    "--camera-view-angle", "20",
)
PANELS_IN_A_ROW = 3


def list_meshes(sizes):
    """Names, and of each what the program is told."""
    meshes = {}
    for size in sizes:
        across = max(1, round((size / 5 / SLENDERNESS) ** (1 / 3)))
        around = 2 * round(size / 5 / across**2 / 2)
        shape = f"ring:around={around},across={across}"
        meshes[f"ring {size:.0e}"] = [shape, "--isovalue", str(RING_VALUE), *RING_VIEW]
    folder = os.environ.get("TETRALUX_DATA")
    if folder:
        files = ",".join(os.path.join(folder, f"bluntfin{part}.bin") for part in ("xyz", "q"))
        value = ("--array", "Density", "--isovalue", str(BLUNT_FIN_VALUE))
        meshes["blunt fin"] = [files, *value, *BLUNT_FIN_VIEW]
    return meshes


def measure(options, name, arguments):
    """Rows of a mesh, one for each case and way."""
    size = f"{options.size},{options.size}"
    command = [options.program, *arguments, "--size", size, "--threads", str(options.threads),
               "--frames", str(options.frames)]
    output = subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout
    return [{**row, "mesh": name} for row in csv.DictReader(io.StringIO(output))]


def find_fastest(rows, case, way):
    """Seconds of the fastest setting of a way on each number of tetrahedra."""
    seconds = {}
    for row in rows:
        if row["case"] == case and (row["way"] == way or row["way"].startswith(way + ",")):
            cells = int(row["tetrahedra"])
            seconds[cells] = min(seconds.get(cells, float("inf")), float(row["seconds"]))
    return seconds


def make_chart(path, rows, options):
    cells = [int(row["tetrahedra"]) for row in rows]
    lines = {(case, way): find_fastest(rows, case, way) for case in CASES for way in WAYS}
    milliseconds = [1000 * seconds for line in lines.values() for seconds in line.values()]
    x = Axis("thousands of tetrahedra", min(cells) / 1000, round(max(cells), -6) / 1000, base=10)
    y = Axis("time of a frame, ms", min(milliseconds), max(milliseconds), base=10)
    panels = []
    for case in CASES:
        panel = Panel(case, x, y)
        for way, style in WAYS.items():
            points = [(n / 1000, 1000 * s) for n, s in sorted(lines[case, way].items())]
            if points:
                panel.add_line(points, *style)
        panels.append(panel)
    rows_of_panels = [
        panels[k : k + PANELS_IN_A_ROW] for k in range(0, len(panels), PANELS_IN_A_ROW)
    ]
    drawn = {way for (_, way), line in lines.items() if line}
    legend = [
        (way.replace("isosurface mapper alone", "in memory"), *style)
        for way, style in WAYS.items()
        if way in drawn
    ]
    title = f"Isosurfaces of a ring, {options.size} x {options.size}, {options.threads} threads"
    write_chart(path, title, rows_of_panels, legend)


def format_table(rows):
    """Milliseconds of each mesh and way, one column a case."""
    milliseconds = {}
    for row in rows:
        cases = milliseconds.setdefault((row["mesh"], row["tetrahedra"], row["way"]), {})
        cases[row["case"]] = f"{1000 * float(row['seconds']):.1f}"
    return make_table(
        ["mesh", "tetrahedra", "way", *CASES],
        [
            [mesh, f"{int(cells):,}", way, *(cases.get(case, "") for case in CASES)]
            for (mesh, cells, way), cases in milliseconds.items()
        ],
    )


def parse_arguments():
    parser = argparse.ArgumentParser(
        description=__doc__.split("\n", 1)[0], formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--output", default="Documentation/bench", help="folder of chart and .csv")
    parser.add_argument("--program", default="build/bin/IsosurfacePeers")
    parser.add_argument("--size", type=int, default=1024, help="pixels along an edge (1024)")
    parser.add_argument("--threads", type=int, default=2, help="of each way (2)")
    parser.add_argument("--frames", type=int, default=9, help="frames timed of each (9)")
    parser.add_argument("--quick", action="store_true", help="small, to see that all works")
    return parser.parse_args()


def main():
    options = parse_arguments()
    rows = []
    for name, arguments in list_meshes(QUICK_SIZES if options.quick else SIZES).items():
        print(name, flush=True)
        rows += measure(options, name, arguments)
    write_csv(os.path.join(options.output, "isosurface_peers.csv"), rows)
    rings = [row for row in rows if row["mesh"].startswith("ring")]
    make_chart(os.path.join(options.output, "isosurface_peers.svg"), rings, options)
    print(format_table(rows))


if __name__ == "__main__":
    main()
