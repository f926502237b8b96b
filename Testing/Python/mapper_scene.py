# SPDX-License-Identifier: BSD-3-Clause
"""A volume in a window without a display, for the tests of what draws volumes."""

import json

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPiecewiseFunction
from vtkmodules.vtkRenderingCore import (
    vtkColorTransferFunction,
    vtkRenderer,
    vtkVolume,
    vtkVolumeProperty,
)

import tetralux


def get_points(image):
    return numpy.array([image.GetPoint(i) for i in range(image.GetNumberOfPoints())])


def set_scalars(image, name, values):
    array = numpy_to_vtk(values, deep=True)
    array.SetName(name)
    image.GetPointData().SetScalars(array)


def make_unit_cube():
    """3 x 3 x 3 voxels from 0 to 1 along each axis, without scalars."""
    cube = vtkImageData()
    cube.SetDimensions(4, 4, 4)
    cube.SetSpacing(1 / 3, 1 / 3, 1 / 3)
    return cube


def make_property(colors, opacities, unit_distance=1):
    """colors: scalar, red, green, blue; opacities: scalar, opacity in unit_distance."""
    color = vtkColorTransferFunction()
    for node in colors:
        color.AddRGBPoint(*node)
    opacity = vtkPiecewiseFunction()
    for node in opacities:
        opacity.AddPoint(*node)
    volume_property = vtkVolumeProperty()
    volume_property.SetColor(color)
    volume_property.SetScalarOpacity(opacity)
    volume_property.SetScalarOpacityUnitDistance(unit_distance)
    return volume_property


class MapperScene:
    """What a mapper draws by a property, alone in a window."""

    def __init__(self, mapper, volume_property, width, height, window=None):
        """window: of VTK; None for one without a display"""
        self.mapper = mapper
        volume = vtkVolume()
        volume.SetMapper(mapper)
        volume.SetProperty(volume_property)
        self.renderer = vtkRenderer()
        self.renderer.AddVolume(volume)
        self.camera = self.renderer.GetActiveCamera()
        self.window = window or tetralux.vtkHeadlessRenderWindow()
        self.window.SetMultiSamples(0)  # there is no geometry to smooth
        self.window.SetSize(width, height)
        self.window.AddRenderer(self.renderer)

    def look_at_unit_cube(self):
        """Along z, from 3 before the cube, which fills half of the window's height."""
        self.camera.ParallelProjectionOn()
        self.camera.SetParallelScale(1)
        self.camera.SetPosition(0.5, 0.5, 4)
        self.camera.SetFocalPoint(0.5, 0.5, 0)
        self.camera.SetClippingRange(0.1, 10)

    def render(self):
        """Rows from the bottom of a Tetralux mapper's colors and depths, and its statistics."""
        self.window.Render()
        return (*tetralux.picture(self.mapper), json.loads(self.mapper.GetStatistics()))
