# SPDX-License-Identifier: BSD-3-Clause
"""Time and bytes of frames in ParaView that several processes draw together.

mpirun -np N pvbatch paraview_parallel.py Tetralux.so INPUT.vtu ARRAY SIZE

Cameras all around the data; the least times count, since others slow a machine down. "moved" is
what all processes sent of pictures, together, for one frame; "composited" is what the first process
took for that, waiting for the others included.
"""

import json
import statistics
import sys
import time

from paraview import simple
from vtkmodules.vtkParallelCore import vtkMultiProcessController

TURNS = 3

plugin, input_file, array_name, size = sys.argv[1:]
processes = vtkMultiProcessController.GetGlobalController().GetNumberOfProcesses()
simple.LoadPlugin(plugin, remote=False, ns=globals())
reader = simple.OpenDataFile(input_file)
reader.UpdatePipeline()
low, high = reader.PointData.GetArray(array_name).GetRange()
view = simple.CreateView("RenderView")
view.ViewSize = (int(size), int(size))
view.OrientationAxesVisibility = 0
display = simple.Show(reader, view, "UnstructuredGridRepresentation")
simple.ColorBy(display, ("POINTS", array_name))
display.RescaleTransferFunctionToDataRange()
display.TetraluxMethod = "Ray casting"
display.TetraluxIsosurfaces = [low + 0.5 * (high - low)]
view.ResetCamera()
camera = simple.GetActiveCamera()

for representation in ("Tetralux Volume", "Tetralux Isosurface"):
    display.SetRepresentationType(representation)
    seconds, composited, moved = [], [], []
    simple.Render(view)
    for turn in range(TURNS * 8):
        camera.Azimuth(45)
        camera.Elevation(20 if turn % 2 == 0 else -20)
        start = time.perf_counter()
        simple.Render(view)
        seconds.append(time.perf_counter() - start)
        display.UpdatePropertyInformation()
        kind = "Isosurface" if representation == "Tetralux Isosurface" else ""
        frame = json.loads(display.GetPropertyValue(f"Tetralux{kind}Statistics"))
        exchange = frame.get("composited", {"bytes": 0, "seconds": 0})
        composited.append(exchange["seconds"])
        moved.append(exchange["bytes"])
    print(
        f"{representation}, {processes} processes: "
        f"{1e3 * min(seconds):.0f} ms a frame, "
        f"composited in {1e3 * min(composited):.1f} ms, "
        f"moved {statistics.mean(moved) / 2**20:.2f} MiB",
        flush=True,
    )
