# SPDX-License-Identifier: BSD-3-Clause
"""The mapper on the graphics card from Python: its picture is that of the mapper on the processor."""

import json

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPiecewiseFunction
from vtkmodules.vtkRenderingCore import vtkColorTransferFunction, vtkRenderer, vtkVolume

import tetralux

image = vtkImageData()
image.SetDimensions(6, 5, 4)
points = numpy.array([image.GetPoint(i) for i in range(image.GetNumberOfPoints())])
field = numpy_to_vtk(numpy.sin(points @ numpy.array([1.0, 0.7, -1.3])), deep=True)
field.SetName("Field")
image.GetPointData().SetScalars(field)

color = vtkColorTransferFunction()
color.AddRGBPoint(-1, 0, 0.3, 1)
color.AddRGBPoint(1, 1, 0.6, 0)
opacity = vtkPiecewiseFunction()
opacity.AddPoint(-1, 0.1)
opacity.AddPoint(1, 0.8)


def render(mapper):
    mapper.SetInputData(image)
    volume = vtkVolume()
    volume.SetMapper(mapper)
    volume.GetProperty().SetColor(color)
    volume.GetProperty().SetScalarOpacity(opacity)
    renderer = vtkRenderer()
    renderer.AddVolume(volume)
    renderer.GetActiveCamera().SetPosition(9, 7, 11)
    renderer.GetActiveCamera().SetFocalPoint(2.5, 2, 1.5)
    renderer.ResetCameraClippingRange()
    window = tetralux.vtkHeadlessRenderWindow()
    window.SetMultiSamples(0)
    window.SetSize(60, 50)
    window.AddRenderer(renderer)
    window.Render()
    data = mapper.GetOutputImage().GetPointData()
    return window, [vtk_to_numpy(data.GetArray(name)).copy() for name in ("RGBA", "Depth")]


_, (expected, expected_depths) = render(tetralux.vtkTetrahedraRayCastMapper())
assert (expected[:, 3] > 0.1).sum() > 300

mapper = tetralux.vtkTetrahedraGPURayCastMapper()
assert mapper.IsA("vtkTetrahedraVolumeMapper")
mapper.SetReentryToBoundaryLayers()
mapper.SetStepsPerPass(3)
mapper.CountFragmentsOn()
window, (picture, depths) = render(mapper)
assert abs(picture - expected).max() < 5e-5
assert abs(depths - expected_depths).max() < 1e-3

statistics = json.loads(mapper.GetStatistics())
assert statistics["method"] == "gpu-ray-cast"
rays = statistics["rays"]
assert rays["reentry"] == "boundary layers"
assert rays["passes"] > 2
assert rays["fragments_per_pass"][0] >= (expected[:, 3] > 0).sum()
assert rays["fragments_per_pass"] == sorted(rays["fragments_per_pass"], reverse=True)
assert rays["segments"] > 1000
assert mapper.IsSupported(window) != statistics["graphics_card"]["software"]
assert statistics["graphics_card"]["renderer"] in mapper.GetSupportReason()
