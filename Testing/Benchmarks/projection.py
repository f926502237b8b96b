#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Projected tetrahedra: what each of the paper's corrections costs, and the artifact that it cures.

    TETRALUX_DATA=FOLDER PYTHONPATH=build/lib/python3.11/dist-packages \
        python3 Testing/Benchmarks/projection.py [--tetralux build/bin/tetralux] [--output FOLDER]

Sets tables 1 and 2 of Kraus, Qiao and Ebert, Projecting Tetrahedra without Rendering Artifacts
(2004), beside what is measured here, with vtkProjectedTetrahedraMapper in the same run: whole
frames, the best of several, taken in turns so that other load of the machine hits all alike.
Remakes their figures 7 to 10: pictures with one correction off, their difference from the ray
caster's picture in double precision, magnified, and the error in numbers. Writes index.html and the
pictures to FOLDER. Leaves out the blunt fin without TETRALUX_DATA.
"""

import argparse
import html
import json
import os
import shutil
import sys

import numpy
import tetralux
import vtkmodules.vtkRenderingVolumeOpenGL2  # noqa: F401, VTK's mappers come from factories
from benchmark_meshes import generate, read_blunt_fin, split_by_vtk
from benchmark_scene import (
    BLUNT_FIN_FOCUS,
    BLUNT_FIN_NODES,
    BLUNT_FIN_POSITION,
    VolumeWindow,
    make_property,
    time_frames,
)
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingVolume import vtkProjectedTetrahedraMapper

Mapper = tetralux.vtkTetrahedraProjectionMapper

# The paper's lookup table: 256 x 256 x 16 texels.
TABLE = {
    "Integration": Mapper.TABLE,
    "TableScalarSize": 256,
    "TableLengthSize": 16,
    "TableScalarAxis": Mapper.UNIFORM_AXIS,
}
EIGHT_BITS = {"TableFormat": Mapper.UNORM8_FORMAT}
SIXTEEN_BITS = {"TableFormat": Mapper.UNORM16_FORMAT}
UNIFORM = {"TableLengthScale": Mapper.LINEAR_SCALE}
LOGARITHMIC = {"TableLengthScale": Mapper.LOGARITHMIC_SCALE}
LINEAR = {"PerspectiveInterpolation": 0}
FRAME_BUFFER = {"ColorBuffer": Mapper.UNORM8_BUFFER, "AlphaDithering": 0}
DITHERED = {"ColorBuffer": Mapper.UNORM8_BUFFER, "AlphaDithering": 1}
HALF = {"ColorBuffer": Mapper.HALF_BUFFER}
FLOAT = {"ColorBuffer": Mapper.FLOAT_BUFFER}
BEST_TABLE = {**TABLE, **SIXTEEN_BITS, **LOGARITHMIC}

# Seconds of the paper's table 1, for 800 x 600 pixels.
TABLE_1 = (
    ("corrections off (i)", {**TABLE, **EIGHT_BITS, **UNIFORM, **LINEAR, **FRAME_BUFFER}, 0.195),
    (
        "and perspective interpolation (ii)",
        {**TABLE, **EIGHT_BITS, **UNIFORM, **FRAME_BUFFER},
        0.243,
    ),
    ("and a 16-bit table (iii)", {**TABLE, **SIXTEEN_BITS, **UNIFORM, **FRAME_BUFFER}, 0.274),
    ("and a logarithmic table (iv)", {**BEST_TABLE, **FRAME_BUFFER}, 0.314),
    ("and alpha dithering", {**BEST_TABLE, **DITHERED}, 0.621),
    ("16-bit floating point color buffer", {**BEST_TABLE, **HALF}, None),
    ("32-bit floating point color buffer", {**BEST_TABLE, **FLOAT}, 1.781),
    ("the same, closed form instead of the table", FLOAT, None),
)

# Cells and tetrahedra a second of the paper's table 2.
TABLE_2_OF_THE_PAPER = (
    ("heat sink", 121668, 483e3),
    ("blunt fin", 187318, 597e3),
    ("cylinder", 624960, 673e3),
    ("X38", 1943483, 633e3),
)


class Scene:
    """A data set with a camera and a transfer function."""

    def __init__(self, grid, array, position, focus, nodes, unit_distance=1.0, angle=30.0):
        self.grid = grid
        self.array = array
        self.position = position
        self.focus = focus
        self.nodes = nodes  # scalar, red, green, blue, opacity
        self.unit_distance = unit_distance
        self.angle = angle

    def make_window(self, mapper, width, height):
        mapper.SetInputData(self.grid)
        mapper.SetScalarModeToUsePointFieldData()
        mapper.SelectScalarArray(self.array)
        volume_property = make_property(self.nodes, self.unit_distance)
        volume_window = VolumeWindow(mapper, volume_property, width, height)
        volume_window.look(self.position, self.focus, self.angle)
        return volume_window


def make_mapper(settings):
    mapper = Mapper()
    for name, value in settings.items():
        getattr(mapper, "Set" + name)(value)
    return mapper


def get_picture(mapper, width, height):
    rgba = mapper.GetOutputImage().GetPointData().GetArray("RGBA")
    return vtk_to_numpy(rgba).reshape(height, width, 4).astype(float)


def render(scene, mapper, width, height):
    volume_window = scene.make_window(mapper, width, height)
    volume_window.window.Render()
    return get_picture(mapper, width, height)


def render_reference(scene, width, height):
    mapper = tetralux.vtkTetrahedraRayCastMapper()
    mapper.SetPrecisionToDouble()
    mapper.SetMaximumError(1e-6)
    mapper.SetIntegrationToClosedForm()
    mapper.SetAutoAdjustSampleDistances(False)
    return render(scene, mapper, width, height)


def make_scene(grid, density, nodes, direction=(2.1, 1.6, 2.6), angle=30.0, distance=1.0):
    """nodes: shares of the scalar range, colours, attenuations in units of density / radius."""
    array = grid.GetPointData().GetArray(0)
    low, high = array.GetRange()
    bounds = numpy.array(grid.GetBounds()).reshape(3, 2)
    center = bounds.mean(axis=1)
    radius = numpy.linalg.norm(bounds[:, 1] - bounds[:, 0]) / 2
    largest = max(node[4] for node in nodes)
    scaled = [
        (low + share * (high - low), red, green, blue, alpha / largest)
        for share, red, green, blue, alpha in nodes
    ]
    position = center + distance * radius * numpy.array(direction)
    return Scene(
        grid, array.GetName(), position, center, scaled, radius / (density * largest), angle
    )


SMOOTH = (
    (0.0, 0, 0, 1, 0.0),
    (0.15, 0, 1, 1, 0.1),
    (0.3, 0, 1, 0, 2.0),
    (0.45, 1, 1, 0, 0.2),
    (1.0, 1, 0, 0, 4.0),
)


def make_peak(share, width):
    """A surface of constant scalar, as the paper imitates it."""
    return (
        (0.0, 1, 0.8, 0.5, 0.0),
        (share - width, 1, 0.8, 0.5, 0.0),
        (share, 1, 0.8, 0.5, 400.0),
        (share + width, 0.3, 0.5, 1, 0.0),
        (1.0, 0.3, 0.5, 1, 0.0),
    )


class Page:
    """An HTML page and the pictures beside it."""

    def __init__(self, folder):
        self.folder = folder
        self.parts = []

    def add(self, text):
        self.parts.append(text)

    def add_table(self, header, rows):
        cells = "".join(f"<th>{html.escape(cell)}</th>" for cell in header)
        self.add(f"<table>\n<tr>{cells}</tr>")
        for row in rows:
            cells = "".join(f"<td>{html.escape(str(cell))}</td>" for cell in row)
            self.add(f"<tr>{cells}</tr>")
        self.add("</table>")

    def write_picture(self, name, rgb):
        pixels = numpy.ascontiguousarray(numpy.clip(rgb * 255 + 0.5, 0, 255).astype(numpy.uint8))
        image = vtkImageData()
        image.SetDimensions(pixels.shape[1], pixels.shape[0], 1)
        image.GetPointData().SetScalars(numpy_to_vtk(pixels.reshape(-1, 3), deep=True))
        writer = vtkPNGWriter()
        writer.SetCompressionLevel(9)
        writer.SetFileName(os.path.join(self.folder, name))
        writer.SetInputData(image)
        writer.Write()

    def write(self):
        style = (
            "body{font-family:sans-serif;max-width:62em;margin:2em auto;line-height:1.4}"
            "table{border-collapse:collapse;margin:1em 0}td,th{padding:.2em .8em;text-align:left;"
            "border-bottom:1px solid #ccc}figure{display:inline-block;margin:.3em}"
            "figcaption{font-size:80%;max-width:256px}"
        )
        with open(os.path.join(self.folder, "index.html"), "w", encoding="utf-8") as page:
            page.write(
                '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
                "<title>Projected tetrahedra without artifacts</title>\n"
                f"<style>{style}</style>\n</head>\n<body>\n"
                "<!-- Written by Testing/Benchmarks/projection.py -->\n"
            )
            page.write("\n".join(self.parts))
            page.write("\n</body>\n</html>\n")


def describe_errors(picture, reference):
    """Of channels over 255, at covered pixels."""
    difference = numpy.abs(picture - reference).max(axis=2)[reference.max(axis=2) > 0] * 255
    # Mean of blocks of 8 x 8 pixels: what an eye makes of noise.
    height, width = (size // 8 * 8 for size in picture.shape[:2])
    signed = (picture - reference)[:height, :width] * 255
    blocks = signed.reshape(height // 8, 8, width // 8, 8, 4).mean(axis=(1, 3))
    return (
        f"{difference.max():.3f}",
        f"{numpy.sqrt((difference**2).mean()):.4f}",
        f"{numpy.quantile(difference, 0.999):.3f}",
        f"{numpy.abs(blocks).max():.3f}",
    )


ERROR_HEADER = ("variant", "largest", "RMS", "99.9 %", "largest, mean of 8 x 8 pixels")


def add_figure(page, name, title, scene, variants, size=(256, 192)):
    """variants: name, settings, magnification of the difference."""
    reference = render_reference(scene, *size)
    page.add(f"<h3>{html.escape(title)}</h3>")
    rows = []
    for index, (variant, settings, magnification) in enumerate(variants):
        picture = render(scene, make_mapper(settings), *size)
        background = numpy.ones(3)
        seen = picture[:, :, :3] + (1 - picture[:, :, 3:]) * background
        difference = numpy.abs(picture - reference)[:, :, :3] * magnification
        letter = chr(ord("a") + index)
        page.write_picture(f"{name}-{letter}.png", seen)
        page.write_picture(f"{name}-{letter}-difference.png", difference)
        caption = html.escape(f"({letter}) {variant}")
        page.add(
            f'<figure><img src="{name}-{letter}.png" alt="">'
            f'<img src="{name}-{letter}-difference.png" '
            f'alt=""><figcaption>{caption}; difference x {magnification}</figcaption></figure>'
        )
        rows.append((f"({letter}) {variant}", *describe_errors(picture, reference)))
        print(title, rows[-1], flush=True)
    page.add("<p>Errors in units of 1/255:</p>")
    page.add_table(ERROR_HEADER, rows)


def add_costs(page, fin, options):
    width, height = options.size, options.size
    page.add(f"<h2>What the corrections cost (table 1), {width} x {height} pixels</h2>")
    vtk = vtkProjectedTetrahedraMapper()
    mappers = [make_mapper(settings) for _, settings, _ in TABLE_1]
    entries = [fin.make_window(mapper, width, height) for mapper in [vtk, *mappers]]
    times, processor = time_frames(entries, options.rounds)
    rows = []
    names = [("vtkProjectedTetrahedraMapper", None, None), *TABLE_1]
    for (name, _, paper), seconds, used in zip(names, times, processor):
        rows.append(
            (
                name,
                f"{seconds:.3f}",
                f"{seconds / times[0]:.2f}",
                f"{used:.2f}",
                f"{used / processor[0]:.2f}",
                "" if paper is None else f"{paper}",
            )
        )
        print("%-50s %s s  %s x VTK   processor %s s  %s x VTK   paper %s" % rows[-1], flush=True)
    page.add(
        "<p>Whole frames of the blunt fin, order of cells included. Processor seconds are of all "
        "threads, and hardly depend on what else the machine does.</p>"
    )
    page.add_table(
        ("", "seconds", "of VTK's", "processor seconds", "of VTK's", "paper, 800 x 600, seconds"),
        rows,
    )
    stages = json.loads(mappers[-1].GetStatistics())["seconds"]
    page.add(
        "<p>Of the last: order "
        f"{stages['order']:.3f} s, projecting points and cells on the processor "
        f"{stages['points'] + stages['project']:.3f} s, the rest is drawing.</p>"
    )


def add_speeds(page, scenes, options):
    width, height = options.size, options.size
    page.add(f"<h2>Tetrahedra a second (table 2), {width} x {height} pixels</h2>")
    rows = []
    for name, scene in scenes:
        mappers = [
            vtkProjectedTetrahedraMapper(),
            make_mapper({**BEST_TABLE, **FRAME_BUFFER}),
            make_mapper(FLOAT),
        ]
        times, _ = time_frames(
            [scene.make_window(mapper, width, height) for mapper in mappers], options.rounds
        )
        cells = scene.grid.GetNumberOfCells()
        rows.append(
            (
                name,
                f"{cells}",
                *(f"{seconds:.3f} s, {cells / seconds / 1000:.0f} K" for seconds in times),
            )
        )
        print(rows[-1], flush=True)
    page.add_table(
        ("data set", "cells", "VTK's mapper", "table, 8-bit buffer", "closed form, float buffer"),
        rows,
    )
    page.add("<p>The paper's, for 800 x 600 pixels on a Quadro FX 3000:</p>")
    page.add_table(
        ("data set", "cells", "tetrahedra a second"),
        [(name, cells, f"{speed / 1000:.0f} K") for name, cells, speed in TABLE_2_OF_THE_PAPER],
    )


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument(
        "--tetralux", default=shutil.which("tetralux"), help="the command-line tool"
    )
    parser.add_argument("--output", default="Documentation/projection", help="folder of the page")
    parser.add_argument("--size", type=int, default=512, help="pixels along an edge (512)")
    parser.add_argument("--rounds", type=int, default=5, help="frames timed of each (5)")
    parser.add_argument("--large", action="store_true", help="a mesh of ten million cells, too")
    parser.add_argument("--no-figures", action="store_true", help="the tables alone")
    options = parser.parse_args()
    if not options.tetralux:
        sys.exit("projection.py: --tetralux must name the command-line tool")
    os.makedirs(options.output, exist_ok=True)

    fin = None
    grid = read_blunt_fin()
    if grid:
        mesh = split_by_vtk(grid)
        fin = Scene(mesh, "Density", BLUNT_FIN_POSITION, BLUNT_FIN_FOCUS, BLUNT_FIN_NODES)
    sink = generate(options.tetralux, "heat-sink")
    layer = generate(options.tetralux, "boundary-layer")

    page = Page(options.output)
    page.add("<h1>Projected tetrahedra without artifacts</h1>")
    page.add(
        "<p>vtkTetrahedraProjectionMapper beside the paper it is after: M. Kraus, W. Qiao and "
        "D. S. Ebert, Projecting Tetrahedra without Rendering Artifacts, IEEE Visualization 2004. "
        "Errors are "
        "against vtkTetrahedraRayCastMapper in double precision.</p>"
    )
    if fin:
        add_costs(page, fin, options)
    scenes = [("heat sink", make_scene(sink, 1, SMOOTH))]
    scenes += [("blunt fin", fin)] if fin else []
    for cells in (16, 34, 74) + ((159,) if options.large else ()):
        ball = generate(options.tetralux, "ball", "--cells", str(cells))
        scenes.append((f"ball of {ball.GetNumberOfCells()}", make_scene(ball, 1, SMOOTH)))
    add_speeds(page, scenes, options)

    if not options.no_figures:
        page.add("<h2>The artifacts (figures 7 to 10)</h2>")
        if fin:
            close = Scene(fin.grid, "Density", (14, 10, 16), fin.focus, fin.nodes, 0.5, 25)
            add_figure(
                page,
                "table-bits",
                "Figure 7: bits of the table and of the color buffer, blunt fin",
                close,
                (
                    ("8-bit table, float buffer", {**TABLE, **EIGHT_BITS, **LOGARITHMIC}, 16),
                    ("16-bit table, 8-bit buffer", {**BEST_TABLE, **FRAME_BUFFER}, 16),
                    ("16-bit table, float buffer", BEST_TABLE, 16),
                    ("closed form, float buffer", FLOAT, 16),
                ),
            )
        surface = make_scene(sink, 1, make_peak(0.45, 0.004), (1.1, 1.0, 1.5), 28)
        add_figure(
            page,
            "perspective",
            "Figure 8: a surface of constant scalar, heat sink",
            surface,
            (
                ("linear interpolation on the screen", LINEAR, 2),
                ("perspective interpolation", FLOAT, 2),
            ),
        )
        ball = generate(options.tetralux, "ball", "--cells", "74")
        thin = make_scene(ball, 0.05, SMOOTH)
        page.add(
            "<p>Alpha dithering (figure 9) keeps what is too thin for 8 bits. What it can't help, "
            "as the paper says, is that each blending rounds again: where cells are less thin, as "
            "in figure 7, "
            "it only turns steps into noise.</p>"
        )
        add_figure(
            page,
            "dithering",
            "Figure 9: color buffers, a ball of a million thin cells",
            thin,
            (
                ("8-bit buffer", FRAME_BUFFER, 16),
                ("8-bit buffer, alpha dithering", DITHERED, 16),
                ("half float buffer", HALF, 16),
                ("float buffer", FLOAT, 16),
            ),
        )
        dense = make_scene(layer, 1000, SMOOTH, (2.1, 1.6, 2.6), 30, 0.9)
        add_figure(
            page,
            "logarithmic",
            "Figure 10: lengths of the table, boundary layer with edges 1 : 1e6",
            dense,
            (
                ("uniform lengths", {**TABLE, **SIXTEEN_BITS, **UNIFORM}, 2),
                ("logarithmic lengths", BEST_TABLE, 2),
                ("closed form", FLOAT, 2),
            ),
        )
        if fin:
            page.add("<h3>The order of cells, blunt fin</h3>")
            reference = render_reference(fin, 512, 512)
            rows = []
            for name, order in (
                ("exact, by common faces of the convexified mesh", Mapper.EXACT_ORDER),
                ("by common faces, not convexified", Mapper.NON_CONVEX_ORDER),
                ("by distance of centroids", Mapper.CENTROID_ORDER),
            ):
                picture = render(fin, make_mapper({"Order": order}), 512, 512)
                rows.append((name, *describe_errors(picture, reference)))
                print("order", rows[-1], flush=True)
            page.add_table(ERROR_HEADER, rows)
    page.write()


if __name__ == "__main__":
    main()
