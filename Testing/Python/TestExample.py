# SPDX-License-Identifier: BSD-3-Clause
"""Examples/render.py makes a picture of a file: TestExample.py EXAMPLE OUTPUT_FOLDER"""

import pathlib
import subprocess
import sys

from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersSources import vtkCellTypeSource
from vtkmodules.vtkIOImage import vtkPNGReader
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter

example = sys.argv[1]
grid_file = str(pathlib.Path(sys.argv[2], "example.vtu"))
picture_file = pathlib.Path(sys.argv[2], "example.png")
picture_file.unlink(missing_ok=True)

source = vtkCellTypeSource()
source.SetCellType(12)  # hexahedra
source.SetBlocksDimensions(6, 6, 6)
writer = vtkXMLUnstructuredGridWriter()
writer.SetInputConnection(source.GetOutputPort())
writer.SetFileName(grid_file)
assert writer.Write() == 1

command = [sys.executable, example, grid_file]
run = subprocess.run(
    [*command, "DistanceToCenter", str(picture_file)], check=True, capture_output=True, text=True
)
assert "% of the pixels are covered, the nearest at a distance of " in run.stdout, run.stdout
reader = vtkPNGReader()
reader.SetFileName(str(picture_file))
reader.Update()
image = reader.GetOutput()
width, height, _ = image.GetDimensions()
pixels = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, 3)
assert (width, height) == (800, 600)
# The grid fills the middle of the picture; its centre, at the low end of the array, is transparent.
covered = pixels.max(axis=2) > 8
assert 0.2 < covered.mean() < 0.9
assert not covered[0].any() and not covered[-1].any()

failure = subprocess.run([*command, "NoSuchArray", str(picture_file)], capture_output=True)
assert failure.returncode == 1
assert b"no point array NoSuchArray" in failure.stderr
