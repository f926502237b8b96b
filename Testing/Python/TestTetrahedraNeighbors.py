# SPDX-License-Identifier: BSD-3-Clause
"""vtkTetrahedraNeighbors from Python; with real data where TETRALUX_DATA names its folder."""

import os

from vtkmodules.vtkCommonDataModel import vtkImageData

import tetralux


def find_neighbors(data):
    tetrahedra = tetralux.vtkTetrahedralizeCells()
    tetrahedra.SetInputDataObject(data)
    neighbors = tetralux.vtkTetrahedraNeighbors()
    neighbors.SetInputConnection(tetrahedra.GetOutputPort())
    neighbors.Update()
    return neighbors


def check_mutual(output):
    """Each neighbour has the cell as its own neighbour, at the face that the array names."""
    neighbors = output.GetCellData().GetArray("Neighbors")
    faces = output.GetCellData().GetArray("NeighborFaces")
    outside = 0
    for cell in range(output.GetNumberOfCells()):
        for face in range(4):
            neighbor = int(neighbors.GetComponent(cell, face))
            if neighbor == tetralux.vtkTetrahedraNeighbors.OUTSIDE:
                assert faces.GetComponent(cell, face) == -1
                outside += 1
            elif neighbor != tetralux.vtkTetrahedraNeighbors.LEFT_OUT:
                across = int(faces.GetComponent(cell, face))
                assert neighbors.GetComponent(neighbor, across) == cell
                assert faces.GetComponent(neighbor, across) == face
    return outside


def test_image():
    image = vtkImageData()
    image.SetDimensions(4, 5, 6)
    neighbors = find_neighbors(image)
    assert check_mutual(neighbors.GetOutput()) == 2 * 2 * (3 * 4 + 4 * 5 + 3 * 5)
    assert neighbors.GetBoundary().GetNumberOfCells() == neighbors.GetNumberOfBoundaryFaces()
    assert neighbors.GetNumberOfBoundaryFaces() == 188
    assert neighbors.GetNumberOfComponents() == 1
    assert neighbors.GetNumberOfNonManifoldFaces() == 0
    assert "NumberOfBoundaryFaces: 188" in str(neighbors)


def test_blunt_fin(folder):
    from blunt_fin import read_blunt_fin

    neighbors = find_neighbors(read_blunt_fin(folder))
    assert neighbors.GetOutput().GetNumberOfCells() == 187395
    assert neighbors.GetNumberOfComponents() == 1
    assert neighbors.GetNumberOfZeroVolumeCells() == 77
    boundary = neighbors.GetBoundary()
    assert boundary.GetNumberOfCells() == 13516
    assert boundary.GetPointData().GetArray("Density")


if __name__ == "__main__":
    test_image()
    folder = os.environ.get("TETRALUX_DATA")
    if folder:
        test_blunt_fin(folder)
    else:
        print("TETRALUX_DATA is not set: no real data was read")
