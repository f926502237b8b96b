#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Isosurfaces by an implicit hierarchy: the numbers of the paper, and the same made anew.

    TETRALUX_DATA=FOLDER PYTHONPATH=build/lib/python3.11/dist-packages \
        python3 Testing/Benchmarks/isosurface_study.py [--program build/bin/IsosurfaceStudy] \
        [--tetralux build/bin/tetralux] [--output Documentation/isosurfaces] [--memory 4]

Tables 1 to 4 and figure 8 of Wald, Friedrich, Knoll and Hansen, Interactive Isosurface Ray Tracing
of Time-Varying Tetrahedral Volumes (2007), beside what the program IsosurfaceStudy measures here on
meshes as large as those of the paper, or on the same one: the blunt fin. Besides, speed over
threads and pixels (section 8.2), and what each effect costs. Times are of pictures in memory,
medians of frames that the cases draw by turns.

Writes study.csv, one row for each number, and index.html with the pictures of figure 8, to FOLDER.
Leaves out the blunt fin and the reactor flow without TETRALUX_DATA. --from-csv makes the page anew
of a study.csv that is there. --memory: gigabytes that the copies of table 3 may take.
"""

import argparse
import csv
import io
import math
import os
import platform
import shutil
import subprocess
import sys

import tetralux
from benchmark_meshes import generate
from benchmark_page import Page
from benchmark_scene import VolumeWindow
from benchmark_tables import write_csv
from vtkmodules.vtkCommonDataModel import vtkPiecewiseFunction
from vtkmodules.vtkRenderingCore import (
    vtkColorTransferFunction,
    vtkLight,
    vtkVolumeProperty,
)

BUCKY = "swinging ball"
FIN = "blunt fin"
REACTOR = "reactor flow"

# Argument of the program, isovalue and second isovalue. The first ones stand for the paper's data
# sets in PAPER, about as large.
GENERATED = {
    "ball": ("ball:cells=39", 0.5, 0.3),
    "heat sink": ("heat-sink", 0.35, 0.5),
    BUCKY: ("swinging-ball:cells=41,time=0.25", 0.5, 0.3),
    "large ring": ("ring:around=600,across=32", 0.5, 0.3),
    "ring": ("ring", 0.5, 0.3),
}
QUICK = {
    "ball": ("ball:cells=8", 0.5, 0.3),
    BUCKY: ("swinging-ball:cells=8,time=0.25", 0.5, 0.3),
}

# The paper's data set of each mesh: tables 1 and 2. Frames a second by BIH and SAH, milliseconds of
# both builds, frames a second on a laptop, a desktop and a workstation of 16 cores.
PAPER = {
    "ball": ("ell32p", 148955, 27.0, 26.3, 46, 2432, 14.2, 29.4, 95),
    "heat sink": ("feok", 121668, 23.6, 23.6, 42, 1854, 12.6, 25.9, 93),
    BUCKY: ("bucky", 224874, 18.8, 18.9, 61, 2932, 13.3, 27.3, 90),
    FIN: ("blunt", 176856, 28.4, 28.5, 87, 3887, 18.9, 45.5, 94),
    "large ring": ("fusion", 3000000, 11.47, 12.13, 1495, 70689, 3.3, 8.47, 26.1),
}

# Copies along each axis: tetrahedra and frames a second on four cores.
TABLE_3 = {
    1: ("177k", 34),
    2: ("1.4m", 13.5),
    4: ("11.3m", 5.0),
    8: ("90.4m", 1.8),
    16: ("724m", 0.66),
}

# Of each mesh: 2 x 2 and 16 x 16 rays. Millions, of extractions thousands.
TABLE_4 = {
    "ray-box tests, millions": {
        FIN: (48.05, 0.94), BUCKY: (93.84, 1.8), "ball": (56.75, 1.11),
        "heat sink": (57.42, 1.10), "large ring": (175.83, 4.32),
    },
    "ray-isopolygon tests, millions": {
        FIN: (8.90, 3.19), BUCKY: (13.52, 4.42), "ball": (8.0, 3.39),
        "heat sink": (12.45, 3.86), "large ring": (29.35, 16.47),
    },
    "isorange tests of packets, millions": {
        FIN: (76.75, 1.45), BUCKY: (152.31, 2.84), "ball": (99.89, 1.88),
        "heat sink": (95.96, 1.79), "large ring": (279.75, 6.48),
    },
    "isopolygon extractions, thousands": {
        FIN: (2216, 69), BUCKY: (354, 10), "ball": (1908, 66),
        "heat sink": (4436, 109), "large ring": (7285, 296),
    },
}
# What the program counts for each of them, and the unit.
COUNTERS = {
    "ray-box tests, millions": (("ray_box_tests",), 1e6),
    "ray-isopolygon tests, millions": (("ray_polygon_tests",), 1e6),
    "isorange tests of packets, millions": (("node_range_tests", "cell_range_tests"), 1e6),
    "isopolygon extractions, thousands": (("extractions",), 1e3),
}
SMALL_PACKETS = "2x2 without II to IV"
LARGE_PACKETS = "16x16"

# Frames a second of figure 8 on a laptop and on a workstation.
FIGURE_8 = (
    ("a: one surface", 15.6, 90),
    ("b: with shadows", 10.2, 70),
    ("c: with a second surface and a clip box", 5.4, 42),
    ("d: with transparency", 2.6, 19),
)

ALL_PARTS = ("build", "frames", "traversal", "effects", "costs", "threads", "pixels")
PARTS = {BUCKY: (*ALL_PARTS, "copies"), FIN: ALL_PARTS}
OTHER_PARTS = ("build", "frames", "traversal")

# As in Testing/Benchmarks/Isosurfaces/StudyCase.cxx.
FORWARD = (-6 / 11, -6 / 11, -7 / 11)
RIGHT = (9 / 11, -2 / 11, -6 / 11)
UP = (2 / 11, -9 / 11, 6 / 11)
LIGHT_DISTANCE = 3  # radii
ZOOM = 1.2  # 1 shows the whole bounding sphere
COLORS = ((1, 0.9, 0.8), (0.4, 0.6, 1))
ALL_BUT_UPPER_CORNER = 0x3FFFFFF
PAPER_LAYERS = 2


def list_meshes(options):
    """Argument of the program, isovalues, array of points."""
    meshes = dict(QUICK if options.quick else GENERATED)
    folder = os.environ.get("TETRALUX_DATA")
    if folder:
        fin = ",".join(os.path.join(folder, f"bluntfin{part}.bin") for part in ("xyz", "q"))
        meshes[FIN] = (fin, 1, 1.6, "Density")
        meshes[REACTOR] = (os.path.join(folder, "disk_out_ref.ex2"), 600, 400, "Temp")
    return meshes


def measure(options, name, mesh, isovalue, second, array=""):
    command = [
        options.program, mesh, "--isovalue", str(isovalue), "--second-isovalue", str(second),
        "--frames", str(options.frames), "--size", str(options.size),
        "--memory", str(options.memory), "--zoom", str(ZOOM),
        "--parts", ",".join(PARTS.get(name, OTHER_PARTS)),
    ]  # fmt: skip
    if array:
        command += ["--array", array]
    if options.threads:
        command += ["--threads", str(options.threads)]
    output = subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout
    return [{**row, "mesh": name} for row in csv.DictReader(io.StringIO(output))]


class Numbers:
    """What was measured, by mesh, part, case and quantity."""

    def __init__(self, rows):
        self.rows = rows
        self.meshes = list(dict.fromkeys(row["mesh"] for row in rows))
        self.threads = max(int(row["threads"]) for row in rows)

    def find(self, mesh, part):
        return [row for row in self.rows if row["mesh"] == mesh and row["part"] == part]

    def list_cases(self, mesh, part):
        return list(dict.fromkeys(row["case"] for row in self.find(mesh, part)))

    def get(self, mesh, part, case, quantity, threads=None):
        """The number, or None. threads: of several rows with different ones."""
        for row in self.find(mesh, part):
            if (row["case"], row["quantity"]) == (case, quantity):
                if threads in (None, int(row["threads"])):
                    return float(row["value"])
        return None

    def count_tetrahedra(self, mesh):
        return int(self.find(mesh, "frames")[0]["tetrahedra"])


def show(value, digits=3):
    """A number with some digits, of which none is written after those of a large whole one."""
    if value is None:
        return ""
    if value == 0:
        return "0"
    decimals = max(0, digits - 1 - math.floor(math.log10(abs(value))))
    return f"{value:,.{decimals}f}"


def divide(a, b):
    return None if a is None or not b else a / b


def add_builds(page, numbers):
    rows = []
    for mesh in numbers.meshes:
        paper = PAPER.get(mesh)
        for index, build in enumerate(("BIH", "SAH")):
            leaves = f"{build}, leaves of 8"
            frames = [
                numbers.get(mesh, "build", f"{build}, {way}", "frames_per_second")
                for way in ("precomputed", "on the fly")
            ]
            milliseconds = [
                numbers.get(mesh, "build", leaves, "build_milliseconds", threads)
                for threads in (1, numbers.threads)
            ]
            rows.append(
                (
                    mesh,
                    f"{numbers.count_tetrahedra(mesh):,}",
                    build,
                    *(show(value) for value in (*milliseconds, *frames)),
                    *(
                        (paper[0], f"{paper[1]:,}", str(paper[4 + index]), str(paper[2 + index]))
                        if paper
                        else [""] * 4
                    ),
                )
            )
    page.add_section(
        "Both builds (table 1)",
        "BIH divides at spatial medians, SAH by the surface area heuristic; here among 15 planes "
        "along each axis, in the paper by a sweep over all cells.",
        columns=(
            "data set", "tetrahedra", "build", "ms, one thread", f"ms, {numbers.threads} threads",
            "fps, precomputed", "fps, on the fly", "of the paper", "tetrahedra", "ms", "fps",
        ),
        rows=rows,
        notes=("The paper built on one core and rendered on four, by isopolygons on the fly.",),
    )  # fmt: skip

    rows = []
    for mesh in numbers.meshes:
        for build in ("BIH", "SAH"):
            for leaf in (4, 8, 12, 16):
                case = f"{build}, leaves of {leaf}"
                counts = [
                    numbers.get(mesh, "build", case, quantity)
                    for quantity in (
                        "ray_box_tests", "node_range_tests", "cell_range_tests", "extractions",
                        "ray_polygon_tests",
                    )
                ]  # fmt: skip
                milliseconds = numbers.get(mesh, "build", case, "build_milliseconds", 1)
                nodes = numbers.get(mesh, "build", case, "nodes")
                rows.append((mesh, case, *(show(v) for v in (milliseconds, nodes, *counts))))
    page.add_section(
        "Sizes of leaves",
        "The paper found 12 cells best; the tracer's leaves hold up to 8. What sizes are worth is "
        "counted by the paper's traversal in packets of 16 x 16 rays.",
        level=3,
        columns=(
            "data set", "build", "ms, one thread", "nodes", "ray-box tests",
            "isorange tests of nodes", "of cells", "extractions", "ray-isopolygon tests",
        ),
        rows=rows,
    )  # fmt: skip


def add_frames(page, numbers):
    rows = []
    for mesh in numbers.meshes:
        paper = PAPER.get(mesh)
        frames = [
            numbers.get(mesh, "frames", way, "frames_per_second")
            for way in ("precomputed", "on the fly")
        ]
        hits = numbers.get(mesh, "frames", "precomputed", "hits")
        size = int(numbers.find(mesh, "frames")[0]["size"])
        rows.append(
            (
                mesh,
                f"{numbers.count_tetrahedra(mesh):,}",
                f"{100 * hits / size**2:.0f} %",
                *map(show, frames),
                *((paper[0], *map(str, paper[6:])) if paper else [""] * 4),
            )
        )
    page.add_section(
        "Frames a second (table 2)",
        columns=(
            "data set", "tetrahedra", "covered pixels", "precomputed", "on the fly",
            "of the paper", "laptop, 2 cores", "desktop, 4 cores", "workstation, 16 cores",
        ),
        rows=rows,
    )  # fmt: skip


def add_copies(page, numbers):
    rows = []
    for count, (tetrahedra, frames) in TABLE_3.items():
        name = f"{count}^3"
        measured = [row for row in numbers.find(BUCKY, "copies") if row["case"] == name]
        if measured:
            values = [
                numbers.get(BUCKY, "copies", f"{name}, {way}", "frames_per_second")
                for way in ("precomputed", "on the fly")
            ]
            peak = float(measured[0]["value"]) / 2**30
            own = (f"{int(measured[0]['tetrahedra']):,}", *map(show, values), f"{peak:.1f}")
        else:
            own = ("", "", "", "more than was allowed")
        rows.append((name, *own, tetrahedra, str(frames)))
    page.add_section(
        "Copies without instances (table 3)",
        f"Of the {BUCKY} here, of the bucky ball in the paper, there on four cores.",
        columns=(
            "copies", "tetrahedra", "fps, precomputed", "fps, on the fly", "gigabytes at most",
            "tetrahedra of the paper", "fps of the paper",
        ),
        rows=rows,
    )  # fmt: skip


def share(numbers, mesh, case, what):
    ratio = divide(
        numbers.get(mesh, "traversal", case, f"{what}_frustum_misses"),
        numbers.get(mesh, "traversal", case, f"{what}_frustum_tests"),
    )
    return "" if ratio is None else f"{100 * ratio:.0f} %"


def add_traversal(page, numbers):
    rows = []
    for title, papers in TABLE_4.items():
        quantities, unit = COUNTERS[title]

        def count(mesh, case, quantities=quantities, unit=unit):
            values = [numbers.get(mesh, "traversal", case, q) for q in quantities]
            known = [value for value in values if value is not None]
            return sum(known) / unit if known else None

        for mesh in numbers.meshes:
            small, large = (count(mesh, case) for case in (SMALL_PACKETS, LARGE_PACKETS))
            own = [count(mesh, f"tracer, {way}") for way in ("precomputed", "on the fly")]
            paper = papers.get(mesh, (None, None))
            rows.append(
                (
                    title, mesh, show(small), show(large), show(divide(small, large)),
                    *map(show, own), *("" if number is None else str(number) for number in paper),
                    show(divide(*paper)),
                )  # fmt: skip
            )
    page.add_section(
        "What packets do (table 4)",
        "The paper's traversal with its ideas I to V (section 5.2), made anew to count: packets of "
        "2 x 2 rays without II to IV, each ray tested against each box, and of 16 x 16 with all. "
        "Beside it the tracer of this project, which tests packets against boxes but no ray.",
        columns=(
            "", "data set", "2 x 2", "16 x 16", "ratio", "tracer, precomputed",
            "tracer, on the fly", "2 x 2, paper", "16 x 16, paper", "ratio, paper",
        ),
        rows=rows,
        notes=(
            "The tracer counts whole chunks of rays, and no isorange tests of cells.",
            "The copy of the paper at hand has 6429 thousand extractions for ell32p; that is not "
            "its ratio of 29, by which 66 are meant.",
        ),
    )  # fmt: skip

    rows = []
    for mesh in numbers.meshes:
        for case in numbers.list_cases(mesh, "traversal"):
            values = [
                numbers.get(mesh, "traversal", case, quantity)
                for quantity in (
                    "packets", "ray_box_tests", "ray_polygon_tests", "node_range_tests",
                    "cell_range_tests", "extractions", "hits",
                )
            ]  # fmt: skip
            rejected = [share(numbers, mesh, case, what) for what in ("box", "polygon")]
            rows.append((mesh, case, *map(show, values[:-1]), *rejected, f"{values[-1]:,.0f}"))
    page.add_section(
        "Sizes of packets, and each idea left out",
        "I: down to the next node both of whose children hold the isovalue, without a test. II: "
        "down where the first active ray hits. III: frustum tests of boxes and isopolygons. IV: "
        "the first active ray is kept. V: cells of a leaf by their own range.",
        level=3,
        columns=(
            "data set", "packets", "their number", "ray-box tests", "ray-isopolygon tests",
            "isorange tests of nodes", "of cells", "extractions", "boxes rejected by frustum",
            "isopolygons rejected", "rays that hit",
        ),
        rows=rows,
        notes=("The paper has 40 to 60 % of isopolygons rejected (section 4.3).",),
    )  # fmt: skip


def add_effects(page, numbers, figures):
    rows = []
    for mesh in (BUCKY, FIN):
        for case, laptop, workstation in FIGURE_8:
            frames = numbers.get(mesh, "effects", case, "frames_per_second")
            if frames:
                first = numbers.get(mesh, "effects", FIGURE_8[0][0], "frames_per_second")
                rows.append(
                    (
                        mesh, case, show(frames), f"{first / frames:.2f}", str(laptop),
                        f"{FIGURE_8[0][1] / laptop:.2f}", str(workstation),
                        f"{FIGURE_8[0][2] / workstation:.2f}",
                    )  # fmt: skip
                )
    page.add_section(
        "Effects, one after the other (figure 8)",
        figures=figures,
        columns=(
            "data set", "effects", "fps", "time over a", "laptop of the paper, fps", "time over a",
            "workstation, fps", "time over a",
        ),
        rows=rows,
        notes=("The paper's data set is a bucky ball.",),
    )  # fmt: skip


def add_costs(page, numbers):
    rows = []
    for mesh in (BUCKY, FIN):
        cases = numbers.list_cases(mesh, "costs")
        seconds = [1 / numbers.get(mesh, "costs", c, "frames_per_second") for c in cases]
        for case, own in zip(cases, seconds):
            rows.append((mesh, case, show(1000 * own), f"{own / seconds[0]:.2f}"))
    page.add_section(
        "What an effect costs when it is on",
        "One surface with one positional light, and one effect each. Soft shadows and ambient "
        "occlusion: of one frame of four samples.",
        columns=("data set", "effect", "ms", "time over flat"),
        rows=rows,
    )


def add_scaling(page, numbers):
    for part, title, text in (
        ("threads", "Speed over threads (section 8.2)", "The paper: linear in the cores."),
        (
            "pixels",
            "Speed over pixels (section 8.2)",
            "The paper: a quarter of the pixels takes a quarter of the time.",
        ),
    ):
        rows = []
        for mesh in (BUCKY, FIN):
            cases = numbers.list_cases(mesh, part)
            frames = [numbers.get(mesh, part, case, "frames_per_second") for case in cases]
            for case, own in zip(cases, frames):
                rows.append((mesh, case, show(own), show(1000 / own), f"{own / frames[0]:.2f}"))
        page.add_section(
            title, text, columns=("data set", "", "fps", "ms", "speed over the first"), rows=rows
        )


def make_property(surfaces, opacity):
    """surfaces: isovalues."""
    color = vtkColorTransferFunction()
    opacities = vtkPiecewiseFunction()
    volume_property = vtkVolumeProperty()
    for index, value in enumerate(surfaces):
        color.AddRGBPoint(value, *COLORS[index])
        opacities.AddPoint(value, opacity)
        volume_property.GetIsoSurfaceValues().SetValue(index, value)
    volume_property.SetColor(color)
    volume_property.SetScalarOpacity(opacities)
    volume_property.ShadeOn()
    return volume_property


def add_to(center, length, direction):
    return [c + length * d for c, d in zip(center, direction)]


def draw_figure_8(page, data, isovalues, size):
    """Pictures from where the program looks, and their captions."""
    center = data.GetCenter()
    radius = max(
        math.dist(data.GetPoint(point), center) for point in range(data.GetNumberOfPoints())
    )
    figures = []
    for index, (case, _, _) in enumerate(FIGURE_8):
        mapper = tetralux.vtkTetrahedraIsosurfaceMapper()
        mapper.SetInputData(data)
        mapper.AutoAdjustSampleDistancesOff()
        mapper.SmoothShadingOff()
        mapper.SetShadows(index > 0)
        if index > 1:
            mapper.CroppingOn()
            mapper.SetCroppingRegionFlags(ALL_BUT_UPPER_CORNER)
            planes = [plane for c in center for plane in (c - 2 * radius, c)]
            mapper.SetCroppingRegionPlanes(*planes)
        mapper.SetMaximumNumberOfPeels(PAPER_LAYERS if index > 2 else 0)
        surfaces = isovalues if index > 1 else isovalues[:1]
        scene = VolumeWindow(
            mapper, make_property(sorted(surfaces), 0.5 if index > 2 else 1), size, size
        )
        scene.renderer.SetBackground(1, 1, 1)
        distance = radius / ZOOM / math.sin(math.radians(15))
        scene.camera.SetPosition(*add_to(center, -distance, FORWARD))
        scene.camera.SetFocalPoint(*center)
        scene.camera.SetViewUp(*UP)
        scene.camera.SetViewAngle(30)
        scene.renderer.ResetCameraClippingRange()
        light = vtkLight()
        light.SetLightTypeToSceneLight()
        light.PositionalOn()
        light.SetConeAngle(90)
        toward = [(-6 * r + 6 * u - 7 * f) / 11 for r, u, f in zip(RIGHT, UP, FORWARD)]
        light.SetPosition(*add_to(center, LIGHT_DISTANCE * radius, toward))
        light.SetFocalPoint(*center)
        scene.renderer.AddLight(light)
        scene.window.Render()
        picture = tetralux.picture(mapper)[0].astype(float)
        name = f"effects-{case[0]}.png"
        page.write_picture(name, picture[:, :, :3] + (1 - picture[:, :, 3:]))
        figures.append(([name], case))
    return figures


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("--program", default="build/bin/IsosurfaceStudy")
    parser.add_argument(
        "--tetralux", default="build/bin/tetralux", help="the command-line tool"
    )
    parser.add_argument("--output", default="Documentation/isosurfaces", help="folder of the page")
    parser.add_argument("--size", type=int, default=1024, help="pixels along an edge (1024)")
    parser.add_argument("--threads", type=int, default=0, help="at most (0: all)")
    parser.add_argument("--frames", type=int, default=9, help="frames timed of each (9)")
    parser.add_argument("--memory", type=float, default=4, help="gigabytes of copies (4)")
    parser.add_argument("--from-csv", action="store_true", help="the page alone")
    parser.add_argument("--quick", action="store_true", help="small, to see that all works")
    options = parser.parse_args()
    for tool in (options.program, options.tetralux):
        if not shutil.which(tool):
            sys.exit(f"isosurface_study.py: there is no program {tool}")
    if options.quick:
        options.size, options.frames, options.memory = 64, 1, min(options.memory, 0.5)
    return options


def main():
    options = parse_arguments()
    os.makedirs(options.output, exist_ok=True)
    path = os.path.join(options.output, "study.csv")
    if options.from_csv:
        with open(path, newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
    else:
        rows = []
        for name, arguments in list_meshes(options).items():
            print(name, flush=True)
            rows += measure(options, name, *arguments)
        write_csv(path, rows)
    numbers = Numbers(rows)
    size = int(numbers.find(BUCKY, "frames")[0]["size"])
    page = Page(
        options.output,
        "Isosurfaces by an implicit hierarchy",
        "The isosurface tracer beside the paper it is after: I. Wald, H. Friedrich, A. Knoll and "
        "C. D. Hansen, Interactive Isosurface Ray Tracing of Time-Varying Tetrahedral Volumes, "
        "IEEE Visualization 2007. But for the blunt fin, data sets are not the paper's, but "
        "generated ones about as large.",
        f"{size} x {size} pixels, {numbers.threads} threads, {platform.machine()}. Frames in "
        "memory, medians; the paper's are on a screen.",
    )
    mesh = (QUICK if options.quick else GENERATED)[BUCKY]
    name, parameters = mesh[0].split(":")
    arguments = [
        word
        for parameter in parameters.split(",")
        for word in (f"--{parameter.split('=')[0]}", parameter.split("=")[1])
    ]
    data = generate(options.tetralux, name, *arguments)
    figures = draw_figure_8(page, data, mesh[1:3], 64 if options.quick else 320)
    add_builds(page, numbers)
    add_frames(page, numbers)
    add_copies(page, numbers)
    add_traversal(page, numbers)
    add_effects(page, numbers, figures)
    add_costs(page, numbers)
    add_scaling(page, numbers)
    page.write()


if __name__ == "__main__":
    main()
