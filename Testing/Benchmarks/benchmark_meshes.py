# SPDX-License-Identifier: BSD-3-Clause
"""Meshes that the benchmarks in Python measure on."""

import itertools
import os
import subprocess
import tempfile

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import (
    VTK_TETRA,
    vtkCellArray,
    vtkImageData,
    vtkUnstructuredGrid,
)
from vtkmodules.vtkFiltersGeneral import vtkDataSetTriangleFilter
from vtkmodules.vtkIOParallel import vtkMultiBlockPLOT3DReader
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader


def read_blunt_fin():
    """The structured grid of the NASA blunt fin with its density, or None without TETRALUX_DATA."""
    folder = os.environ.get("TETRALUX_DATA")
    if not folder:
        return None
    reader = vtkMultiBlockPLOT3DReader()
    reader.SetXYZFileName(os.path.join(folder, "bluntfinxyz.bin"))
    reader.SetQFileName(os.path.join(folder, "bluntfinq.bin"))
    reader.SetScalarFunctionNumber(100)
    reader.Update()
    grid = reader.GetOutput().GetBlock(0)
    grid.GetPointData().SetActiveScalars("Density")
    return grid


def split_by_vtk(grid):
    """Tetrahedra by VTK's own filter: its mappers take nothing else."""
    tetrahedra = vtkDataSetTriangleFilter()
    tetrahedra.SetInputData(grid)
    tetrahedra.TetrahedraOnlyOn()
    tetrahedra.Update()
    return tetrahedra.GetOutput()


def generate(tool, name, *options):
    """A mesh that the command-line tool makes, with a field of its points as scalars."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "mesh.vtu")
        subprocess.run([tool, "generate", name, *options, "--output", path], check=True)
        reader = vtkXMLUnstructuredGridReader()
        reader.SetFileName(path)
        reader.Update()
        return reader.GetOutput()


def make_lattice(tetrahedra, aspect=1):
    """A cube of about as many tetrahedra, in voxels of five each.

    aspect: voxels along z over those along x and y.
    """
    n = max(1, round((tetrahedra / 5 / aspect) ** (1 / 3)))
    counts = (n, n, max(1, round(n * aspect)))
    image = vtkImageData()
    image.SetDimensions(*(count + 1 for count in counts))
    image.SetSpacing(*(1 / count for count in counts))
    x, y, z = (numpy.linspace(0, 1, count + 1) for count in counts)
    field = (
        numpy.sin(7 * x)[None, None, :]
        + numpy.cos(5 * y)[None, :, None] * numpy.sin(9 * z)[:, None, None]
    )
    array = numpy_to_vtk(field.ravel(), deep=True)
    array.SetName("Field")
    image.GetPointData().SetScalars(array)
    return image


def make_grid(points, cells, field):
    """Tetrahedra with the scalars Field at their points."""
    grid = vtkUnstructuredGrid()
    locations = vtkPoints()
    locations.SetDataTypeToDouble()
    locations.SetData(numpy_to_vtk(points, deep=True))
    grid.SetPoints(locations)
    connectivity = vtkCellArray()
    offsets = numpy.arange(len(cells) + 1, dtype=numpy.int64) * 4
    connectivity.SetData(
        numpy_to_vtkIdTypeArray(offsets, deep=True),
        numpy_to_vtkIdTypeArray(cells.ravel().astype(numpy.int64), deep=True),
    )
    grid.SetCells(VTK_TETRA, connectivity)
    array = numpy_to_vtk(field, deep=True)
    array.SetName("Field")
    grid.GetPointData().SetScalars(array)
    return grid


def make_cube(tetrahedra):
    """A cube of about as many tetrahedra, six in each of its voxels."""
    n = max(1, round((tetrahedra / 6) ** (1 / 3)))
    place = numpy.linspace(0, 1, n + 1)
    z, y, x = numpy.meshgrid(place, place, place, indexing="ij")
    points = numpy.stack([x, y, z], axis=-1).reshape(-1, 3)
    index = numpy.arange(n)
    k, j, i = numpy.meshgrid(index, index, index, indexing="ij")
    first = ((k * (n + 1) + j) * (n + 1) + i).ravel()
    steps = (1, n + 1, (n + 1) ** 2)
    cells = []
    # From one corner to the opposite one along three edges, in each order.
    for a, b, c in itertools.permutations(steps):
        cells.append(numpy.stack([first, first + a, first + a + b, first + a + b + c], axis=1))
    field = numpy.sin(7 * x) + numpy.cos(5 * y) * numpy.sin(9 * z)
    return make_grid(points, numpy.concatenate(cells), field.ravel())


def make_layers(points, triangles, field):
    """Tetrahedra between layers of the same triangles, three of each prism.

    points: of each layer, the first one at the wall. triangles: rows of places of points in a
    layer, counterclockwise from outside. field: of each point.
    """
    # By ascending places, so that neighbours cut their common face the same way.
    rising = numpy.sort(triangles, axis=1)
    turns = numpy.take_along_axis(triangles, (triangles.argmin(axis=1)[:, None] + 1) % 3, axis=1)
    is_even = turns[:, 0] == rising[:, 1]
    a, b, c = rising.T
    size = points.shape[1]
    split = numpy.stack(
        [(a, b, c, c + size), (a, b, b + size, c + size), (a, a + size, b + size, c + size)]
    ).transpose(2, 0, 1)
    split[is_even, 1] = split[is_even, 1][:, (1, 0, 2, 3)]
    split[~is_even, 0] = split[~is_even, 0][:, (1, 0, 2, 3)]
    split[~is_even, 2] = split[~is_even, 2][:, (1, 0, 2, 3)]
    layers = numpy.arange(len(points) - 1) * size
    cells = (split.reshape(-1, 4)[None] + layers[:, None, None]).reshape(-1, 4)

    return make_grid(points.reshape(-1, 3), cells, field.ravel())


def grow(count, ratio):
    """From 0 to 1 in steps, each longer than the one before, the last one ratio times the first."""
    steps = ratio ** (numpy.arange(count) / (count - 1))
    return numpy.concatenate([[0], numpy.cumsum(steps)]) / steps.sum()


def make_tapered_cylinder(around=56, along=31, layers=60):
    """The flow around a cylinder that gets thinner, as large as NASA's: 624,960 tetrahedra.

    Layers grow from the wall outwards, 1000 : 1.
    """
    place = numpy.arange(around * (along + 1))
    angle = 2 * numpy.pi * (place % around) / around
    height = 12 * (place // around) / along
    wall = 0.75 - 0.25 * height / 12
    radius = wall + (10 - wall) * grow(layers, 1000)[:, None]
    x, y = radius * numpy.cos(angle), radius * numpy.sin(angle)
    points = numpy.stack([x, y, numpy.broadcast_to(height, x.shape)], -1)
    field = x * (1 + (wall / radius) ** 2) + numpy.sin(2 * y + height) / radius

    place = numpy.arange(around * along)
    right = place // around * around + (place + 1) % around
    triangles = numpy.concatenate(
        [
            numpy.stack([place, right, right + around], axis=1),
            numpy.stack([place, right + around, place + around], axis=1),
        ]
    )
    return make_layers(points, triangles, field)


def make_graded_body(side=30, layers=60, ratio=1e5):
    """The flow around a flat body, as large as NASA's X38: 1,944,000 tetrahedra.

    Layers grow from the body's wall outwards, so that the longest edge of the mesh is about ratio
    times as long as its shortest. side: quadrilaterals along an edge of the cube that each layer is
    made from.
    """
    index = numpy.arange(side + 1)
    lattice = numpy.stack(numpy.meshgrid(index, index, index, indexing="ij"), -1).reshape(-1, 3)
    on_surface = ((lattice == 0) | (lattice == side)).any(axis=1)
    place = numpy.full(len(lattice), -1)
    place[on_surface] = numpy.arange(on_surface.sum())
    cube = numpy.tan(numpy.pi / 4 * (2 * lattice[on_surface] / side - 1))  # even angles
    direction = cube / numpy.linalg.norm(cube, axis=1, keepdims=True)
    wall = 1 / numpy.linalg.norm(direction / (2, 0.5, 0.8), axis=1)  # an ellipsoid
    radius = wall + (10 - wall) * grow(layers, ratio)[:, None]
    points = radius[:, :, None] * direction
    # Something like a pressure: high at the nose, low on the sides, and waves.
    near = (wall / radius) ** 2
    field = near * (2.25 * direction[:, 0] ** 2 - 1.25) + 0.1 * numpy.sin(3 * points[:, :, 0])

    triangles = []
    u, v = (part.ravel() for part in numpy.meshgrid(index[:-1], index[:-1], indexing="ij"))
    for axis in range(3):
        for end in (0, side):
            corners = []
            for du, dv in ((0, 0), (1, 0), (1, 1), (0, 1)):
                at = [None] * 3
                at[axis], at[(axis + 1) % 3], at[(axis + 2) % 3] = end, u + du, v + dv
                corners.append(place[(at[0] * (side + 1) + at[1]) * (side + 1) + at[2]])
            order = ((0, 1, 2), (0, 2, 3)) if end else ((0, 2, 1), (0, 3, 2))
            triangles += [numpy.stack([corners[k] for k in three], axis=1) for three in order]
    return make_layers(points, numpy.concatenate(triangles), field)
