# SPDX-License-Identifier: BSD-3-Clause
"""vtkTetrahedralizeCells from Python; with real data where TETRALUX_DATA names its folder."""

import os

from vtkmodules.vtkCommonDataModel import (
    VTK_QUADRATIC_TETRA,
    vtkImageData,
    vtkUnstructuredGrid,
)
from vtkmodules.vtkCommonCore import vtkPoints

import tetralux


def split(data):
    tetrahedra = tetralux.vtkTetrahedralizeCells()
    tetrahedra.SetInputDataObject(data)
    tetrahedra.Update()
    return tetrahedra


def test_image():
    image = vtkImageData()
    image.SetDimensions(4, 5, 6)
    output = split(image).GetOutput()
    assert output.GetNumberOfCells() == 5 * 3 * 4 * 5
    assert output.GetBounds() == image.GetBounds()


def test_quadratic_cell_and_counts():
    points = vtkPoints()
    corners = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
    for corner in corners:
        points.InsertNextPoint(corner)
    for a, b in [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)]:
        points.InsertNextPoint([(x + y) / 2 for x, y in zip(corners[a], corners[b])])
    grid = vtkUnstructuredGrid()
    grid.SetPoints(points)
    grid.InsertNextCell(VTK_QUADRATIC_TETRA, 10, list(range(10)))
    tetrahedra = split(grid)
    assert tetrahedra.GetOutput().GetNumberOfCells() == 16
    assert tetrahedra.GetNumberOfAddedPoints() == 1
    assert tetrahedra.GetNumberOfSkippedCells() == 0
    assert tetrahedra.GetSkippedCellTypes() == ""
    assert tetrahedra.GetPassOriginalIds()


def test_real_data(folder):
    from blunt_fin import read_blunt_fin
    from vtkmodules.vtkIOExodus import vtkExodusIIReader
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

    output = split(read_blunt_fin(folder)).GetOutput()
    assert output.GetNumberOfCells() == 187395
    assert output.GetNumberOfPoints() == 40960
    assert output.GetPointData().GetArray("Density")

    disk = vtkExodusIIReader()
    disk.SetFileName(os.path.join(folder, "disk_out_ref.ex2"))
    disk.UpdateInformation()
    disk.SetAllArrayStatus(disk.NODAL, 1)
    disk.Update()
    tetrahedra = split(disk.GetOutput())
    output = tetrahedra.GetOutput()
    assert output.GetNumberOfPoints() == 8499
    assert 5 * 7472 <= output.GetNumberOfCells() <= 6 * 7472
    assert output.GetPointData().GetArray("Temp")
    assert tetrahedra.GetNumberOfSkippedCells() == 0

    can = vtkXMLUnstructuredGridReader()
    can.SetFileName(os.path.join(folder, "can.vtu"))
    can.Update()
    hexahedra = can.GetOutput().GetNumberOfCells()
    output = split(can.GetOutput()).GetOutput()
    assert 5 * hexahedra <= output.GetNumberOfCells() <= 6 * hexahedra
    assert output.GetCellData().GetArray("EQPS")


if __name__ == "__main__":
    test_image()
    test_quadratic_cell_and_counts()
    folder = os.environ.get("TETRALUX_DATA")
    if folder:
        test_real_data(folder)
    else:
        print("TETRALUX_DATA is not set: no real data was read")
