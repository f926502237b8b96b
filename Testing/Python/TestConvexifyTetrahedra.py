# SPDX-License-Identifier: BSD-3-Clause
"""vtkConvexifyTetrahedra from Python; with real data where TETRALUX_DATA names its folder."""

import os

from vtkmodules.vtkCommonCore import vtkIdList
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkUnstructuredGrid

import tetralux


def convexify(data):
    tetrahedra = tetralux.vtkTetrahedralizeCells()
    tetrahedra.SetInputDataObject(data)
    convexify = tetralux.vtkConvexifyTetrahedra()
    convexify.SetInputConnection(tetrahedra.GetOutputPort())
    convexify.Update()
    return convexify


def check_volumes(convex):
    whole = convex.GetHullVolume()
    assert abs(whole - convex.GetMeshVolume() - convex.GetImaginaryVolume()) <= 1e-9 * whole
    marks = convex.GetOutput().GetCellData().GetArray("Imaginary")
    imaginary = convex.GetNumberOfImaginaryCells()
    real = convex.GetOutput().GetNumberOfCells() - imaginary
    assert imaginary > 0
    assert all(marks.GetValue(i) == (i >= real) for i in range(real + imaginary))


def test_box():
    image = vtkImageData()
    image.SetDimensions(4, 4, 4)
    convex = convexify(image)
    assert convex.GetInputIsConvex()
    assert convex.GetNumberOfImaginaryCells() == 0
    assert convex.GetOutput().GetNumberOfCells() == 5 * 27


def test_box_with_cavity():
    image = vtkImageData()
    image.SetDimensions(4, 4, 4)
    grid = vtkUnstructuredGrid()
    grid.SetPoints(copy_points(image))
    ids = vtkIdList()
    for cell in range(image.GetNumberOfCells()):
        if cell != 13:
            image.GetCellPoints(cell, ids)
            grid.InsertNextCell(image.GetCellType(cell), ids)
    convex = convexify(grid)
    assert not convex.GetInputIsConvex()
    assert abs(convex.GetHullVolume() - 27) < 1e-12
    assert abs(convex.GetImaginaryVolume() - 1) < 1e-12
    assert convex.GetRefusal() == ""
    check_volumes(convex)
    assert "NumberOfImaginaryCells" in str(convex)


def copy_points(image):
    from vtkmodules.vtkCommonCore import vtkPoints

    points = vtkPoints()
    for i in range(image.GetNumberOfPoints()):
        points.InsertNextPoint(image.GetPoint(i))
    return points


def test_blunt_fin(folder):
    from blunt_fin import read_blunt_fin

    convex = convexify(read_blunt_fin(folder).GetBlock(0))
    check_volumes(convex)
    # Weiler et al. 2003 have 3,534 for another triangulation of the same points.
    assert 3000 < convex.GetNumberOfImaginaryCells() < 4500
    assert convex.GetOutput().GetPointData().GetArray("Density")


test_box()
test_box_with_cavity()
if "TETRALUX_DATA" in os.environ:
    test_blunt_fin(os.environ["TETRALUX_DATA"])
