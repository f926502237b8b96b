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
import sys

import tetralux
import vtkmodules.vtkRenderingVolumeOpenGL2  # noqa: F401, VTK's mappers come from factories
from benchmark_meshes import read_blunt_fin, split_by_vtk
from benchmark_scene import (
    BLUNT_FIN_FOCUS,
    BLUNT_FIN_NODES,
    BLUNT_FIN_POSITION,
    VolumeWindow,
    make_property,
    time_frames,
)
from vtkmodules.vtkRenderingVolume import (
    vtkProjectedTetrahedraMapper,
    vtkUnstructuredGridVolumeRayCastMapper,
)


def time_mapper(mapper, options):
    """Best time of a frame, by the clock and of the processor by all threads, seconds."""
    scene = VolumeWindow(mapper, make_property(BLUNT_FIN_NODES), options.size, options.size)
    scene.camera.SetParallelProjection(options.parallel)
    scene.camera.SetParallelScale(9)
    scene.look(BLUNT_FIN_POSITION, BLUNT_FIN_FOCUS)
    (seconds,), (processor,) = time_frames([scene], options.frames)
    return seconds, processor


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--size", type=int, default=512, help="pixels along an edge (512)")
    parser.add_argument("--frames", type=int, default=5, help="frames timed of each (5)")
    parser.add_argument("--parallel", action="store_true", help="a parallel projection")
    options = parser.parse_args()
    fin = read_blunt_fin()
    if not fin:
        sys.exit("frame_time.py: TETRALUX_DATA must name the folder with bluntfinxyz.bin")
    mesh = split_by_vtk(fin)

    ours = tetralux.vtkTetrahedraRayCastMapper()
    ours.SetAutoAdjustSampleDistances(False)
    double = tetralux.vtkTetrahedraRayCastMapper()
    double.SetAutoAdjustSampleDistances(False)
    double.SetPrecisionToDouble()
    projection = tetralux.vtkTetrahedraProjectionMapper()
    projection.SetAutoAdjustSampleDistances(False)
    bunyk = vtkUnstructuredGridVolumeRayCastMapper()
    bunyk.SetAutoAdjustSampleDistances(False)
    bunyk.SetImageSampleDistance(1)
    times = {}
    for name, mapper in (
        ("vtkTetrahedraRayCastMapper", ours),
        ("vtkTetrahedraRayCastMapper, double precision", double),
        ("vtkUnstructuredGridVolumeRayCastMapper", bunyk),
        ("vtkTetrahedraProjectionMapper", projection),
        ("vtkProjectedTetrahedraMapper", vtkProjectedTetrahedraMapper()),
    ):
        mapper.SetInputData(mesh)
        times[name] = time_mapper(mapper, options)
    base = times["vtkUnstructuredGridVolumeRayCastMapper"]
    for name, own in times.items():
        for kind, seconds, of_base in zip(("clock", "processor"), own, base):
            print(
                f"{name:46s} {kind:9s} {1000 * seconds:8.1f} ms"
                f"   {of_base / seconds:5.1f} x Bunyk's speed"
            )
    statistics = json.loads(ours.GetStatistics())
    print(json.dumps(statistics, indent=1))


if __name__ == "__main__":
    main()
