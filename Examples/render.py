# SPDX-License-Identifier: BSD-3-Clause
"""Renders a file as a volume, without a display: render.py INPUT.vtu ARRAY OUTPUT.png"""

import sys

from vtkmodules.vtkCommonDataModel import vtkPiecewiseFunction
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
from vtkmodules.vtkRenderingCore import (
    vtkColorTransferFunction,
    vtkRenderer,
    vtkVolume,
    vtkWindowToImageFilter,
)

import tetralux

if len(sys.argv) != 4:
    sys.exit("usage: render.py INPUT.vtu ARRAY OUTPUT.png")
input_file, array_name, output_file = sys.argv[1:]

reader = vtkXMLUnstructuredGridReader()
reader.SetFileName(input_file)
reader.Update()
grid = reader.GetOutput()
array = grid.GetPointData().GetArray(array_name)
if array is None:
    sys.exit(f"{input_file}: no point array {array_name}")
low, high = array.GetRange()

mapper = tetralux.vtkTetrahedraRayCastMapper()
mapper.SetInputData(grid)
mapper.SetScalarModeToUsePointFieldData()
mapper.SelectScalarArray(array_name)

color = vtkColorTransferFunction()
color.AddRGBPoint(low, 0.1, 0.3, 0.8)
color.AddRGBPoint(high, 1.0, 0.6, 0.1)
opacity = vtkPiecewiseFunction()
opacity.AddPoint(low, 0)
opacity.AddPoint(high, 1)

volume = vtkVolume()
volume.SetMapper(mapper)
volume.GetProperty().SetColor(color)
volume.GetProperty().SetScalarOpacity(opacity)
volume.GetProperty().SetScalarOpacityUnitDistance(grid.GetLength() / 20)

renderer = vtkRenderer()
renderer.AddVolume(volume)
window = tetralux.vtkHeadlessRenderWindow()
window.SetSize(800, 600)
window.AddRenderer(renderer)
if not window.SupportsOpenGL():
    sys.exit(1)
window.Render()

rgba, depth = tetralux.picture(mapper)
covered = rgba[..., 3] > 0
print(f"{covered.mean():.0%} of the pixels are covered", end="")
print(f", the nearest at a distance of {depth[covered].min():.3g}" if covered.any() else "")

image = vtkWindowToImageFilter()
image.SetInput(window)
writer = vtkPNGWriter()
writer.SetInputConnection(image.GetOutputPort())
writer.SetFileName(output_file)
writer.Write()
