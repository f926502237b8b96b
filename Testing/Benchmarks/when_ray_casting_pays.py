#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""When ray casting pays: times of all methods over pixels, cells, depth and opacity.

    PYTHONPATH=build/lib/python3.11/dist-packages \
        python3 Testing/Benchmarks/when_ray_casting_pays.py [--tool build/bin/tetralux] \
        [--output Documentation/bench] [--page Documentation/Benchmarks.md]

Renders by the processor's ray caster, by ray casting in OpenGL and by projection in OpenGL, on
whatever OpenGL the window without a display finds. Meshes of about 1e4, 1e5 and 1e6 cells (with
--large also 1e7, but for the heat sink) are
  plate      few cells behind each other, seen face on
  bar        many cells behind each other, on as many pixels
  heat sink  rays leave and enter again between the fins
Each is seen nearly transparent and opaque. In each picture size the methods take turns; a frame's
time is the median. A method that takes longer than --longest seconds for a frame is left out of
larger sizes.

Writes when_ray_casting_pays.csv and the chart when_ray_casting_pays.svg. Fits to what each method
draws
  seconds = base + a * cells + b * steps + c * paths,
where steps are the cells that rays pass and paths how often they enter the mesh, and to what the
methods of OpenGL do on the processor, in the first frame and in others, a base and the share of a
cell. Prints these, also as Application/Setup/MethodCosts.cxx has them, and for each method how much
longer it takes than ray-cast; --page puts them into the page's table.
"""

import argparse
import gc
import os
import shutil
import sys

import numpy
import tetralux
from benchmark_chart import BLUE, GREEN, INK, RED, Axis, Panel, write_chart
from benchmark_meshes import generate, make_lattice
from benchmark_scene import VolumeWindow, get_statistics, make_property, time_render
from benchmark_tables import make_table, replace_table, write_csv

METHODS = {
    "ray-cast": (tetralux.vtkTetrahedraRayCastMapper, GREEN),
    "gpu-ray-cast": (tetralux.vtkTetrahedraGPURayCastMapper, BLUE),
    "projection": (tetralux.vtkTetrahedraProjectionMapper, RED),
}

SIZES = (64, 128, 256, 512, 1024, 2048)

# Optical depth of an edge of the whole mesh: rays see all of it, or end after some 20 %.
OPACITIES = {"transparent": 0.5, "opaque": 30}
MAXIMUM_ERROR = 2e-3  # half a step of 8 bits; no method promises less for the opaque bars

# Shares of the scalar range, colours, attenuations in units of the mean.
NODES = (
    (0, 0.1, 0.2, 0.9, 0.8),
    (0.3, 0, 0.8, 0.9, 1),
    (0.55, 0.2, 0.9, 0.2, 0.7),
    (0.8, 0.9, 0.8, 0.1, 1),
    (1, 0.9, 0.1, 0.1, 1.3),
)
LARGEST_OPACITY = max(node[4] for node in NODES)

# Voxels along the view over voxels across it.
PLATE, BAR = 1 / 8, 8

MARKER = "<!-- when_ray_casting_pays.py -->"
GROWTH = 4  # pixels of a size over those of the one before

# Of the statistics' seconds, those in which OpenGL draws, and their sum with the others.
DRAWING_STAGES = ("draw", "cast", "composite", "frame")


def list_meshes(tool, large):
    """Names of shapes, and of each what makes its meshes, one for each number of cells."""
    cells = (1e4, 1e5, 1e6) + ((1e7,) if large else ())
    parts = (1, 3, 6)

    def make_box(tetrahedra, aspect):
        return lambda: make_lattice(tetrahedra, aspect)

    def make_sink(part):
        return lambda: generate(tool, "heat-sink", "--cells", str(part))

    return {
        "plate": [make_box(n, PLATE) for n in cells],
        "bar": [make_box(n, BAR) for n in cells],
        "heat sink": [make_sink(part) for part in parts],
    }


def make_window(method, data, depth):
    mapper = METHODS[method][0]()
    if method == "ray-cast":
        mapper.AutoAdjustSampleDistancesOff()  # as for still pictures
    mapper.SetMaximumError(MAXIMUM_ERROR)
    mapper.SetInputData(data)
    lower, upper = data.GetPointData().GetScalars().GetRange(0)
    nodes = [
        (lower + share * (upper - lower), red, green, blue, alpha / LARGEST_OPACITY)
        for share, red, green, blue, alpha in NODES
    ]
    edge = data.GetLength() / 3**0.5
    window = VolumeWindow(mapper, make_property(nodes, edge / (depth * LARGEST_OPACITY)), 64, 64)
    window.camera.SetPosition(0.3, 0.2, 1)
    window.camera.SetFocalPoint(0, 0, 0)
    window.renderer.ResetCamera()
    window.camera.Zoom(1.5)
    return window


def get_processor_seconds(window, method):
    """What the processor does in a frame of OpenGL before and while the frame is drawn."""
    if method == "ray-cast":
        return 0  # it draws, too
    stages = get_statistics(window)["seconds"]
    return sum(seconds for stage, seconds in stages.items() if stage not in DRAWING_STAGES)


def measure(data, opacity, sizes, rounds, longest):
    """Rows of a mesh, one for each size and method."""
    windows = {method: make_window(method, data, OPACITIES[opacity]) for method in METHODS}
    first = {}
    for method, window in windows.items():
        time_render(window)
        first[method] = get_processor_seconds(window, method)
    rows = []
    for size in sizes:
        seconds = {method: [] for method in windows}
        for window in windows.values():
            window.window.SetSize(size, size)
            time_render(window)  # makes the textures of this size
        for _ in range(rounds):
            for method, window in windows.items():
                if sum(seconds[method]) < longest:
                    seconds[method].append(time_render(window))
        counted = get_statistics(windows["ray-cast"])
        medians = {method: float(numpy.median(times)) for method, times in seconds.items()}
        for method, window in windows.items():
            rows.append(
                {
                    "opacity": opacity,
                    "cells": counted["tables"]["tetrahedra"],
                    "size": size,
                    "steps": counted["rays"]["segments"],
                    "paths": counted["rays"]["paths"],
                    "method": method,
                    "frames": len(seconds[method]),
                    "seconds": medians[method],
                    "processor_seconds": get_processor_seconds(window, method),
                    "first_processor_seconds": first[method],
                }
            )
        if GROWTH * medians["ray-cast"] > longest:
            break  # it is the one that counts steps
        for method in [m for m in windows if GROWTH * medians[m] > longest]:
            del windows[method]
    return rows


def fit(terms, seconds):
    """Coefficients of at least 0, and the typical factor by which a time is missed.

    Relative errors count: short frames as much as long ones. What would be less than 0 is left out.
    """
    terms, seconds = numpy.array(terms, float), numpy.array(seconds)
    columns = list(range(terms.shape[1]))
    while True:
        matrix = terms[:, columns] / seconds[:, None]
        found = numpy.linalg.lstsq(matrix, numpy.ones(len(seconds)), rcond=None)[0]
        if found.min() >= 0:
            break
        del columns[int(found.argmin())]
    coefficients = numpy.zeros(terms.shape[1])
    coefficients[columns] = found
    return coefficients, numpy.exp(numpy.abs(numpy.log(terms @ coefficients / seconds)).mean())


def fit_costs(rows):
    """Of each method: what drawing takes, how far that misses, and the processor's work for a cell
    in a frame and in the first one, None for ray-cast."""
    costs = {}
    for method in METHODS:
        own = [row for row in rows if row["method"] == method]
        drawn = [row["seconds"] - row["processor_seconds"] for row in own]
        kept = [k for k in range(len(own)) if drawn[k] > 0.1 * own[k]["seconds"]]
        terms = [[1, own[k]["cells"], own[k]["steps"], own[k]["paths"]] for k in kept]
        drawing, factor = fit(terms, [drawn[k] for k in kept])
        work = [None, None]
        if method != "ray-cast":
            sizes = [[1, row["cells"]] for row in own]
            names = ("processor_seconds", "first_processor_seconds")
            work = [fit(sizes, [row[name] for row in own])[0][1] for name in names]
        costs[method] = (drawing, factor, *work)
    return costs


def make_chart(path, rows, renderer):
    shapes = list(dict.fromkeys(row["shape"] for row in rows))
    milliseconds = [1000 * row["seconds"] for row in rows]
    x = Axis("picture, pixels along an edge", SIZES[0], SIZES[-1], base=2)
    y = Axis("time of a frame, ms", min(milliseconds), max(milliseconds), base=10)
    panels = []
    for shape in shapes:
        panels.append([])
        for column in sorted({row["column"] for row in rows if row["shape"] == shape}):
            own = [row for row in rows if (row["shape"], row["column"]) == (shape, column)]
            steps = max(row["steps"] / row["size"] ** 2 for row in own)
            title = f"{shape}, {own[0]['cells']:,} cells, {steps:.0f} a pixel"
            panel = Panel(title, x, y)
            for opacity in OPACITIES:
                for method, (_, color) in METHODS.items():
                    points = [
                        (row["size"], 1000 * row["seconds"])
                        for row in own
                        if (row["opacity"], row["method"]) == (opacity, method)
                    ]
                    panel.add_line(points, color, opacity == "opaque")
            panels[-1].append(panel)
    legend = [(method, color, False) for method, (_, color) in METHODS.items()]
    legend += [(opacity, INK, opacity == "opaque") for opacity in OPACITIES]
    write_chart(path, f"When ray casting pays: {renderer}", panels, legend)


def format_ratios(rows):
    """Least, median and largest time of each method over that of ray-cast in the same picture."""

    def get_picture(row):
        return tuple(row[name] for name in ("shape", "cells", "opacity", "size"))

    base = {get_picture(row): row["seconds"] for row in rows if row["method"] == "ray-cast"}
    text = ""
    for method in list(METHODS)[1:]:
        ratios = sorted(
            (row["seconds"] / base[get_picture(row)], get_picture(row))
            for row in rows
            if row["method"] == method
        )
        least, median, largest = (ratios[k] for k in (0, len(ratios) // 2, -1))
        text += f"{method}: {least[0]:.2f} ({least[1]}), {median[0]:.2f}, {largest[0]:.2f}\n"
    return text


def format_costs(costs):
    def format_nanoseconds(seconds):
        return "" if seconds is None else f"{1e9 * seconds:.{1 if seconds < 1e-7 else 0}f}"

    titles = ["method", "base, ms", "cell, ns", "step, ns", "path, ns", "missed by a factor of",
              "processor, cell, ns", "in the first frame, ns"]
    return make_table(
        titles,
        [
            [method, f"{1e3 * drawing[0]:.2g}", *map(format_nanoseconds, drawing[1:]),
             f"{factor:.2f}", *map(format_nanoseconds, work)]
            for method, (drawing, factor, *work) in costs.items()
        ],
    )


def format_code(costs):
    """What MethodCosts.cxx has."""
    return "".join(
        f'  {{ "{method}", {", ".join(f"{value:.2g}" for value in (*drawing, first))} }},\n'
        for method, (drawing, _, _, first) in costs.items()
        if first is not None
    )


def parse_arguments():
    parser = argparse.ArgumentParser(
        description=__doc__.split("\n", 1)[0], formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--output", default="Documentation/bench", help="folder of chart and .csv")
    parser.add_argument("--page", help="page of Markdown whose table is replaced")
    parser.add_argument("--rounds", type=int, default=5, help="frames timed of each (5)")
    parser.add_argument("--longest", type=float, default=3, help="seconds of a frame, at most (3)")
    parser.add_argument("--large", action="store_true", help="also 1e7 cells")
    parser.add_argument("--tool", default=shutil.which("tetralux") or "build/bin/tetralux")
    parser.add_argument("--quick", action="store_true", help="small, to see that all works")
    return parser.parse_args()


def main():
    options = parse_arguments()
    sizes = SIZES[:2] if options.quick else SIZES
    rounds = 1 if options.quick else options.rounds
    meshes = list_meshes(options.tool, options.large)
    probe = make_window("gpu-ray-cast", make_lattice(1e3, 1), 1)
    time_render(probe)
    if "graphics_card" not in get_statistics(probe):
        sys.exit("when_ray_casting_pays.py: this OpenGL can't cast rays, see the error above")
    renderer = get_statistics(probe)["graphics_card"]["renderer"]
    print(renderer, flush=True)

    rows = []
    for shape, makers in meshes.items():
        for column, make in enumerate(makers[:1] if options.quick else makers):
            data = make()
            for opacity in OPACITIES:
                for row in measure(data, opacity, sizes, rounds, options.longest):
                    rows.append({"shape": shape, "column": column, **row})
                    text = "{shape} {cells} {opacity} {size} {method}: {seconds:.4f} s"
                    print(text.format(**rows[-1]), flush=True)
                gc.collect()
    write_csv(os.path.join(options.output, "when_ray_casting_pays.csv"), rows)
    make_chart(os.path.join(options.output, "when_ray_casting_pays.svg"), rows, renderer)
    costs = fit_costs(rows)
    print(format_costs(costs), format_code(costs), format_ratios(rows), sep="\n")
    if options.page:
        replace_table(options.page, MARKER, format_costs(costs))


if __name__ == "__main__":
    main()
