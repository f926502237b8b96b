#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What a redraw of an unchanged scene takes of each mapper, beside a frame from another place.

    PYTHONPATH=build/lib/python3.11/dist-packages \\
        python3 Testing/Benchmarks/redraw.py [--tetrahedra 1e6] [--size 512] [--frames 9]
        [--output redraw.csv]

A cube is drawn from ever new places, and after each of these frames once more with another label
beside it, as a program redraws a window for a colour bar. Medians, in milliseconds; a frame of each
kind is drawn before any is timed, and the mappers take turns. vtkTriangleCasterMapper draws image
data of as many voxels.
"""

import argparse
import statistics
import time

import numpy
import tetralux
import vtkmodules.vtkRenderingFreeType  # noqa: F401, text comes from factories
from benchmark_meshes import make_cube
from benchmark_scene import VolumeWindow, make_property
from benchmark_tables import make_table, write_csv
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkRenderingCore import vtkTextActor

MAPPERS = (
    tetralux.vtkTetrahedraRayCastMapper,
    tetralux.vtkTetrahedraGPURayCastMapper,
    tetralux.vtkTetrahedraProjectionMapper,
    tetralux.vtkTetrahedraIsosurfaceMapper,
    tetralux.vtkTriangleCasterMapper,
)
NODES = ((-2, 0, 0, 1, 0.1), (0, 0, 1, 0, 0.5), (2, 1, 0, 0, 0.2))
FOCUS = numpy.array((0.5, 0.5, 0.5))


def make_image(voxels):
    """The field of make_cube as image data."""
    n = round(voxels ** (1 / 3))
    image = vtkImageData()
    image.SetDimensions(n + 1, n + 1, n + 1)
    image.SetSpacing(1 / n, 1 / n, 1 / n)
    place = numpy.linspace(0, 1, n + 1)
    z, y, x = numpy.meshgrid(place, place, place, indexing="ij")
    field = numpy.sin(7 * x) + numpy.cos(5 * y) * numpy.sin(9 * z)
    image.GetPointData().SetScalars(numpy_to_vtk(field.ravel().astype(numpy.float32), deep=True))
    return image


class Redraws:
    """A mapper's window with a label, and the seconds of its frames of both kinds."""

    def __init__(self, mapper_class, data, size):
        mapper = mapper_class()
        mapper.SetInputDataObject(data)
        if hasattr(mapper, "SetAutoAdjustSampleDistances"):
            mapper.SetAutoAdjustSampleDistances(False)
        self.name = mapper_class.__name__
        self.entry = VolumeWindow(mapper, make_property(NODES, 0.3), size, size)
        self.entry.volume.GetProperty().GetIsoSurfaceValues().SetValue(0, 0.3)
        self.label = vtkTextActor()
        self.entry.renderer.AddViewProp(self.label)
        self.moved = []
        self.redrawn = []

    def render(self, text):
        """Seconds of a frame with a label, until it is there."""
        self.label.SetInput(text)
        begin = time.perf_counter()
        self.entry.window.Render()
        self.entry.window.WaitForCompletion()
        return time.perf_counter() - begin

    def turn(self, frame):
        """A frame from a new place, and another one from there."""
        angle = 0.7 + 0.1 * frame
        self.entry.look(FOCUS + 2.4 * numpy.array((numpy.sin(angle), 0.5, numpy.cos(angle))), FOCUS)
        self.moved.append(self.render(f"frame {frame}"))
        self.redrawn.append(self.render(f"frame {frame} again"))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--tetrahedra", type=float, default=1e6, help="of the cube (1e6)")
    parser.add_argument("--size", type=int, default=512, help="pixels along an edge (512)")
    parser.add_argument("--frames", type=int, default=9, help="timed of each kind (9)")
    parser.add_argument("--output", help="a .csv for the table")
    options = parser.parse_args()
    cube = make_cube(options.tetrahedra)
    image = make_image(options.tetrahedra)
    entries = [
        Redraws(
            mapper,
            image if mapper is tetralux.vtkTriangleCasterMapper else cube,
            options.size,
        )
        for mapper in MAPPERS
    ]
    for frame in range(1 + options.frames):
        for entry in entries:
            entry.turn(frame)
    table = [
        {
            "mapper": entry.name,
            "frame from a new place, ms": f"{1000 * statistics.median(entry.moved[1:]):.1f}",
            "redraw, ms": f"{1000 * statistics.median(entry.redrawn[1:]):.1f}",
        }
        for entry in entries
    ]
    print(make_table(list(table[0]), [row.values() for row in table]))
    if options.output:
        write_csv(options.output, table)


if __name__ == "__main__":
    main()
