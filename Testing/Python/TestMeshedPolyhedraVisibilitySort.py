# SPDX-License-Identifier: BSD-3-Clause
"""vtkMeshedPolyhedraVisibilitySort from Python: by itself, and in VTK's own mapper."""

# Makes vtkProjectedTetrahedraMapper.
import vtkmodules.vtkRenderingVolumeOpenGL2  # noqa: F401
from vtkmodules.vtkCommonCore import vtkIdList, vtkPoints
from vtkmodules.vtkCommonDataModel import VTK_TETRA, vtkUnstructuredGrid
from vtkmodules.vtkRenderingCore import vtkCamera
from vtkmodules.vtkRenderingVolume import vtkProjectedTetrahedraMapper

import tetralux


def make_stack(count):
    """Tetrahedra apart from each other, each above the one before."""
    points = vtkPoints()
    grid = vtkUnstructuredGrid()
    grid.SetPoints(points)
    for level in range(count):
        corners = [(0, 0, level), (1, 0, level), (0, 1, level), (0, 0, level + 0.5)]
        ids = [points.InsertNextPoint(corner) for corner in corners]
        grid.InsertNextCell(VTK_TETRA, 4, ids)
    return grid


def get_cells(sort):
    cells = []
    sort.InitTraversal()
    while True:
        ids = sort.GetNextCells()
        if ids is None:
            return cells
        cells += [ids.GetValue(i) for i in range(ids.GetNumberOfTuples())]


def test_order():
    sort = tetralux.vtkMeshedPolyhedraVisibilitySort()
    assert sort.GetOrder() == sort.AUTOMATIC_ORDER
    sort.SetInput(make_stack(5))
    camera = vtkCamera()
    camera.SetFocalPoint(0.2, 0.2, 2)
    camera.SetPosition(0.3, 0.3, 20)
    sort.SetCamera(camera)
    sort.SetMaxCellsReturned(2)
    assert get_cells(sort) == [0, 1, 2, 3, 4]
    sort.SetDirectionToFrontToBack()
    assert get_cells(sort) == [4, 3, 2, 1, 0]
    camera.SetPosition(0.3, 0.3, -20)
    for order in range(sort.EXACT_ORDER, sort.CENTROID_ORDER + 1):
        sort.SetOrder(order)
        assert get_cells(sort) == [0, 1, 2, 3, 4]
        assert sort.GetUsedOrder() == order
    sort.SetOrderToExact()
    get_cells(sort)
    assert sort.GetNumberOfCycles() == sort.GetNumberOfIgnoredFaces() == 0
    assert sort.GetRefusal() == ""
    assert "NumberOfCycles: 0" in str(sort)


def test_mapper():
    mapper = vtkProjectedTetrahedraMapper()
    sort = tetralux.vtkMeshedPolyhedraVisibilitySort()
    mapper.SetVisibilitySort(sort)
    assert mapper.GetVisibilitySort() is sort


def test_cycle():
    """Three bars, each above the next one where they cross."""
    points = vtkPoints()
    grid = vtkUnstructuredGrid()
    grid.SetPoints(points)
    for x, y in (1.0, 0.0), (-0.5, 0.866), (-0.5, -0.866):
        ids = []
        for across, along, up in (0.4, -2, -0.5), (0.7, -2, -0.5), (0.4, 2, 0.5), (0.55, 2, 0.6):
            ids.append(points.InsertNextPoint(x * across - y * along, y * across + x * along, up))
        grid.InsertNextCell(VTK_TETRA, 4, ids)
    sort = tetralux.vtkMeshedPolyhedraVisibilitySort()
    sort.SetInput(grid)
    assert sorted(get_cells(sort)) == [0, 1, 2]
    assert sort.GetNumberOfCycles() == 1 and sort.GetNumberOfIgnoredFaces() > 0
    cells = vtkIdList()
    sort.GetCycle(0, cells)
    assert sorted(cells.GetId(i) for i in range(cells.GetNumberOfIds())) == [0, 1, 2]


if __name__ == "__main__":
    test_order()
    test_mapper()
    test_cycle()
