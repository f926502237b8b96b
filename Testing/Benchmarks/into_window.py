#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What it takes to get a picture into the window: frames of each mapper beside empty ones.

    PYTHONPATH=build/lib/python3.11/dist-packages \
        python3 Testing/Benchmarks/into_window.py [--sizes 512 1024] [--frames 31]

Draws a cube that fills the window, one that fills a quarter of it, and one that is outside of the
view, with each mapper. Frames take turns: an empty one, in which the volume is invisible; a kept
one, in which nothing has changed; and a new one. Times are medians in milliseconds, until the
picture is there. "into the window" is the kept frame less the empty one: the mapper's checks and
what brings the picture into the window.
"""

import argparse
import statistics
import time

import numpy
import tetralux
from benchmark_scene import VolumeWindow, ask_for_picture, get_statistics, make_property
from benchmark_tables import make_table
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData

EDGE = 12  # points along an edge of the cube: few, so that casting does not hide the rest
NODES = ((0, 0, 0, 1, 0.1), (0.5, 0, 1, 0, 0.4), (1, 1, 0, 0, 0.8))
SURFACE = 0.5
MAPPERS = {
    "ray caster": tetralux.vtkTetrahedraRayCastMapper,
    "isosurfaces": tetralux.vtkTetrahedraIsosurfaceMapper,
    "isosurfaces, translucent": tetralux.vtkTetrahedraIsosurfaceMapper,
    "triangle caster": tetralux.vtkTriangleCasterMapper,
    "graphics card": tetralux.vtkTetrahedraGPURayCastMapper,
    "projection": tetralux.vtkTetrahedraProjectionMapper,
}
# Half of what a parallel view shows, in edges of the cube, and where its middle is. Of the last,
# the sphere around the cube is in view, so that VTK asks the mapper for it.
VIEWS = {"all": (0.45, 0.5), "a quarter": (1, 0.5), "nothing": (1, 2.2)}


def make_cube():
    """From 0 to 1 along each axis; the scalar grows along z."""
    cube = vtkImageData()
    cube.SetDimensions(EDGE, EDGE, EDGE)
    cube.SetSpacing(*(3 * [1 / (EDGE - 1)]))
    z = numpy.repeat(numpy.linspace(0, 1, EDGE, dtype=numpy.float32), EDGE * EDGE)
    scalars = numpy_to_vtk(z, deep=True)
    scalars.SetName("z")
    cube.GetPointData().SetScalars(scalars)
    return cube


def make_window(name, size, view):
    mapper = MAPPERS[name]()
    mapper.SetInputData(make_cube())
    if hasattr(mapper, "SetAutoAdjustSampleDistances"):
        mapper.SetAutoAdjustSampleDistances(False)
    volume_property = make_property(NODES)
    volume_property.GetIsoSurfaceValues().SetValue(0, SURFACE)
    if name == "isosurfaces":
        volume_property.GetScalarOpacity().RemoveAllPoints()
        volume_property.GetScalarOpacity().AddPoint(0, 1)
    entry = VolumeWindow(mapper, volume_property, size, size)
    half, middle = VIEWS[view]
    entry.camera.ParallelProjectionOn()
    entry.camera.SetParallelScale(half)
    entry.look((middle, 0.5, 4), (middle, 0.5, 0))
    entry.camera.SetClippingRange(0.1, 10)
    return entry


def time_frame(entry):
    begin = time.perf_counter()
    entry.window.Render()
    entry.window.WaitForCompletion()
    return 1000 * (time.perf_counter() - begin)


def measure(entry, frames):
    """Medians of milliseconds: empty, kept, new; and of the new one without casting."""
    times = {"empty": [], "kept": [], "new": [], "new, not cast": []}
    entry.window.Render()
    for _ in range(frames):
        entry.volume.VisibilityOff()
        times["empty"].append(time_frame(entry))
        entry.volume.VisibilityOn()
        times["kept"].append(time_frame(entry))
        assert get_statistics(entry)["kept"]
        ask_for_picture(entry)
        times["new"].append(time_frame(entry))
        cast = 1000 * get_statistics(entry)["seconds"].get("cast", 0)
        times["new, not cast"].append(times["new"][-1] - cast)
    return {name: statistics.median(values) for name, values in times.items()}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--sizes", type=int, nargs="+", default=(512, 1024))
    parser.add_argument("--frames", type=int, default=31, help="of each kind (31)")
    options = parser.parse_args()
    rows = []
    for size in options.sizes:
        for view in VIEWS:
            for name in MAPPERS:
                times = measure(make_window(name, size, view), options.frames)
                figures = [*times.values(), times["kept"] - times["empty"]]
                rows.append([str(size), view, name, *(f"{value:.2f}" for value in figures)])
    columns = ["pixels", "covered", "mapper", "empty", "kept", "new", "new, not cast"]
    print(make_table([*columns, "into the window"], rows))


if __name__ == "__main__":
    main()
