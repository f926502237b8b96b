#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What ray casting on the graphics card takes: frames, cell steps, bytes, uploads.

    TETRALUX_DATA=FOLDER PYTHONPATH=build/lib/python3.11/dist-packages \
        python3 Testing/Benchmarks/gpu_ray_cast.py --output FOLDER [--sizes 512,1024,2048] [--large]

Runs on the OpenGL that the window without a display finds: a graphics card, or else software.
Prints its name and writes into FOLDER gpu_ray_cast.md, and as .csv
  frames     best frame of each mesh, size and way of re-entry; cell steps and tetrahedra a second,
             bytes a tetrahedron, time to upload, and the largest difference from the picture of the
             mapper on the processor, of any channel
  table2     table 2 of Weiler et al. 2003 beside the same meshes, or those most like them, here:
             means over views of a mesh that turns about two axes, 512 x 512
  figure8    its figure 8: rays that take part in each pass on the heat sink, without the depth test
             that keeps done rays out, with it, and with early ray termination, too
The blunt fin takes part if TETRALUX_DATA names the folder with bluntfinxyz.bin. The command-line
tool (--tool) makes the other meshes. --large: also a mesh of ten million tetrahedra.
"""

import argparse
import csv
import json
import os
import shutil
import sys
import time

import numpy
import tetralux
from benchmark_meshes import generate, read_blunt_fin
from benchmark_scene import VolumeWindow, make_property
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData

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

FIGURE_8_STEPS = 8  # a pass; the paper has 1


def make_lattice(tetrahedra):
    """Voxels, five tetrahedra each."""
    n = round((tetrahedra / 5) ** (1 / 3)) + 1
    image = vtkImageData()
    image.SetDimensions(n, n, n)
    image.SetSpacing(*[1 / (n - 1)] * 3)
    x = numpy.linspace(0, 1, n)
    field = (
        numpy.sin(7 * x)[None, None, :]
        + numpy.cos(5 * x)[None, :, None] * numpy.sin(9 * x)[:, None, None]
    )
    array = numpy_to_vtk(field.ravel(), deep=True)
    array.SetName("Field")
    image.GetPointData().SetScalars(array)
    return image


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

    def render(self):
        """Seconds of a frame, until it is there."""
        begin = time.perf_counter()
        self.window.Render()
        self.window.WaitForCompletion()
        return time.perf_counter() - begin

    def get_statistics(self):
        return json.loads(self.mapper.GetStatistics())

    def get_colors(self):
        return tetralux.picture(self.mapper)[0]


def measure_frames(name, data, sizes, frames, renderer_name):
    rows = []
    for size in sizes:
        processor = Scene(data, tetralux.vtkTetrahedraRayCastMapper(), size)
        processor.mapper.AutoAdjustSampleDistancesOff()
        processor.render()
        processor_seconds = min(processor.render() for _ in range(frames))
        expected = processor.get_colors()
        for reentry, mode in REENTRY.items():
            mapper = tetralux.vtkTetrahedraGPURayCastMapper()
            mapper.SetReentry(mode)
            scene = Scene(data, mapper, size)
            scene.render()
            first = scene.get_statistics()
            mapper.CountFragmentsOn()
            scene.render()
            counted = scene.get_statistics()
            mapper.CountFragmentsOff()
            seconds = min(scene.render() for _ in range(frames))
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


def measure_table_2(meshes, views):
    rows = []
    for name, (cells, imaginary, paper_rate) in TABLE_2.items():
        if name not in meshes:
            continue
        mapper = tetralux.vtkTetrahedraGPURayCastMapper()
        mapper.SetReentryToImaginaryCells()
        scene = Scene(meshes[name], mapper, 512)
        scene.render()
        seconds = []
        for _ in range(views):
            # Both axes at once, at different speeds.
            scene.volume.RotateX(360 / views)
            scene.volume.RotateY(2 * 360 / views)
            scene.renderer.ResetCameraClippingRange()
            seconds.append(scene.render())
        tables = scene.get_statistics()["tables"]
        own_imaginary = tables.get("imaginary_cells", 0)
        rate = len(seconds) / sum(seconds)
        own_cells = tables["tetrahedra"] + own_imaginary
        rows.append(
            {
                "mesh": name,
                "paper_cells": cells,
                "paper_imaginary": imaginary,
                "paper_frames_per_second": paper_rate,
                "paper_tetrahedra_per_second": cells * paper_rate,
                "cells": own_cells,
                "imaginary": own_imaginary,
                "frames_per_second": rate,
                "tetrahedra_per_second": own_cells * rate,
            }
        )
        text = "table 2: {mesh} {frames_per_second:.2f} frames a second"
        print(text.format(**rows[-1]), flush=True)
    return rows


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
        scene.render()
        series[name] = scene.get_statistics()["rays"]["fragments_per_pass"]
    all_passes = series["depth test"]
    series["neither"] = [all_passes[0]] * len(all_passes)
    names = ["neither", "depth test", "depth test and early termination"]
    return [
        {"pass": k, **{name: series[name][k] if k < len(series[name]) else 0 for name in names}}
        for k in range(len(all_passes))
    ]


def write_csv(folder, name, rows):
    if rows:
        with open(os.path.join(folder, name + ".csv"), "w", newline="", encoding="utf-8") as file:
            writer = csv.DictWriter(file, rows[0].keys(), lineterminator="\n")
            writer.writeheader()
            writer.writerows(rows)


def make_table(titles, rows):
    lines = ["| " + " | ".join(titles) + " |", "|" + " --- |" * len(titles)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows]) + "\n"


def write_page(folder, renderer_name, frames, table_2, figure_8):
    with open(os.path.join(folder, "gpu_ray_cast.md"), "w", encoding="utf-8") as page:
        page.write(f"# Ray casting by OpenGL: {renderer_name}\n\n")
        page.write(
            make_table(
                ["mesh", "tetrahedra", "pixels", "re-entry", "frame, ms", "on the processor, ms",
                 "passes", "million cell steps a second", "bytes a tetrahedron", "upload, ms",
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
        )
        if table_2:
            page.write("\n## Table 2 of Weiler et al. 2003\n\n")
            page.write(
                make_table(
                    ["mesh", "cells there", "imaginary", "frames a second", "tetrahedra a second",
                     "cells here", "imaginary", "frames a second", "tetrahedra a second"],
                    [
                        [r["mesh"], f"{r['paper_cells']:,}", f"{r['paper_imaginary']:,}",
                         f"{r['paper_frames_per_second']:.2f}",
                         f"{r['paper_tetrahedra_per_second'] / 1e3:.0f} K", f"{r['cells']:,}",
                         f"{r['imaginary']:,}", f"{r['frames_per_second']:.2f}",
                         f"{r['tetrahedra_per_second'] / 1e3:.0f} K"]
                        for r in table_2
                    ],
                )
            )
        if figure_8:
            page.write(f"\n## Figure 8: rays in each pass of {FIGURE_8_STEPS} cells\n\n")
            names = list(figure_8[0])
            page.write(make_table(names, [[str(row[name]) for name in names] for row in figure_8]))
            sums = [sum(row[name] for row in figure_8) for name in names[1:]]
            parts = [f"{n} {s:,}" for n, s in zip(names[1:], sums)]
            page.write("\nIn all: " + ", ".join(parts) + "\n")


def main():
    parser = argparse.ArgumentParser(
        description=__doc__.split("\n", 1)[0], formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--output", required=True, help="folder of the tables")
    parser.add_argument("--sizes", default="512,1024,2048", help="pixels along an edge")
    parser.add_argument("--frames", type=int, default=5, help="of which the best counts")
    parser.add_argument("--views", type=int, default=24, help="of each mesh in table 2")
    parser.add_argument("--large", action="store_true", help="also ten million tetrahedra")
    parser.add_argument("--tool", default=shutil.which("tetralux") or "build/bin/tetralux")
    arguments = parser.parse_args()
    sizes = [int(size) for size in arguments.sizes.split(",")]
    os.makedirs(arguments.output, exist_ok=True)

    meshes = {}
    fin = read_blunt_fin()
    if fin:
        meshes["blunt fin"] = fin
    for name, (generator, parameters) in GENERATED.items():
        meshes[name] = generate(arguments.tool, generator, *parameters)

    probe = Scene(meshes["sphere"], tetralux.vtkTetrahedraGPURayCastMapper(), 64)
    probe.render()
    if "graphics_card" not in probe.get_statistics():
        sys.exit("gpu_ray_cast.py: this OpenGL can't cast rays, see the error above")
    renderer_name = probe.get_statistics()["graphics_card"]["renderer"]
    print(renderer_name, flush=True)

    measured = {name: meshes[name] for name in ("blunt fin", "ring") if name in meshes}
    measured["lattice, 1e6"] = make_lattice(1e6)
    if arguments.large:
        measured["lattice, 1e7"] = make_lattice(1e7)
    frames = []
    for name, data in measured.items():
        frames += measure_frames(name, data, sizes, arguments.frames, renderer_name)
        write_csv(arguments.output, "frames", frames)
    table_2 = measure_table_2(meshes, arguments.views)
    write_csv(arguments.output, "table2", table_2)
    figure_8 = measure_figure_8(meshes["heat sink"])
    write_csv(arguments.output, "figure8", figure_8)
    write_page(arguments.output, renderer_name, frames, table_2, figure_8)


if __name__ == "__main__":
    main()
