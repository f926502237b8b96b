# SPDX-License-Identifier: BSD-3-Clause
"""vtkTetrahedraRayIntegrator from Python: by itself, and in VTK's own ray caster."""

import math

import vtkmodules.vtkRenderingVolumeOpenGL2  # noqa: F401: how VTK draws what its mapper casts
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkPoints, vtkUnsignedCharArray
from vtkmodules.vtkCommonDataModel import VTK_TETRA, vtkUnstructuredGrid
from vtkmodules.vtkRenderingCore import vtkVolume
from vtkmodules.vtkRenderingVolume import vtkUnstructuredGridVolumeRayCastMapper

import tetralux
from mapper_scene import MapperScene, make_property


def make_array(values):
    array = vtkDoubleArray()
    for value in values:
        array.InsertNextValue(value)
    return array


def make_red_property():
    """Attenuation goes from 1 to 3 over scalars from 0 to 1."""
    return make_property([(0, 1, 0, 0)], [(0, 0.5), (1, 1.5)], unit_distance=0.5)


def test_segments():
    volume = vtkVolume()
    volume.SetProperty(make_red_property())
    near, far = make_array([0, 1]), make_array([1, 0.5])
    integrator = tetralux.vtkTetrahedraRayIntegrator()
    integrator.Initialize(volume, near)
    color = [0.0, 0.0, 0.0, 0.0]
    integrator.Integrate(make_array([0.25, 0.5]), near, far, color)
    expected = 1 - math.exp(-(2 * 0.25 + 2.5 * 0.5))
    assert abs(color[3] - expected) < 1e-6 and abs(color[0] - expected) < 1e-6
    assert color[1] == color[2] == 0
    integrator.SetMaximumError(1e-3)
    assert integrator.GetMaximumError() == 1e-3
    assert "MaximumError: 0.001" in str(integrator)


def test_picture():
    points = vtkPoints()
    for corner in [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]:
        points.InsertNextPoint(corner)
    grid = vtkUnstructuredGrid()
    grid.SetPoints(points)
    grid.InsertNextCell(VTK_TETRA, 4, [0, 1, 2, 3])
    grid.GetPointData().SetScalars(make_array([0.5] * 4))
    mapper = vtkUnstructuredGridVolumeRayCastMapper()
    mapper.SetInputData(grid)
    mapper.SetRayIntegrator(tetralux.vtkTetrahedraRayIntegrator())
    scene = MapperScene(mapper, make_red_property(), 64, 64)
    scene.camera.ParallelProjectionOn()
    scene.camera.SetParallelScale(0.4)
    scene.camera.SetPosition(0.3, 0.2, 5)
    scene.camera.SetFocalPoint(0.3, 0.2, 0)
    scene.renderer.ResetCameraClippingRange()
    scene.window.Render()
    pixels = vtkUnsignedCharArray()
    scene.window.GetPixelData(32, 32, 32, 32, 0, pixels, 0)
    # A ray there is about 0.5 long in the cell, where the attenuation is 2.
    assert abs(pixels.GetComponent(0, 0) / 255 - (1 - math.exp(-1))) < 0.03


if __name__ == "__main__":
    test_segments()
    test_picture()
