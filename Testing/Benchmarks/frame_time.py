#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Frame times against VTK's own mappers of unstructured grids, in one run on the same scene.

    TETRALUX_DATA=FOLDER PYTHONPATH=build/lib/python3.11/dist-packages \
        python3 Testing/Benchmarks/frame_time.py [--size 512] [--frames 5] [--parallel]

Renders the NASA blunt fin (187,395 tetrahedra), the best of several frames each, without a
display and without multisampling, which on software OpenGL costs every mapper some 10 ms a frame.
Times are of whole frames, compositing included; a frame of each mapper is rendered before any is
timed.
"""

import argparse
import json
import os
import sys
import time

import tetralux
import vtkmodules.vtkRenderingVolumeOpenGL2  # noqa: F401, VTK's mappers come from factories
from vtkmodules.vtkCommonDataModel import vtkPiecewiseFunction
from vtkmodules.vtkFiltersGeneral import vtkDataSetTriangleFilter
from vtkmodules.vtkIOParallel import vtkMultiBlockPLOT3DReader
from vtkmodules.vtkRenderingCore import (
    vtkColorTransferFunction,
    vtkRenderer,
    vtkVolume,
    vtkVolumeProperty,
)
from vtkmodules.vtkRenderingVolume import (
    vtkProjectedTetrahedraMapper,
    vtkUnstructuredGridVolumeRayCastMapper,
)


def read_blunt_fin():
    folder = os.environ.get("TETRALUX_DATA")
    if not folder:
        sys.exit("frame_time.py: TETRALUX_DATA must name the folder with bluntfinxyz.bin")
    reader = vtkMultiBlockPLOT3DReader()
    reader.SetXYZFileName(os.path.join(folder, "bluntfinxyz.bin"))
    reader.SetQFileName(os.path.join(folder, "bluntfinq.bin"))
    reader.SetScalarFunctionNumber(100)
    reader.Update()
    grid = reader.GetOutput().GetBlock(0)
    grid.GetPointData().SetActiveScalars("Density")
    tetrahedra = vtkDataSetTriangleFilter()
    tetrahedra.SetInputData(grid)
    tetrahedra.TetrahedraOnlyOn()
    tetrahedra.Update()
    return tetrahedra.GetOutput()


def make_property():
    color = vtkColorTransferFunction()
    opacity = vtkPiecewiseFunction()
    for scalar, rgb, alpha in (
        (0.19, (0, 0, 1), 0),
        (0.8, (0, 1, 1), 0.02),
        (1.2, (0, 1, 0), 0.3),
        (2.0, (1, 1, 0), 0.05),
        (4.98, (1, 0, 0), 1),
    ):
        color.AddRGBPoint(scalar, *rgb)
        opacity.AddPoint(scalar, alpha)
    volume_property = vtkVolumeProperty()
    volume_property.SetColor(color)
    volume_property.SetScalarOpacity(opacity)
    volume_property.SetInterpolationTypeToLinear()
    return volume_property


def time_mapper(mapper, options):
    """Best time of a frame, seconds; the camera is touched before each."""
    volume = vtkVolume()
    volume.SetMapper(mapper)
    volume.SetProperty(make_property())
    renderer = vtkRenderer()
    renderer.AddVolume(volume)
    window = tetralux.vtkHeadlessRenderWindow()
    window.SetMultiSamples(0)  # there is no geometry to smooth
    window.SetSize(options.size, options.size)
    window.AddRenderer(renderer)
    camera = renderer.GetActiveCamera()
    camera.SetPosition(30, 25, 35)
    camera.SetFocalPoint(3.3, 4.2, 2.9)
    camera.SetViewUp(0, 1, 0)
    camera.SetViewAngle(30)
    camera.SetParallelProjection(options.parallel)
    camera.SetParallelScale(9)
    renderer.ResetCameraClippingRange()
    window.Render()
    best = float("inf")
    for _ in range(options.frames):
        camera.Modified()
        start = time.perf_counter()
        window.Render()
        best = min(best, time.perf_counter() - start)
    return best


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--size", type=int, default=512, help="pixels along an edge (512)")
    parser.add_argument("--frames", type=int, default=5, help="frames timed of each (5)")
    parser.add_argument("--parallel", action="store_true", help="a parallel projection")
    options = parser.parse_args()
    mesh = read_blunt_fin()

    ours = tetralux.vtkTetrahedraRayCastMapper()
    ours.SetAutoAdjustSampleDistances(False)
    double = tetralux.vtkTetrahedraRayCastMapper()
    double.SetAutoAdjustSampleDistances(False)
    double.SetPrecisionToDouble()
    bunyk = vtkUnstructuredGridVolumeRayCastMapper()
    bunyk.SetAutoAdjustSampleDistances(False)
    bunyk.SetImageSampleDistance(1)
    times = {}
    for name, mapper in (
        ("vtkTetrahedraRayCastMapper", ours),
        ("vtkTetrahedraRayCastMapper, double precision", double),
        ("vtkUnstructuredGridVolumeRayCastMapper", bunyk),
        ("vtkProjectedTetrahedraMapper", vtkProjectedTetrahedraMapper()),
    ):
        mapper.SetInputData(mesh)
        times[name] = time_mapper(mapper, options)
    base = times["vtkUnstructuredGridVolumeRayCastMapper"]
    for name, seconds in times.items():
        print(f"{name:46s} {1000 * seconds:8.1f} ms   {base / seconds:5.1f} x Bunyk's speed")
    statistics = json.loads(ours.GetStatistics())
    print(json.dumps(statistics, indent=1))


if __name__ == "__main__":
    main()
