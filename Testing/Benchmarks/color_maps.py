#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What frames and edits cost by the colour map, and how far pictures are off the exact way.

    TETRALUX_DATA=FOLDER PYTHONPATH=build/lib/python3.11/dist-packages \
        python3 Testing/Benchmarks/color_maps.py --tool build/bin/tetralux [--methods cpu,gpu]
            [--sizes 512,1024] [--meshes "blunt fin,ring"] [--frames 11] [--output FOLDER]

Maps of 3, 6 and 256 colour nodes and ParaView's cool to warm (diverging) have the same opacities.
All windows of a mesh take turns: of each, medians of the seconds and of the processor seconds of
all threads. Times relative to the map of 3 nodes are of processor seconds. An edit moves a node
of the opacity: frame and edit, the whole of it and the part that prepares the function. Errors are
those of the picture beside one of an error of 1e-7 in double precision. Prints tables, and writes
them and pictures of the first mesh into FOLDER, with --output.
"""

import argparse
import json
import os
import statistics
import sys
import time

import numpy
import tetralux
from benchmark_meshes import generate, read_blunt_fin, split_by_vtk
from benchmark_scene import BLUNT_FIN_FOCUS, BLUNT_FIN_POSITION, VolumeWindow, ask_for_picture
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPiecewiseFunction
from vtkmodules.vtkIOExodus import vtkExodusIIReader
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import (
    vtkColorTransferFunction,
    vtkVolumeProperty,
    vtkWindowToImageFilter,
)

# Place in the range, and opacity in a tenth of the bounds' diagonal.
OPACITIES = ((0, 0), (0.15, 0.05), (0.3, 0.5), (0.5, 0.1), (0.8, 0.4), (1, 0.9))
EDITED = 2  # of OPACITIES

MAXIMUM_ERROR = 1e-4
REFERENCE_ERROR = 1e-7

METHODS = {
    "cpu": tetralux.vtkTetrahedraRayCastMapper,
    "gpu": tetralux.vtkTetrahedraGPURayCastMapper,
    "projection": tetralux.vtkTetrahedraProjectionMapper,
}


def make_colors(name, low, high):
    """A colour transfer function over a range."""
    colors = vtkColorTransferFunction()
    few = {
        "3 nodes": ((0, 0, 1), (1, 1, 1), (1, 0, 0)),
        "6 nodes": ((0, 0, 1), (0, 1, 1), (0, 1, 0), (1, 1, 0), (1, 0.5, 0), (1, 0, 0)),
    }
    if name in few:
        nodes = few[name]
        for k, rgb in enumerate(nodes):
            colors.AddRGBPoint(low + (high - low) * k / (len(nodes) - 1), *rgb)
    elif name == "256 nodes":  # smooth, as Viridis is
        for t in numpy.linspace(0, 1, 256):
            red = 0.27 + t * (0.1 + t * (-2.2 + 2.83 * t))
            green = 0.9 * numpy.sin(1.45 * t)
            blue = 0.33 + t * (1.3 - t * (2.9 - 1.4 * t))
            colors.AddRGBPoint(low + (high - low) * t, *numpy.clip((red, green, blue), 0, 1))
    else:
        colors.SetColorSpaceToDiverging()
        colors.AddRGBPoint(low, 0.231373, 0.298039, 0.752941)
        colors.AddRGBPoint((low + high) / 2, 0.865, 0.865, 0.865)
        colors.AddRGBPoint(high, 0.705882, 0.0156863, 0.14902)
    return colors


MAPS = ("3 nodes", "6 nodes", "256 nodes", "diverging")


def make_property(name, mesh):
    low, high = mesh.GetPointData().GetScalars().GetRange()
    opacity = vtkPiecewiseFunction()
    for place, alpha in OPACITIES:
        opacity.AddPoint(low + (high - low) * place, alpha)
    volume_property = vtkVolumeProperty()
    volume_property.SetColor(make_colors(name, low, high))
    volume_property.SetScalarOpacity(opacity)
    volume_property.SetScalarOpacityUnitDistance(mesh.GetLength() / 10)
    volume_property.SetInterpolationTypeToLinear()
    return volume_property


def read_reactor():
    folder = os.environ.get("TETRALUX_DATA")
    if not folder:
        return None
    reader = vtkExodusIIReader()
    reader.SetFileName(os.path.join(folder, "disk_out_ref.ex2"))
    reader.UpdateInformation()
    reader.SetPointResultArrayStatus("Temp", 1)
    reader.Update()
    blocks = reader.GetOutput()
    while hasattr(blocks, "GetBlock"):
        blocks = blocks.GetBlock(0)
    blocks.GetPointData().SetActiveScalars("Temp")
    return blocks


def make_meshes(names, tool):
    makers = {
        "blunt fin": lambda: split_by_vtk(read_blunt_fin()),
        "ring": lambda: generate(tool, "ring"),
        "reactor flow": read_reactor,
        "ball": lambda: generate(tool, "ball", "--cells", "74"),
    }
    for name in names:
        yield name, makers[name]()


def make_window(method, name, mesh, size, error=MAXIMUM_ERROR, exact=False):
    mapper = METHODS[method]()
    mapper.SetMaximumError(error)
    if hasattr(mapper, "SetAutoAdjustSampleDistances"):
        mapper.SetAutoAdjustSampleDistances(False)
    if exact:
        mapper.SetPrecisionToDouble()
        mapper.SetIntegrationToClosedForm()
    mapper.SetInputDataObject(mesh)
    scene = VolumeWindow(mapper, make_property(name, mesh), size, size)
    if mesh.GetNumberOfPoints() == 40960:  # the blunt fin
        scene.look(BLUNT_FIN_POSITION, BLUNT_FIN_FOCUS)
    else:
        center = numpy.array(mesh.GetCenter())
        scene.look(center + mesh.GetLength() * numpy.array((0.9, 0.5, 1.3)), center)
    return scene


def get_picture(scene):
    """The picture of a window's mapper, as it is before it comes into the window."""
    image = scene.mapper.GetOutputImage()
    return vtk_to_numpy(image.GetPointData().GetScalars()).astype(float)


def measure(render):
    """Seconds and processor seconds of all threads."""
    used = time.process_time()
    begin = time.perf_counter()
    render()
    return time.perf_counter() - begin, time.process_time() - used


def measure_frames(scenes, frames):
    """Medians of frames of windows that take turns: of each, seconds and processor seconds."""
    times = [[] for _ in scenes]
    for _ in range(frames):
        for scene, own in zip(scenes, times):
            ask_for_picture(scene)
            own.append(measure(scene.window.Render))
    return [[statistics.median(part) for part in zip(*own)] for own in times]


def move_node(scene, mesh, share):
    low, high = mesh.GetPointData().GetScalars().GetRange()
    opacity = scene.volume.GetProperty().GetScalarOpacity()
    place, alpha = OPACITIES[EDITED]
    opacity.SetNodeValue(EDITED, [low + (high - low) * place, alpha * (1 - share), 0.5, 0])


def measure_edits(scenes, mesh, edits):
    """The same for frames before each of which a node was moved, and of its preparation."""
    times = [[] for _ in scenes]
    for edit in range(edits):
        for scene, own in zip(scenes, times):
            move_node(scene, mesh, 0.01 * (edit + 1))
            seconds = measure(scene.window.Render)
            parts = json.loads(scene.mapper.GetStatistics())["seconds"]
            own.append((*seconds, parts["transfer_function"] + parts["table"]))
    return [[statistics.median(part) for part in zip(*own)] for own in times]


def write_picture(scene, path):
    grabber = vtkWindowToImageFilter()
    grabber.SetInput(scene.window)
    writer = vtkPNGWriter()
    writer.SetInputConnection(grabber.GetOutputPort())
    writer.SetFileName(path)
    writer.Write()


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--tool", required=True, help="the program tetralux")
    parser.add_argument("--methods", default="cpu", help="of cpu, gpu, projection (cpu)")
    parser.add_argument("--sizes", default="512,1024", help="pixels along an edge (512,1024)")
    parser.add_argument("--meshes", default="blunt fin,ring,reactor flow,ball")
    parser.add_argument("--frames", type=int, default=11, help="frames of each (11)")
    parser.add_argument("--edits", type=int, default=5, help="edits of each (5)")
    parser.add_argument("--output", help="folder for the table and pictures")
    options = parser.parse_args()
    if not os.environ.get("TETRALUX_DATA"):
        sys.exit("color_maps.py: TETRALUX_DATA must name the folder with bluntfinxyz.bin")

    lines = [
        "| mesh | method | size | map | ms | processor ms | to 3 nodes | intervals | edit ms "
        "| processor ms | of it function | error |",
        "|---|---|---|---|---|---|---|---|---|---|---|---|",
    ]
    print("\n".join(lines), flush=True)
    for mesh_name, mesh in make_meshes(options.meshes.split(","), options.tool):
        for method in options.methods.split(","):
            for size in map(int, options.sizes.split(",")):
                scenes = [make_window(method, name, mesh, size) for name in MAPS]
                for scene in scenes:
                    scene.window.Render()
                errors = []
                for name, scene in zip(MAPS, scenes):
                    exact = make_window("cpu", name, mesh, size, REFERENCE_ERROR, True)
                    exact.window.Render()
                    errors.append(abs(get_picture(scene) - get_picture(exact)).max())
                    if options.output and mesh_name == "blunt fin":
                        os.makedirs(options.output, exist_ok=True)
                        base = os.path.join(options.output, f"{method}_{size}_{name}")
                        write_picture(scene, base + ".png")
                        write_picture(exact, base + "_exact.png")
                frames = measure_frames(scenes, options.frames)
                edits = measure_edits(scenes, mesh, options.edits)
                for name, scene, own, edit, error in zip(MAPS, scenes, frames, edits, errors):
                    tables = json.loads(scene.mapper.GetStatistics())["tables"]
                    line = (
                        f"| {mesh_name} | {method} | {size} | {name} | {1e3 * own[0]:.1f} "
                        f"| {1e3 * own[1]:.1f} | {own[1] / frames[0][1]:.2f} "
                        f"| {tables.get('transfer_function_intervals', '-')} | {1e3 * edit[0]:.1f} "
                        f"| {1e3 * edit[1]:.1f} | {1e3 * edit[2]:.1f} | {error:.1e} |"
                    )
                    print(line, flush=True)
                    lines.append(line)
    if options.output:
        os.makedirs(options.output, exist_ok=True)
        with open(os.path.join(options.output, "color_maps.md"), "w", encoding="utf-8") as file:
            file.write("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
