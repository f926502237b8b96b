#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What ray casting on the graphics card takes: frames, cell steps, bytes, uploads.

    TETRALUX_DATA=FOLDER PYTHONPATH=build/lib/python3.11/dist-packages \
        python3 Testing/Benchmarks/gpu_ray_cast.py --output FOLDER [--sizes 512,1024,2048] \
        [--large] [--parts views] [--documentation Documentation]

Runs on the OpenGL that the window without a display finds: a graphics card, or else software.
Prints its name and writes into FOLDER gpu_ray_cast.md, and as .csv
  frames     best frame of each mesh, size and way of re-entry; cell steps and tetrahedra a second,
             bytes a tetrahedron, time to upload, and the largest difference from the picture of the
             mapper on the processor, of any channel
  views      time and cell steps of each view of a mesh that turns about two axes, 512 x 512; the
             chart views.svg is figure 7 of Weiler et al. 2003, for all meshes
  table2     its table 2 beside the same meshes, or those most like them, here: least, mean and
             largest over the views
  figure8    its figure 8: rays that take part in each pass on the heat sink, without the depth test
             that keeps done rays out, with it, and with early ray termination, too
The blunt fin takes part if TETRALUX_DATA names the folder with bluntfinxyz.bin. The command-line
tool (--tool) makes the other meshes. --large: also a mesh of ten million tetrahedra. --parts: a
list of frames, views and figure8, which are measured. --documentation: its Benchmarks.md takes
table 2 and its folder bench the views, as gpu_views.csv and gpu_views.svg.
"""

import argparse
import os
import shutil
import sys

import numpy
import tetralux
from benchmark_chart import BLUE, RED, Axis, Panel, write_chart
from benchmark_meshes import generate, make_lattice, read_blunt_fin, split_by_vtk
from benchmark_scene import VolumeWindow, get_statistics, make_property, time_render
from benchmark_tables import make_table, replace_table, write_csv

REENTRY = {"boundary hierarchy": 1, "imaginary cells": 2, "boundary layers": 3}

# Cells, of these imaginary ones, frames a second on a Radeon 9700 Pro.
TABLE_2 = {
    "blunt fin": (190852, 3534, 3.37),
    "heat sink": (124152, 2484, 2.27),
    "cylinder": (203460, 1860, 1.94),
    "sphere": (148955, 0, 5.13),
}

# What is made instead of the paper's data, about as large.
GENERATED = {
    "heat sink": ("heat-sink", ["--cells", "3"]),
    "cylinder": ("cylinder-with-hole", ["--across", "7", "--around", "100"]),
    "sphere": ("ball", ["--cells", "38"]),
    "ring": ("ring", []),
}

# Some opacity everywhere: shares of the scalar range, colours, opacities.
NODES = (
    (0, 0.1, 0.2, 0.9, 0.1),
    (0.3, 0, 0.8, 0.9, 0.6),
    (0.55, 0.2, 0.9, 0.2, 1),
    (0.8, 0.9, 0.8, 0.1, 2),
    (1, 0.9, 0.1, 0.1, 5),
)

PARTS = ("frames", "views", "figure8")
MARKER = "<!-- gpu_ray_cast.py: table 2 -->"
FIGURE_8_STEPS = 8  # a pass; the paper has 1


class Scene(VolumeWindow):
    """A mesh seen as a whole."""

    def __init__(self, data, mapper, size):
        lower, upper = data.GetPointData().GetScalars().GetRange(0)
        nodes = [(lower + share * (upper - lower), *node) for share, *node in NODES]
        mapper.SetInputData(data)
        super().__init__(mapper, make_property(nodes, data.GetLength() / 4), size, size)
        self.camera.SetPosition(1, 0.6, 1.8)
        self.camera.SetFocalPoint(0, 0, 0)
        self.renderer.ResetCamera()
        self.camera.Zoom(1.3)

    def get_colors(self):
        return tetralux.picture(self.mapper)[0]


def measure_frames(name, data, sizes, frames, renderer_name):
    rows = []
    for size in sizes:
        processor = Scene(data, tetralux.vtkTetrahedraRayCastMapper(), size)
        processor.mapper.AutoAdjustSampleDistancesOff()
        time_render(processor)
        processor_seconds = min(time_render(processor) for _ in range(frames))
        expected = processor.get_colors()
        for reentry, mode in REENTRY.items():
            mapper = tetralux.vtkTetrahedraGPURayCastMapper()
            mapper.SetReentry(mode)
            scene = Scene(data, mapper, size)
            time_render(scene)
            first = get_statistics(scene)
            mapper.CountFragmentsOn()
            time_render(scene)
            counted = get_statistics(scene)
            mapper.CountFragmentsOff()
            seconds = min(time_render(scene) for _ in range(frames))
            tetrahedra = first["tables"]["tetrahedra"]
            card = first["graphics_card"]
            rows.append(
                {
                    "renderer": renderer_name,
                    "mesh": name,
                    "size": size,
                    "reentry": counted["rays"]["reentry"],
                    "tetrahedra": tetrahedra,
                    "points": first["tables"]["points"],
                    "seconds": seconds,
                    "processor_seconds": processor_seconds,
                    "passes": counted["rays"]["passes"],
                    "cell_steps": counted["rays"]["segments"],
                    "cell_steps_per_second": counted["rays"]["segments"] / seconds,
                    "tetrahedra_per_second": tetrahedra / seconds,
                    "bytes_per_tetrahedron": card["mesh_bytes"] / tetrahedra,
                    "upload_bytes": card["uploaded_bytes"],
                    "upload_seconds": first["seconds"]["upload"],
                    "largest_difference": float(abs(scene.get_colors() - expected).max()),
                }
            )
            print("{mesh} {size} {reentry}: {seconds:.4f} s".format(**rows[-1]), flush=True)
            if counted["rays"]["reentry"] == "none":
                break  # a convex mesh
    return rows


def measure_views(meshes, views, frames):
    rows = []
    for name in [name for name in TABLE_2 if name in meshes]:
        mapper = tetralux.vtkTetrahedraGPURayCastMapper()
        mapper.SetReentryToImaginaryCells()
        scene = Scene(meshes[name], mapper, 512)
        time_render(scene)
        for view in range(views):
            # Both axes at once, at different speeds.
            scene.volume.RotateX(360 / views)
            scene.volume.RotateY(2 * 360 / views)
            scene.renderer.ResetCameraClippingRange()
            seconds = float(numpy.median([time_render(scene) for _ in range(frames)]))
            mapper.CountFragmentsOn()  # which takes time
            time_render(scene)
            mapper.CountFragmentsOff()
            statistics = get_statistics(scene)
            rows.append(
                {
                    "mesh": name,
                    "view": view,
                    "cells": statistics["tables"]["tetrahedra"],
                    "imaginary": statistics["tables"].get("imaginary_cells", 0),
                    "seconds": seconds,
                    "cell_steps": statistics["rays"]["segments"],
                }
            )
            print("view {view} of {mesh}: {seconds:.4f} s".format(**rows[-1]), flush=True)
    return rows


def summarize_views(rows):
    """Table 2."""
    summary = []
    for name in dict.fromkeys(row["mesh"] for row in rows):
        cells, imaginary, paper_rate = TABLE_2[name]
        own = [row for row in rows if row["mesh"] == name]
        seconds = numpy.array([row["seconds"] for row in own])
        steps = numpy.array([row["cell_steps"] for row in own], float)
        own_cells = own[0]["cells"] + own[0]["imaginary"]
        summary.append(
            {
                "mesh": name,
                "paper_cells": cells,
                "paper_imaginary": imaginary,
                "paper_frames_per_second": paper_rate,
                "paper_tetrahedra_per_second": cells * paper_rate,
                "cells": own_cells,
                "imaginary": own[0]["imaginary"],
                "least_seconds": seconds.min(),
                "mean_seconds": seconds.mean(),
                "largest_seconds": seconds.max(),
                "frames_per_second": 1 / seconds.mean(),
                "tetrahedra_per_second": own_cells / seconds.mean(),
                "least_steps": steps.min(),
                "mean_steps": steps.mean(),
                "largest_steps": steps.max(),
                "correlation": numpy.corrcoef(seconds, steps)[0, 1],
            }
        )
    return summary


def draw_views(path, rows, renderer_name):
    """Figure 7: time of a frame and cell steps over the view."""
    panels = []
    for name in dict.fromkeys(row["mesh"] for row in rows):
        own = [row for row in rows if row["mesh"] == name]
        x = Axis("view", 0, len(own))
        milliseconds = [1000 * row["seconds"] for row in own]
        millions = [row["cell_steps"] / 1e6 for row in own]
        left = Axis("time of a frame, ms", 0, max(milliseconds), color=BLUE)
        right = Axis("million cell steps", 0, max(millions), color=RED)
        panel = Panel(f"{name}, {own[0]['cells']:,} cells", x, left, right)
        panel.add_line(list(enumerate(milliseconds)), BLUE)
        panel.add_line(list(enumerate(millions)), RED, right=True, dashed=True)
        panels.append([panel])
    write_chart(
        path,
        f"Frame time over the view, 512 x 512: {renderer_name}",
        panels,
        [("time of a frame", BLUE, False), ("cell steps", RED, True)],
        panel_width=640,
    )


def measure_figure_8(data):
    series = {}
    for name, error in (("depth test", 0), ("depth test and early termination", 0.02)):
        mapper = tetralux.vtkTetrahedraGPURayCastMapper()
        mapper.SetReentryToImaginaryCells()
        mapper.SetMaximumError(error)
        mapper.SetStepsPerPass(FIGURE_8_STEPS)
        mapper.CountFragmentsOn()
        scene = Scene(data, mapper, 512)
        scene.volume.GetProperty().SetScalarOpacityUnitDistance(data.GetLength() / 200)
        time_render(scene)
        series[name] = get_statistics(scene)["rays"]["fragments_per_pass"]
    all_passes = series["depth test"]
    series["neither"] = [all_passes[0]] * len(all_passes)
    names = ["neither", "depth test", "depth test and early termination"]
    return [
        {"pass": k, **{name: series[name][k] if k < len(series[name]) else 0 for name in names}}
        for k in range(len(all_passes))
    ]


def format_frames(frames):
    return make_table(
        ["mesh", "tetrahedra", "pixels", "re-entry", "frame, ms", "on the processor, ms", "passes",
         "million cell steps a second", "bytes a tetrahedron", "upload, ms",
         "largest difference"],
        [
            [r["mesh"], f"{r['tetrahedra']:,}", str(r["size"]), r["reentry"],
             f"{1000 * r['seconds']:.1f}", f"{1000 * r['processor_seconds']:.1f}",
             str(r["passes"]), f"{r['cell_steps_per_second'] / 1e6:.1f}",
             f"{r['bytes_per_tetrahedron']:.1f}", f"{1000 * r['upload_seconds']:.1f}",
             f"{r['largest_difference']:.1e}"]
            for r in frames
        ],
    )


def format_table_2(table_2):
    def format_range(row, name, scale, digits):
        values = [scale * row[f"{part}_{name}"] for part in ("least", "mean", "largest")]
        return " / ".join(f"{value:.{digits}f}" for value in values)

    return make_table(
        ["mesh", "cells there", "frames/s", "tetrahedra/s", "cells here, of these imaginary",
         "frames/s", "tetrahedra/s", "frame, ms: least / mean / largest", "million steps",
         "correlation"],
        [
            [r["mesh"], f"{r['paper_cells']:,}", f"{r['paper_frames_per_second']:.2f}",
             f"{r['paper_tetrahedra_per_second'] / 1e3:.0f} K",
             f"{r['cells']:,}, {r['imaginary']:,}", f"{r['frames_per_second']:.2f}",
             f"{r['tetrahedra_per_second'] / 1e3:.0f} K", format_range(r, "seconds", 1e3, 0),
             format_range(r, "steps", 1e-6, 1), f"{r['correlation']:.2f}"]
            for r in table_2
        ],
    )


def format_figure_8(figure_8):
    names = list(figure_8[0])
    table = make_table(names, [[str(row[name]) for name in names] for row in figure_8])
    sums = [f"{name} {sum(row[name] for row in figure_8):,}" for name in names[1:]]
    return table + "\nIn all: " + ", ".join(sums) + "\n"


def main():
    parser = argparse.ArgumentParser(
        description=__doc__.split("\n", 1)[0], formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--output", required=True, help="folder of the tables")
    parser.add_argument("--sizes", default="512,1024,2048", help="pixels along an edge")
    parser.add_argument(
        "--frames", type=int, default=5, help="of each: the best, or of views the median (5)"
    )
    parser.add_argument("--views", type=int, default=36, help="of each mesh in table 2 (36)")
    parser.add_argument("--parts", default=",".join(PARTS), help="a list of " + ", ".join(PARTS))
    parser.add_argument("--documentation", help="folder of Benchmarks.md, which takes the views")
    parser.add_argument("--large", action="store_true", help="also ten million tetrahedra")
    parser.add_argument("--tool", default=shutil.which("tetralux") or "build/bin/tetralux")
    arguments = parser.parse_args()
    parts = arguments.parts.split(",")
    if not set(parts) <= set(PARTS):
        sys.exit("gpu_ray_cast.py: --parts takes a list of " + ", ".join(PARTS))
    sizes = [int(size) for size in arguments.sizes.split(",")]
    os.makedirs(arguments.output, exist_ok=True)

    meshes = {}
    fin = read_blunt_fin()
    if fin:
        meshes["blunt fin"] = split_by_vtk(fin)  # into five of a cell, as the paper
    for name, (generator, parameters) in GENERATED.items():
        meshes[name] = generate(arguments.tool, generator, *parameters)

    probe = Scene(meshes["sphere"], tetralux.vtkTetrahedraGPURayCastMapper(), 64)
    time_render(probe)
    if "graphics_card" not in get_statistics(probe):
        sys.exit("gpu_ray_cast.py: this OpenGL can't cast rays, see the error above")
    renderer_name = get_statistics(probe)["graphics_card"]["renderer"]
    print(renderer_name, flush=True)

    text = [f"# Ray casting by OpenGL: {renderer_name}\n"]

    def write_rows(name, rows):
        write_csv(os.path.join(arguments.output, name + ".csv"), rows)

    if "frames" in parts:
        measured = {name: meshes[name] for name in ("blunt fin", "ring") if name in meshes}
        measured["lattice, 1e6"] = make_lattice(1e6)
        if arguments.large:
            measured["lattice, 1e7"] = make_lattice(1e7)
        frames = []
        for name, data in measured.items():
            frames += measure_frames(name, data, sizes, arguments.frames, renderer_name)
            write_rows("frames", frames)
        text.append(format_frames(frames))
    if "views" in parts:
        views = measure_views(meshes, arguments.views, arguments.frames)
        table_2 = summarize_views(views)
        write_rows("views", views)
        write_rows("table2", table_2)
        draw_views(os.path.join(arguments.output, "views.svg"), views, renderer_name)
        text += ["## Table 2 of Weiler et al. 2003\n", format_table_2(table_2)]
        if arguments.documentation:
            kept = os.path.join(arguments.documentation, "bench", "gpu_views")
            write_csv(kept + ".csv", views)
            draw_views(kept + ".svg", views, renderer_name)
            page = os.path.join(arguments.documentation, "Benchmarks.md")
            replace_table(page, MARKER, format_table_2(table_2))
    if "figure8" in parts:
        figure_8 = measure_figure_8(meshes["heat sink"])
        write_rows("figure8", figure_8)
        text += [f"## Figure 8: rays in each pass of {FIGURE_8_STEPS} cells\n",
                 format_figure_8(figure_8)]
    with open(os.path.join(arguments.output, "gpu_ray_cast.md"), "w", encoding="utf-8") as page:
        page.write("\n".join(text))


if __name__ == "__main__":
    main()
