# SPDX-License-Identifier: BSD-3-Clause
"""A sphere rendered without a display has the disk that the camera's geometry says it has."""

import math

from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkRenderingCore import (
    vtkActor,
    vtkPolyDataMapper,
    vtkRenderer,
    vtkWindowToImageFilter,
)

import tetralux


def make_window(width, height):
    source = vtkSphereSource()
    source.SetRadius(1)
    source.SetThetaResolution(256)
    source.SetPhiResolution(256)
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(source.GetOutputPort())
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().LightingOff()
    actor.GetProperty().SetColor(1, 0, 0)
    renderer = vtkRenderer()
    renderer.AddActor(actor)
    renderer.SetBackground(0, 0, 1)
    camera = renderer.GetActiveCamera()
    camera.ParallelProjectionOn()
    camera.SetParallelScale(2)
    window = tetralux.vtkHeadlessRenderWindow()
    window.SetMultiSamples(0)
    window.SetSize(width, height)
    window.AddRenderer(renderer)
    return window


def read(window):
    grab = vtkWindowToImageFilter()
    grab.SetInput(window)
    grab.Update()
    image = grab.GetOutput()
    width, height, _ = image.GetDimensions()
    return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, 3)


def check(window):
    width, height = window.GetSize()
    pixels = read(window)
    assert pixels.shape == (height, width, 3)
    red = (pixels == (255, 0, 0)).all(axis=2)
    blue = (pixels == (0, 0, 255)).all(axis=2)
    assert (red | blue).all()
    radius = height / 4  # the parallel scale is half of the height: two radii
    # A pixel is red where its centre is inside; only those within a pixel of the rim may differ.
    assert abs(red.sum() - math.pi * radius**2) < 2 * math.pi * radius
    assert red[height // 2, width // 2] and blue[0, 0]


window = make_window(160, 120)
assert window.SupportsOpenGL() == 1
check(window)

# Another size, a second window beside the first, and a new context after Finalize.
window.SetSize(200, 240)
check(window)
other = make_window(64, 64)
check(other)
check(window)
window.Finalize()
check(window)
del window
check(other)
