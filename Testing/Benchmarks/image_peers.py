#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The triangle caster beside VTK's mappers of image data: frame times and errors, in one run.

    TETRALUX_DATA=FOLDER PYTHONPATH=build/lib/python3.11/dist-packages \
        python3 Testing/Benchmarks/image_peers.py [--frames 9] [--sizes 256,512,1024] \
        [--output Documentation/bench]

Renders a head, an engine, a brain and a protein, opaque and translucent, in perspective and
parallel, with slices 0.75 voxels apart, by two threads. Times are medians of whole frames; the
mappers take turns frame by frame. The error is that of 8-bit pictures against slices a 32nd as far
apart, in channels of 0..255.

Writes image_peers.csv, and prints a table.
"""

import argparse
import math
import os
import statistics
import sys

import numpy
import tetralux
import vtkmodules.vtkRenderingVolumeOpenGL2  # noqa: F401, VTK's mappers come from factories
from benchmark_scene import VolumeWindow, make_property, time_render
from benchmark_tables import make_table, write_csv
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkSLCReader, vtkVolume16Reader
from vtkmodules.vtkIOXML import vtkXMLImageDataReader
from vtkmodules.vtkRenderingCore import vtkWindowToImageFilter
from vtkmodules.vtkRenderingVolume import (
    vtkFixedPointVolumeRayCastMapper,
    vtkGPUVolumeRayCastMapper,
)

VOXELS_PER_SLICE = 0.75
REFINEMENT = 32
VIEW = (0.5, 0.7, -0.4)
VIEW_ANGLE = 30  # degrees

# Scalars and opacities of each data set, opaque and translucent.
FUNCTIONS = {
    "head": (
        ((500, 0), (1150, 0.85), (1300, 1)),
        ((500, 0), (1000, 0.02), (1150, 0.1)),
    ),
    "engine": (((70, 0), (110, 0.9)), ((60, 0), (110, 0.03), (220, 0.15))),
    "brain": (((60, 0), (100, 0.9)), ((30, 0), (90, 0.03), (200, 0.1))),
    "protein": (((80, 0), (120, 0.9)), ((20, 0), (255, 0.2))),
}


def read_images(folder):
    head = vtkVolume16Reader()
    head.SetDataDimensions(64, 64)
    head.SetImageRange(1, 93)
    head.SetDataByteOrderToLittleEndian()
    head.SetFilePrefix(os.path.join(folder, "headsq", "quarter"))
    head.SetDataSpacing(3.2, 3.2, 1.5)
    readers = {"head": head}
    for name in ("engine", "brain"):
        readers[name] = vtkXMLImageDataReader()
        readers[name].SetFileName(os.path.join(folder, name + ".vti"))
    readers["protein"] = vtkSLCReader()
    readers["protein"].SetFileName(os.path.join(folder, "neghip.slc"))
    images = {}
    for name, reader in readers.items():
        reader.Update()
        images[name] = reader.GetOutput()
    return images


def make_nodes(ramp):
    first, last = ramp[0][0], ramp[-1][0]
    nodes = []
    for scalar, opacity in ramp:
        share = (scalar - first) / (last - first)
        nodes.append((scalar, 0.9, 0.3 + 0.6 * share, 0.2 + 0.7 * share, opacity))
    return nodes


def make_mappers(distance):
    caster = tetralux.vtkTriangleCasterMapper()
    caster.SetSampleDistance(distance)
    caster.SetMaximumError(1 / 255)
    fixed = vtkFixedPointVolumeRayCastMapper()
    fixed.SetSampleDistance(distance)
    fixed.SetInteractiveSampleDistance(distance)
    fixed.SetImageSampleDistance(1)
    fixed.SetNumberOfThreads(2)
    card = vtkGPUVolumeRayCastMapper()
    card.SetSampleDistance(distance)
    for mapper in (caster, fixed, card):
        mapper.SetAutoAdjustSampleDistances(False)
    caster.SetNumberOfThreads(2)
    return {"triangle caster": caster, "fixed point": fixed, "graphics": card}


def make_window(mapper, image, nodes, spacing, size, parallel):
    mapper.SetInputData(image)
    window = VolumeWindow(mapper, make_property(nodes, spacing), size, size)
    bounds = image.GetBounds()
    center = [(bounds[2 * a] + bounds[2 * a + 1]) / 2 for a in range(3)]
    diagonal = math.dist(bounds[::2], bounds[1::2])
    distance = 0.55 * diagonal / math.sin(math.radians(VIEW_ANGLE / 2))
    length = math.hypot(*VIEW)
    position = [center[a] - distance * VIEW[a] / length for a in range(3)]
    window.camera.SetParallelProjection(parallel)
    window.camera.SetParallelScale(0.55 * diagonal)
    window.look(position, center, VIEW_ANGLE)
    window.camera.SetViewUp(0, 0, 1)
    window.renderer.ResetCameraClippingRange()
    return window


def read_picture(window):
    grab = vtkWindowToImageFilter()
    grab.SetInput(window.window)
    grab.ReadFrontBufferOff()
    grab.ShouldRerenderOff()
    grab.Update()
    return vtk_to_numpy(grab.GetOutput().GetPointData().GetScalars()).astype(int)


def measure(image, nodes, size, parallel, frames):
    """Milliseconds, largest and mean error of each mapper."""
    spacing = sum(image.GetSpacing()) / 3
    distance = VOXELS_PER_SLICE * spacing
    windows = {
        name: make_window(mapper, image, nodes, spacing, size, parallel)
        for name, mapper in make_mappers(distance).items()
    }
    exact = tetralux.vtkTriangleCasterMapper()
    exact.SetSampleDistance(distance / REFINEMENT)
    exact.SetMaximumError(1e-6)
    exact.SetAutoAdjustSampleDistances(False)
    reference = make_window(exact, image, nodes, spacing, size, parallel)
    reference.window.Render()
    expected = read_picture(reference)
    times = {name: [] for name in windows}
    for _ in range(frames + 1):
        for name, window in windows.items():
            times[name].append(time_render(window))
    results = {}
    for name, window in windows.items():
        difference = numpy.abs(read_picture(window) - expected)
        covered = difference[(expected > 0).any(axis=1)]
        results[name] = (
            1000 * statistics.median(times[name][1:]),
            int(difference.max()),
            float(covered.mean()),
        )
    return results


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--sizes", default="512", help="pixels along an edge (512)")
    parser.add_argument("--frames", type=int, default=9, help="frames timed of each (9)")
    parser.add_argument("--output", help="folder that image_peers.csv is written to")
    options = parser.parse_args()
    folder = os.environ.get("TETRALUX_DATA")
    if not folder:
        sys.exit("image_peers.py: TETRALUX_DATA must name the folder with engine.vti")
    rows = []
    for name, image in read_images(folder).items():
        for kind, ramp in zip(("opaque", "translucent"), FUNCTIONS[name]):
            for size in map(int, options.sizes.split(",")):
                for parallel in (False, True):
                    results = measure(image, make_nodes(ramp), size, parallel, options.frames)
                    base = results["fixed point"][0]
                    for mapper, (milliseconds, largest, mean) in results.items():
                        rows.append(
                            {
                                "data": name,
                                "kind": kind,
                                "size": size,
                                "view": "parallel" if parallel else "perspective",
                                "mapper": mapper,
                                "milliseconds": f"{milliseconds:.1f}",
                                "speed": f"{base / milliseconds:.2f}",
                                "largest": largest,
                                "mean": f"{mean:.3f}",
                            }
                        )
                        print(",".join(map(str, rows[-1].values())), flush=True)
    print(make_table(list(rows[0]), [[str(v) for v in row.values()] for row in rows]))
    if options.output:
        write_csv(os.path.join(options.output, "image_peers.csv"), rows)


if __name__ == "__main__":
    main()
