# SPDX-License-Identifier: BSD-3-Clause
"""Damaged files of every format that the tool reads: each run ends with status 0 or 1, at most one
line of an error, and nothing left.

The environment variable TETRALUX_DAMAGED_FILES sets how many files are tried, and
TETRALUX_DAMAGE_SEED the seed of the first; each has the next one's. The seeds of files that crash
or hang their readers are printed, and of those that fail.
"""

import collections
import concurrent.futures
import os
import random
import re
import resource
import shutil
import subprocess
import sys

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkPoints
from vtkmodules.vtkCommonDataModel import (
    vtkImageData, vtkMultiBlockDataSet, vtkRectilinearGrid, vtkStructuredGrid,
)
from vtkmodules.vtkIOLegacy import vtkDataSetWriter
from vtkmodules.vtkIOParallelXML import vtkXMLPDataSetWriter
from vtkmodules.vtkIOXML import vtkXMLDataSetWriter, vtkXMLMultiBlockDataWriter

import tool
from formats import FormatFiles, make_cube
from tool import TOOL, ToolTest

ROUNDS = int(os.environ.get("TETRALUX_DAMAGED_FILES", "250"))
SEED = int(os.environ.get("TETRALUX_DAMAGE_SEED", "1"))

# Bytes of memory that a reader may ask for: more would slow down everything else on the machine.
LARGEST_MEMORY = 8 << 30

# Seconds in which a run must end. A reader that hangs is stopped long before.
LONGEST_RUN = 600

# Seconds of processor time after which a reader that does not get on counts as one that hangs.
PATIENCE = "0.7"

# Points along an edge of the grids.
EDGE = 4


def limit_memory():
    resource.setrlimit(resource.RLIMIT_AS, (LARGEST_MEMORY, LARGEST_MEMORY))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def add_field(grid):
    values = numpy_to_vtk(numpy.arange(EDGE**3, dtype=float), deep=True)
    values.SetName("s")  # VTK 9.1 crashes at "Field" in legacy files of structured grids
    grid.GetPointData().SetScalars(values)
    return grid


def make_grids():
    """A grid of each kind, by the extension of its XML file."""
    image = vtkImageData()
    image.SetDimensions(EDGE, EDGE, EDGE)
    axis = vtkDoubleArray()
    points = vtkPoints()
    for i in range(EDGE**3):
        points.InsertNextPoint(i % EDGE, i // EDGE % EDGE, i // EDGE**2)
        if i < EDGE:
            axis.InsertNextValue(i)
    rectilinear = vtkRectilinearGrid()
    rectilinear.SetDimensions(EDGE, EDGE, EDGE)
    rectilinear.SetXCoordinates(axis)
    rectilinear.SetYCoordinates(axis)
    rectilinear.SetZCoordinates(axis)
    structured = vtkStructuredGrid()
    structured.SetDimensions(EDGE, EDGE, EDGE)
    structured.SetPoints(points)
    grids = {"vti": image, "vtr": rectilinear, "vts": structured}
    for grid in grids.values():
        add_field(grid)
    grids["vtu"] = make_cube()
    return grids


class Mutator:
    """Changes the bytes of a file at random."""

    def __init__(self, generator):
        self.random = generator

    def mutate(self, data):
        for _ in range(self.random.choice((1, 1, 1, 2, 4, 8))):
            kinds = [self.flip, self.cut, self.drop, self.repeat, self.blank]
            if b"\0" not in data[:4096]:
                kinds += 3 * [self.change_number]
            data = self.random.choice(kinds)(data)
        return data

    def span(self, data):
        begin = self.random.randrange(len(data) + 1)
        return begin, min(len(data), begin + self.random.choice((1, 2, 4, 8, 64, 512)))

    def flip(self, data):
        if not data:
            return data
        at = self.random.randrange(len(data))
        return data[:at] + bytes([data[at] ^ 1 << self.random.randrange(8)]) + data[at + 1:]

    def cut(self, data):
        return data[:self.random.randrange(len(data) + 1)]

    def drop(self, data):
        begin, end = self.span(data)
        return data[:begin] + data[end:]

    def repeat(self, data):
        begin, end = self.span(data)
        return data[:end] + data[begin:]

    def blank(self, data):
        begin, end = self.span(data)
        return data[:begin] + bytes([self.random.choice((0, 255, 48))]) * (end - begin) + data[end:]

    def change_number(self, data):
        numbers = list(re.finditer(rb"-?\d+", data))
        if not numbers:
            return data
        chosen = self.random.choice(numbers)
        number = self.random.choice(
            (b"0", b"-1", b"1", b"7", b"1000000", b"2147483647", b"4294967296", b"-2147483648",
             b"9223372036854775807", b"1e300", b"nan", b"x")
        )
        return data[:chosen.start()] + number + data[chosen.end():]


class Fuzz(FormatFiles, ToolTest):
    def write_vtk_files(self):
        for extension, grid in make_grids().items():
            for binary in (False, True):
                form = "b" if binary else "t"
                writer = vtkXMLDataSetWriter()
                writer.SetFileName(self.path(f"{form}.{extension}"))
                writer.SetInputData(grid)
                if not binary:
                    writer.SetDataModeToAscii()
                writer.SetCompressorTypeToZLib()
                writer.Write()
                writer = vtkDataSetWriter()
                writer.SetInputData(grid)
                if binary:
                    writer.SetFileTypeToBinary()
                writer.SetFileName(self.path(f"{form}-{extension}.vtk"))
                writer.Write()
            pieces = vtkXMLPDataSetWriter()
            pieces.SetFileName(self.path(f"p.p{extension}"))
            pieces.SetInputData(grid)
            pieces.SetNumberOfPieces(1)
            pieces.Write()
        blocks = vtkMultiBlockDataSet()
        blocks.SetBlock(0, make_cube())
        blocks.SetBlock(1, make_cube(1))
        writer = vtkXMLMultiBlockDataWriter()
        writer.SetFileName(self.path("m.vtm"))
        writer.SetInputData(blocks)
        writer.Write()

    def write_bytes(self, name, *parts):
        with open(self.path(name), "wb") as file:
            for part in parts:
                file.write(part if isinstance(part, bytes) else part.tobytes())

    def write_volumes(self):
        size = f"{EDGE} {EDGE} {EDGE}"
        header = f"NRRD0004\ntype: uchar\ndimension: 3\nsizes: {size}\nencoding: raw\n"
        voxels = numpy.arange(EDGE**3, dtype="u1")
        self.write_bytes("a.nrrd", header.encode(), b"\n", voxels)
        self.write("a.nhdr", header + "data file: a.raw\n")
        self.write_bytes("a.raw", voxels)
        self.write_bytes(
            "a.slc",
            f"11111 {size} 8 1 1 1 0 0 0 0 1 1 X".encode(), bytes(3), voxels,
        )

    def write_plot3d(self):
        size = numpy.array([EDGE, EDGE, EDGE], ">i4")
        axes = numpy.indices((EDGE, EDGE, EDGE)).astype(">f4")[::-1]
        self.write_bytes("a.xyz", size, axes)
        self.write_bytes("a.q", size, numpy.ones(4, ">f4"), numpy.ones(5 * EDGE**3, ">f4"))

    def write_all(self):
        """Writes a file of each format. Returns groups: what is read, and what it is made of."""
        self.write_vtk_files()
        self.write_volumes()
        self.write_plot3d()
        self.write_text_formats()
        self.write_vtkhdf()
        self.write_cgns()
        self.write_open_foam()
        self.write_series()
        self.write_cube("cube.e")
        together = {
            "a.case": ["a.case", "a.geo", "a.Field"], "a.nhdr": ["a.nhdr", "a.raw"],
            "a.xyz,a.q": ["a.xyz", "a.q"], "a.pvd": ["a.pvd", "a0.vtu"],
            "a.vtu.series": ["a.vtu.series", "a0.vtu"], "m.vtm": ["m.vtm", "m/m_0.vtu"],
            "a.foam": [
                "system/controlDict", "constant/polyMesh/points", "constant/polyMesh/faces",
                "constant/polyMesh/owner", "constant/polyMesh/neighbour",
                "constant/polyMesh/boundary", "0/T",
            ],
        }
        for extension in make_grids():
            together[f"p.p{extension}"] = [f"p.p{extension}", f"p_0.{extension}"]
        parts = {part for group in together.values() for part in group} | {"a.q", "a.raw", "a.foam"}
        single = [
            name for name in sorted(self.files())
            if os.path.isfile(self.path(name)) and name not in parts and not name.startswith("a1")
            and not name.startswith("a2")
        ]
        groups = [(name, [name]) for name in single] + list(together.items())
        # Both files of Fluent have extensions that others have, too.
        os.mkdir(self.path("fluent"))
        scratch, self.folder = self.folder, self.path("fluent")
        self.write_fluent()
        self.folder = scratch
        groups.append(("fluent/a.cas", ["fluent/a.cas"]))
        return groups

    def run_damaged(self, seed, group):
        """Tries one file. Returns its kind of end, and what is wrong with it or nothing."""
        name, files = group
        generator = random.Random(seed)
        folder = self.path(f"case-{seed}")
        shutil.copytree(self.original, folder)
        damaged = os.path.join(folder, generator.choice(files))
        with open(damaged, "rb") as file:
            data = file.read()
        with open(damaged, "wb") as file:
            file.write(Mutator(generator).mutate(data))
        arguments = ["info", name]
        if generator.randrange(4) == 0:
            arguments = ["render", name, "--method", "ray-cast", "--size", "8,8",
                         "--output", "out.png"]
        before = self.list_all(folder)
        try:
            result = subprocess.run(
                [TOOL, *arguments], cwd=folder, capture_output=True, timeout=LONGEST_RUN,
                check=False, preexec_fn=limit_memory,
                env={**os.environ, "TETRALUX_READER_PATIENCE": PATIENCE},
            )
        except subprocess.TimeoutExpired:
            return "timeout", f"{name}: it does not end"
        allowed = {"out.png"} if result.returncode == 0 else set()
        left = self.list_all(folder) - before - allowed
        shutil.rmtree(folder)
        said = result.stderr.decode(errors="replace").splitlines()
        errors = [line for line in said if not re.match("tetralux: (warning|note): ", line)]
        wrong = []
        if result.returncode not in (0, 1):
            wrong.append(f"status {result.returncode}")
        if len(errors) != result.returncode or any("tetralux: " not in line for line in errors):
            wrong.append("not one line")
        if "the work has crashed" in str(errors):
            wrong.append("a crash outside of its reader")
        if left:
            wrong.append(f"left: {left}")
        text = " ".join(errors)
        kind = (
            "crash" if "has crashed" in text or "ended" in text
            else "hang" if "without getting on" in text
            else f"status {result.returncode}"
        )
        return kind, f"{name}: {', '.join(wrong)}: {said}" if wrong else ""

    def list_all(self, folder):
        return {
            os.path.join(where, name)[len(folder) + 1:]
            for where, _, names in os.walk(folder) for name in names
        }

    def test_damaged_files(self):
        groups = self.write_all()
        self.original = self.path("original")
        names = self.files()
        os.mkdir(self.original)
        for name in names:
            shutil.move(self.path(name), self.original)
        for name, _ in groups:
            with self.subTest(name=name):
                self.assertIn("bounds", self.succeed("info", os.path.join("original", name))
                              if "," not in name else "bounds")
        kinds = collections.Counter()
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            seeds = range(SEED, SEED + ROUNDS)
            results = pool.map(
                lambda seed: self.run_damaged(seed, groups[seed % len(groups)]), seeds
            )
            for seed, (kind, wrong) in zip(seeds, results):
                kinds[kind] += 1
                if kind in ("crash", "hang") or wrong:
                    print(f"seed {seed}: {groups[seed % len(groups)][0]}: {kind}: {wrong}",
                          file=sys.stderr)
                with self.subTest(seed=seed):
                    self.assertEqual(wrong, "")
        print(f"seeds {SEED} to {SEED + ROUNDS - 1}: {dict(kinds)}", file=sys.stderr)

    def test_a_warning_for_each_cell(self):
        # The file has six faces of one cell; one says that its cell is the millionth. VTK's reader
        # warns of each cell without faces.
        self.write_open_foam()
        owners = "6\n(\n0\n0\n1000000\n0\n0\n0\n)"
        self.write_foam("constant/polyMesh/owner", "labelList", owners)
        result = self.run_tool("info", "a.foam")
        self.assertIn(result.returncode, (0, 1), result.stderr)
        self.assertLess(len(result.stderr.splitlines()), 30, result.stderr[:2000])


if __name__ == "__main__":
    tool.main()
