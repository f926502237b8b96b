# SPDX-License-Identifier: BSD-3-Clause
"""Examples/render_in_paraview.py makes two pictures of a file. For pvbatch."""

import os
import pathlib
import runpy
import sys

from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

folder = pathlib.Path(os.environ["TETRALUX_PARAVIEW_FOLDER"])
example = pathlib.Path(__file__).resolve().parents[2] / "Examples" / "render_in_paraview.py"
arguments = [os.environ["TETRALUX_PLUGIN"], folder / "disk.vtu", "Temp", folder]
sys.argv = [str(example), *map(str, arguments)]
names = ("volume.png", "surfaces.png")
for name in names:
    (folder / name).unlink(missing_ok=True)
runpy.run_path(str(example), run_name="__main__")
for name in names:
    reader = vtkPNGReader()
    reader.SetFileName(str(folder / name))
    reader.Update()
    image = reader.GetOutput()
    width, height, _ = image.GetDimensions()
    assert (width, height) == (800, 600), name
    pixels = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, -1)
    colors = len({tuple(pixel) for pixel in pixels[::4, ::4].reshape(-1, pixels.shape[2])})
    assert colors > 200, f"{name}: {colors} colours"
