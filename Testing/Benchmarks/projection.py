#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Projected tetrahedra: what each of the paper's corrections costs, and the artifact that it cures.

    TETRALUX_DATA=FOLDER PYTHONPATH=build/lib/python3.11/dist-packages \
        python3 Testing/Benchmarks/projection.py [--tetralux build/bin/tetralux] [--output FOLDER]

Tables 1 and 2 of Kraus, Qiao and Ebert, Projecting Tetrahedra without Rendering Artifacts (2004),
beside what is measured here, with vtkProjectedTetrahedraMapper in the same run. Times are those of
the processor, of all threads and whole frames, the best of several that take turns: they hardly
depend on what else the machine does. frame_time.py measures frames by the clock.
Figures 7 to 10 are made anew: pictures with one correction off, their magnified difference from the
ray caster's picture in double precision, and the error in numbers.

Writes index.html, from the template of `tetralux bench`, and the pictures to FOLDER. Leaves out the
blunt fin without TETRALUX_DATA.
"""

import argparse
import copy
import os
import shutil
import sys

import numpy
import tetralux
import vtkmodules.vtkRenderingVolumeOpenGL2  # noqa: F401, VTK's mappers come from factories
from benchmark_meshes import (
    generate,
    make_graded_body,
    make_tapered_cylinder,
    read_blunt_fin,
    split_by_vtk,
)
from benchmark_page import Page
from benchmark_scene import (
    BLUNT_FIN_FOCUS,
    BLUNT_FIN_NODES,
    BLUNT_FIN_POSITION,
    VolumeWindow,
    make_property,
    time_frames,
)
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkRenderingVolume import vtkProjectedTetrahedraMapper

Mapper = tetralux.vtkTetrahedraProjectionMapper
Sort = tetralux.vtkMeshedPolyhedraVisibilitySort

# The paper's lookup table: 256 x 256 x 16 texels.
TABLE = {
    "Integration": Mapper.TABLE_INTEGRATION,
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
DEPTH_LEVELS = 9  # pictures between which errors of interpolation are far below what is measured
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

    def replace(self, **changes):
        scene = copy.copy(self)
        vars(scene).update(changes)
        return scene

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


def render(scene, mapper, width, height):
    volume_window = scene.make_window(mapper, width, height)
    volume_window.window.Render()
    return tetralux.picture(mapper)[0].astype(float)


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


def add_figure(page, name, title, scene, variants, size, paragraphs=()):
    """variants: name, settings, magnification of the difference."""
    reference = render_reference(scene, *size)
    rows = []
    figures = []
    for index, (variant, settings, magnification) in enumerate(variants):
        picture = render(scene, make_mapper(settings), *size)
        background = numpy.ones(3)
        seen = picture[:, :, :3] + (1 - picture[:, :, 3:]) * background
        difference = numpy.abs(picture - reference)[:, :, :3] * magnification
        label = f"({chr(ord('a') + index)}) {variant}"
        files = [f"{name}-{label[1]}.png", f"{name}-{label[1]}-difference.png"]
        page.write_picture(files[0], seen)
        page.write_picture(files[1], difference)
        figures.append((files, f"{label}; difference x {magnification}"))
        rows.append((label, *describe_errors(picture, reference)))
        print(title, rows[-1], flush=True)
    page.add_section(
        title, *paragraphs, level=3, figures=figures, columns=ERROR_HEADER, rows=rows,
        notes=("Errors in units of 1/255.",),
    )


def add_costs(page, fin, options):
    width, height = options.size, options.size
    vtk = vtkProjectedTetrahedraMapper()
    mappers = [make_mapper(settings) for _, settings, _ in TABLE_1]
    entries = [fin.make_window(mapper, width, height) for mapper in [vtk, *mappers]]
    _, times = time_frames(entries, options.rounds)
    rows = []
    names = [("vtkProjectedTetrahedraMapper", None, None), *TABLE_1]
    for (name, _, paper), seconds in zip(names, times):
        rows.append(
            (
                name,
                f"{seconds:.3f}",
                f"{seconds / times[0]:.2f}",
                "" if paper is None else f"{paper}",
            )
        )
        print("%-50s %s s  %s x VTK   paper %s" % rows[-1], flush=True)
    page.add_section(
        f"What the corrections cost (table 1), {width} x {height} pixels",
        "Processor seconds of all threads for whole frames of the blunt fin, order of cells "
        "included. They hardly depend on what else the machine does.",
        columns=("variant", "processor seconds", "of VTK's", "paper, 800 x 600, seconds"),
        rows=rows,
    )


def add_speeds(page, scenes, options):
    rows = []
    for name, scene in scenes:
        cells = scene.grid.GetNumberOfCells()
        mappers = [
            vtkProjectedTetrahedraMapper(),
            make_mapper({**BEST_TABLE, **FRAME_BUFFER}),
            make_mapper(FLOAT),
        ]
        windows = [scene.make_window(mapper, 64, 64) for mapper in mappers]
        for size in options.sizes:
            for entry in windows:
                entry.window.SetSize(size, size)
            _, times = time_frames(windows, options.rounds)
            rows.append(
                (
                    name if size == options.sizes[0] else "",
                    f"{cells}" if size == options.sizes[0] else "",
                    f"{size} x {size}",
                    *(f"{seconds:.3f} s, {cells / seconds / 1000:.0f} K" for seconds in times),
                )
            )
            print(name, *rows[-1][2:], flush=True)
    page.add_section(
        "Tetrahedra a second (table 2)",
        "Processor seconds of a frame, and thousands of tetrahedra a processor second. The "
        "cylinder and the body are made by formulas, as large as the paper's meshes: layers around "
        "a tapered cylinder and around a flat ellipsoid, which grow outwards. The body's longest "
        "edge is 130,000 times as long as its shortest; of the X38 the paper says only that this "
        "ratio is very high.",
        columns=("data set", "cells", "pixels", "VTK's mapper", "table, 8-bit buffer",
                 "closed form, float buffer"),
        rows=rows,
    )
    page.add_section(
        "The paper's, for 800 x 600 pixels on a Quadro FX 3000",
        level=3,
        columns=("data set", "cells", "seconds", "tetrahedra a second"),
        rows=[(name, f"{cells}", f"{cells / speed:.3f}", f"{speed / 1000:.0f} K")
              for name, cells, speed in TABLE_2_OF_THE_PAPER],
    )


def render_depths_as_lengths(scene, size):
    """The exact picture if each segment had its extent along the view axis for a length.

    All segments of a ray are shortened by the cosine between ray and axis. Pictures for some
    cosines are rendered, and of each pixel is taken what its own cosine has between two of them.
    """
    height = numpy.tan(numpy.radians(scene.angle) / 2)
    at = (2 * numpy.arange(size) + 1 - size) / size * height
    cosines = 1 / numpy.sqrt(1 + at[:, None] ** 2 + at[None, :] ** 2)
    levels = numpy.linspace(cosines.min(), 1, DEPTH_LEVELS)
    pictures = []
    for level in levels:
        pictures.append(
            render_reference(scene.replace(unit_distance=scene.unit_distance / level), size, size)
        )
    place = (cosines - levels[0]) / (levels[1] - levels[0])
    below = numpy.minimum(place.astype(int), DEPTH_LEVELS - 2)
    share = (place - below)[:, :, None]
    rows, columns = numpy.indices(below.shape)
    stack = numpy.array(pictures)
    return (1 - share) * stack[below, rows, columns] + share * stack[below + 1, rows, columns]


def render_mean_attenuations(scene, size):
    """The exact picture if the attenuation were linear in each cell, as by Stein et al. 1994.

    The attenuations at the points are the scalars, and opacity rises with them, so that a segment
    has the mean of the attenuations at its ends. Only opacities are those of the method.
    """
    data = vtk_to_numpy(scene.grid.GetPointData().GetArray(scene.array)).astype(float)
    scalars, *_, opacities = zip(*scene.nodes)
    attenuations = numpy.interp(data, scalars, opacities)
    grid = scene.grid.NewInstance()
    grid.ShallowCopy(scene.grid)
    array = numpy_to_vtk(attenuations, deep=True)
    array.SetName("Attenuation")
    grid.GetPointData().AddArray(array)
    nodes = ((0, 1, 1, 1, 0), (attenuations.max(), 1, 1, 1, attenuations.max()))
    return render_reference(scene.replace(grid=grid, array="Attenuation", nodes=nodes), size, size)


def add_approximations(page, scenes, options):
    """What section 2.3 allows, and what the method before pre-integration did."""
    size = options.size
    rows = []
    for name, scene in scenes:
        reference = render_reference(scene, size, size)
        depths = render_depths_as_lengths(scene, size)
        means = render_mean_attenuations(scene, size)
        background = numpy.zeros_like(reference[:, :, :3])
        rows.append((name, "length by depths", *describe_errors(depths, reference)))
        opacities = [numpy.dstack([background, picture[:, :, 3]]) for picture in (means, reference)]
        rows.append((name, "mean attenuation, opacity alone", *describe_errors(*opacities)))
        print(*rows[-2:], sep="\n", flush=True)
    page.add_section(
        f"What the length and the attenuation are worth, {size} x {size} pixels",
        "The paper allows to take the difference of depths for the length of a segment (section "
        "2.3). Stein et al. took the mean of the attenuations at its ends for the attenuation "
        "along it, before there was pre-integration. The mapper has neither as a setting. What "
        "they would show is computed by the ray caster: with each ray shortened by its cosine to "
        "the view axis, and with the attenuation as the scalar. The exact length takes a fragment "
        "one dot product and one square root.",
        columns=("data set", *ERROR_HEADER),
        rows=rows,
        notes=("Errors in units of 1/255.",),
    )


def add_figures(page, options, fin, sink):
    """Figures 7 to 10 of the paper, and what other orders of cells do."""
    size = (64, 48) if options.quick else (256, 192)
    page.add_section("The artifacts (figures 7 to 10)")
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
            size,
        )
    add_figure(
        page,
        "perspective",
        "Figure 8: a surface of constant scalar, heat sink",
        make_scene(sink, 1, make_peak(0.45, 0.004), (1.1, 1.0, 1.5), 28),
        (
            ("linear interpolation on the screen", LINEAR, 2),
            ("perspective interpolation", FLOAT, 2),
        ),
        size,
    )
    ball = generate(options.tetralux, "ball", "--cells", "16" if options.quick else "74")
    add_figure(
        page,
        "dithering",
        f"Figure 9: color buffers, a ball of {ball.GetNumberOfCells()} thin cells",
        make_scene(ball, 0.05, SMOOTH),
        (
            ("8-bit buffer", FRAME_BUFFER, 16),
            ("8-bit buffer, alpha dithering", DITHERED, 16),
            ("half float buffer", HALF, 16),
            ("float buffer", FLOAT, 16),
        ),
        size,
        (
            "Alpha dithering keeps what is too thin for 8 bits. As the paper says, it can't help "
            "that each blending rounds again: where cells are less thin, as in figure 7, it only "
            "turns steps into noise.",
        ),
    )
    layer = generate(options.tetralux, "boundary-layer")
    add_figure(
        page,
        "logarithmic",
        "Figure 10: lengths of the table, boundary layer with edges 1 : 1e6",
        make_scene(layer, 1000, SMOOTH, (2.1, 1.6, 2.6), 30, 0.9),
        (
            ("uniform lengths", {**TABLE, **SIXTEEN_BITS, **UNIFORM}, 2),
            ("logarithmic lengths", BEST_TABLE, 2),
            ("closed form", FLOAT, 2),
        ),
        size,
    )
    if fin:
        add_orders(page, fin, 2 * size[0])


def add_orders(page, fin, size):
    reference = render_reference(fin, size, size)
    rows = []
    for name, order in (
        ("exact, by common faces of the convexified mesh", Sort.EXACT_ORDER),
        ("by common faces, not convexified", Sort.NON_CONVEX_ORDER),
        ("by distance of centroids", Sort.CENTROID_ORDER),
    ):
        picture = render(fin, make_mapper({"Order": order}), size, size)
        rows.append((name, *describe_errors(picture, reference)))
        print("order", rows[-1], flush=True)
    page.add_section(
        "The order of cells, blunt fin", level=3, columns=ERROR_HEADER, rows=rows,
        notes=("Errors in units of 1/255.",),
    )


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument(
        "--tetralux", default=shutil.which("tetralux"), help="the command-line tool"
    )
    parser.add_argument("--output", default="Documentation/projection", help="folder of the page")
    parser.add_argument("--size", type=int, default=512, help="pixels along an edge (512)")
    parser.add_argument(
        "--sizes", default="256,512,1024", help="pixels along an edge in table 2 (256,512,1024)"
    )
    parser.add_argument("--rounds", type=int, default=5, help="frames timed of each (5)")
    parser.add_argument("--large", action="store_true", help="a mesh of ten million cells, too")
    parser.add_argument("--no-figures", action="store_true", help="the tables alone")
    parser.add_argument(
        "--quick", action="store_true", help="small pictures and meshes, to see that all works"
    )
    options = parser.parse_args()
    if not options.tetralux:
        sys.exit("projection.py: --tetralux must name the command-line tool")
    options.sizes = [int(size) for size in options.sizes.split(",")]
    if options.quick:
        options.size, options.sizes, options.rounds = 64, [64], 1
    return options


def main():
    options = parse_arguments()
    os.makedirs(options.output, exist_ok=True)
    fin = None
    grid = read_blunt_fin()
    if grid:
        mesh = split_by_vtk(grid)
        fin = Scene(mesh, "Density", BLUNT_FIN_POSITION, BLUNT_FIN_FOCUS, BLUNT_FIN_NODES)
    sink = generate(options.tetralux, "heat-sink")

    page = Page(
        options.output,
        "Projected tetrahedra without artifacts",
        "vtkTetrahedraProjectionMapper beside the paper it is after: M. Kraus, W. Qiao and D. S. "
        "Ebert, Projecting Tetrahedra without Rendering Artifacts, IEEE Visualization 2004. Errors "
        "are against vtkTetrahedraRayCastMapper in double precision.",
    )
    if fin:
        add_costs(page, fin, options)
    scenes = [("heat sink", make_scene(sink, 1, SMOOTH))]
    scenes += [("blunt fin", fin)] if fin else []
    if options.quick:
        cylinder = make_tapered_cylinder(around=16, along=4, layers=8)
        body = make_graded_body(side=4, layers=10)
    else:
        cylinder, body = make_tapered_cylinder(), make_graded_body()
    scenes += [
        ("cylinder", make_scene(cylinder, 1, SMOOTH, distance=0.6)),
        ("body", make_scene(body, 1, SMOOTH, distance=0.35)),
    ]
    approximated = scenes.copy()
    balls = (8,) if options.quick else (16, 34, 74) + ((159,) if options.large else ())
    for cells in balls:
        ball = generate(options.tetralux, "ball", "--cells", str(cells))
        scenes.append((f"ball of {ball.GetNumberOfCells()}", make_scene(ball, 1, SMOOTH)))
    add_speeds(page, scenes, options)
    add_approximations(page, approximated, options)
    if not options.no_figures:
        add_figures(page, options, fin, sink)
    page.write()


if __name__ == "__main__":
    main()
