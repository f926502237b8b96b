# SPDX-License-Identifier: BSD-3-Clause
"""The projection mapper from Python: created by name, a cube's opacity as its optical depth says."""

import json
import math

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkDoubleArray
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPiecewiseFunction
from vtkmodules.vtkRenderingCore import vtkColorTransferFunction, vtkRenderer, vtkVolume

import tetralux

cube = vtkImageData()
cube.SetDimensions(4, 4, 4)
cube.SetSpacing(1 / 3, 1 / 3, 1 / 3)
array = vtkDoubleArray()
array.SetName("Ramp")
for point in range(64):
    array.InsertNextValue(cube.GetPoint(point)[0])
cube.GetPointData().SetScalars(array)

mapper = tetralux.vtkTetrahedraProjectionMapper()
assert mapper.IsA("vtkUnstructuredGridVolumeMapper")
assert mapper.GetStatistics() == "{}"
mapper.SetInputData(cube)

# Along z the scalar of a ray is constant: that of its x.
color = vtkColorTransferFunction()
color.AddRGBPoint(0, 1, 0, 0.5)
color.AddRGBPoint(1, 0, 1, 0.5)
opacity = vtkPiecewiseFunction()
opacity.AddPoint(0, 0.1)
opacity.AddPoint(1, 0.4)
volume = vtkVolume()
volume.SetMapper(mapper)
volume.GetProperty().SetColor(color)
volume.GetProperty().SetScalarOpacity(opacity)
volume.GetProperty().SetScalarOpacityUnitDistance(0.2)

# Twice as high as the cube.
renderer = vtkRenderer()
renderer.AddVolume(volume)
camera = renderer.GetActiveCamera()
camera.ParallelProjectionOn()
camera.SetParallelScale(1)
camera.SetPosition(0.5, 0.5, 4)
camera.SetFocalPoint(0.5, 0.5, 0)
camera.SetClippingRange(0.1, 10)
window = tetralux.vtkHeadlessRenderWindow()
window.SetSize(120, 80)
window.AddRenderer(renderer)


def render():
    window.Render()
    image = mapper.GetOutputImage()
    width, height, _ = image.GetDimensions()
    points = image.GetPointData()
    rgba = vtk_to_numpy(points.GetArray("RGBA")).reshape(height, width, 4)
    depth = vtk_to_numpy(points.GetArray("Depth")).reshape(height, width)
    return rgba.copy(), depth.copy(), json.loads(mapper.GetStatistics())


rgba, depth, statistics = render()
assert rgba.shape == (80, 120, 4) and rgba.dtype == numpy.float32
x = (numpy.arange(40, 80) + 0.5 - 40) / 40
alpha = 1 - numpy.exp(-(0.1 + 0.3 * x) / 0.2)
expected = alpha[:, None] * numpy.stack([1 - x, x, numpy.full(40, 0.5), numpy.ones(40)], axis=1)
inside = rgba[20:60, 40:80]
assert numpy.abs(inside - expected[None]).max() < mapper.GetMaximumError()
assert (rgba[:20] == 0).all() and (rgba[:, :40] == 0).all()
assert numpy.abs(depth[20:60, 40:80] - 3).max() < 1e-5
assert (depth[:20] == -1).all()
assert statistics["method"] == "projection"
assert statistics["projection"]["tetrahedra_drawn"] == 5 * 27
assert statistics["projection"]["order"] == "meshed polyhedra"
assert statistics["projection"]["cycles"] == 0
assert mapper.GetErrorEstimate() <= mapper.GetMaximumError()

# Absorption alone needs no order.
mapper.SetBlendModeToAbsorption()
rgba, _, statistics = render()
assert statistics["projection"]["order"] == "none" and "order" in statistics["left_out"]
assert numpy.abs(rgba[20:60, 40:80, 3] - alpha[None]).max() < 1e-5
mapper.SetBlendModeToComposite()

# 8 bits a channel.
mapper.SetColorBufferToUNorm8()
rgba, _, statistics = render()
assert statistics["projection"]["color_buffer"] == "8-bit"
assert statistics["projection"]["alpha_dithering"]
assert numpy.abs(rgba[20:60, 40:80] - expected[None]).mean() < 2 / 255

for name, value in (
    ("PerspectiveInterpolation", 0),
    ("ColorBuffer", mapper.HALF_BUFFER),
    ("AlphaDithering", 0),
    ("Order", mapper.CENTROID_ORDER),
):
    getattr(mapper, "Set" + name)(value)
    assert getattr(mapper, "Get" + name)() == value
    assert name + ": " in str(mapper)
assert math.isfinite(render()[0].sum())
