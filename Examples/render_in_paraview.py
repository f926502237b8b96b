# SPDX-License-Identifier: BSD-3-Clause
"""Renders a file in ParaView, as a volume and as surfaces of equal values.

pvbatch render_in_paraview.py Tetralux.so INPUT.vtu ARRAY OUTPUT_FOLDER
"""

import os
import sys

from paraview import simple

if len(sys.argv) != 5:
    sys.exit("usage: pvbatch render_in_paraview.py Tetralux.so INPUT.vtu ARRAY OUTPUT_FOLDER")
plugin, input_file, array_name, folder = sys.argv[1:]

simple.LoadPlugin(plugin, remote=False, ns=globals())
reader = simple.OpenDataFile(input_file)
reader.UpdatePipeline()
array = reader.PointData.GetArray(array_name)
if array is None:
    sys.exit(f"{input_file}: no point array {array_name}")
low, high = array.GetRange()

view = simple.CreateView("RenderView")
view.ViewSize = (800, 600)
display = simple.Show(reader, view, "UnstructuredGridRepresentation")
simple.ColorBy(display, ("POINTS", array_name))
display.RescaleTransferFunctionToDataRange()

display.SetRepresentationType("Tetralux Volume")
display.TetraluxMethod = "Ray casting"
view.ResetCamera()
simple.SaveScreenshot(os.path.join(folder, "volume.png"), view)

display.SetRepresentationType("Tetralux Isosurface")
display.TetraluxIsosurfaces = [low + 0.3 * (high - low), low + 0.6 * (high - low)]
display.TetraluxShade = 1
display.Opacity = 0.6
simple.SaveScreenshot(os.path.join(folder, "surfaces.png"), view)
