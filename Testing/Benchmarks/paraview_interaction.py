# SPDX-License-Identifier: BSD-3-Clause
"""Frames a second of interactions in ParaView, beside its own representations of the same data.

pvbatch paraview_interaction.py Tetralux.so STEP0.vtu STEP1.vtu ARRAY

The files are time steps of one mesh: `tetralux generate ring --steps 2 --output ring.pvd` writes
such. Dragged are a point of the opacity function, an isovalue and the time. Both are timed by
turns, since a machine's speed drifts.
"""

import json
import statistics
import sys
import time

from paraview import simple

FRAMES = 4
TURNS = 2

plugin, *files, array_name = sys.argv[1:]
simple.LoadPlugin(plugin, remote=False, ns=globals())
reader = simple.XMLUnstructuredGridReader(FileName=files)
reader.UpdatePipeline()
low, high = reader.PointData.GetArray(array_name).GetRange()
view = simple.CreateView("RenderView")
view.ViewSize = (512, 512)
view.UseFXAA = 0
display = simple.Show(reader, view, "UnstructuredGridRepresentation")
simple.ColorBy(display, ("POINTS", array_name))
display.RescaleTransferFunctionToDataRange()
opacities = simple.GetOpacityTransferFunction(array_name)
contour = simple.Contour(Input=reader, ContourBy=["POINTS", array_name])
contour_display = simple.Show(contour, view)
simple.Hide(contour, view)
display.TetraluxMethod = "Ray casting"
simple.Render(view)


def drag_opacity(share):
    middle = low + (0.3 + 0.4 * share) * (high - low)
    opacities.Points = [low, 0, 0.5, 0, middle, 0.4, 0.5, 0, high, 0.8, 0.5, 0]


def drag_isovalue(share):
    value = low + (0.3 + 0.4 * share) * (high - low)
    display.TetraluxIsosurfaces = [value]
    contour.Isosurfaces = [value]


def play(share):
    view.ViewTime = reader.TimestepValues[int(share * FRAMES) % 2]


def show(representation):
    """ParaView's isosurface is that of its filter."""
    own = representation == "Contour"
    (simple.Hide if own else simple.Show)(reader, view)
    (simple.Show if own else simple.Hide)(contour, view)
    if not own:
        display.SetRepresentationType(representation)
    simple.Render(view)


def measure(drag):
    """Seconds of each frame."""
    seconds = []
    for frame in range(FRAMES):
        drag(frame / FRAMES)
        start = time.perf_counter()
        simple.Render(view)
        seconds.append(time.perf_counter() - start)
    return seconds


def get_rebuilt(representation):
    kind = "Isosurface" if representation == "Tetralux Isosurface" else ""
    display.UpdatePropertyInformation()
    return json.loads(display.GetPropertyValue(f"Tetralux{kind}Statistics"))["rebuilt"]


for name, drag, representations in (
    ("opacity", drag_opacity, ("Tetralux Volume", "Volume")),
    ("isovalue", drag_isovalue, ("Tetralux Isosurface", "Contour")),
    ("time, volume", play, ("Tetralux Volume", "Volume")),
    ("time, isosurface", play, ("Tetralux Isosurface", "Contour")),
):
    seconds = {representation: [] for representation in representations}
    rebuilt = ""
    for _ in range(TURNS):
        for representation in representations:
            show(representation)
            seconds[representation] += measure(drag)
            if representation.startswith("Tetralux"):
                rebuilt = ", ".join(get_rebuilt(representation)) or "nothing"
    rates = [f"{r} {1 / statistics.median(s):.2f}" for r, s in seconds.items()]
    print(f"{name}: frames a second: {'; '.join(rates)}; rebuilt: {rebuilt}", flush=True)
