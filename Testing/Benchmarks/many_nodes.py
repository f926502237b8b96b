#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What colour functions of thousands of nodes cost: a first frame, and frames after edits.

    TETRALUX_DATA=FOLDER PYTHONPATH=build/lib/python3.11/dist-packages \
        python3 Testing/Benchmarks/many_nodes.py [--nodes 256,4096] [--maps smooth,waves,random]
            [--spaces RGB,HSV,Lab,Diverging] [--size 512] [--edits 3]

Maps are smooth, or go 25 times through the rainbow, or have random colours at all nodes, on the
blunt fin by the ray caster. Each scene is new. A frame that only draws and frames for which a node
of the colours was moved follow the first one: medians, elapsed milliseconds, with the parts that
prepare the function and choose a table.
"""

import argparse
import json
import os
import statistics
import sys
import time

import numpy
import tetralux
from benchmark_meshes import read_blunt_fin, split_by_vtk
from benchmark_scene import BLUNT_FIN_FOCUS, BLUNT_FIN_POSITION, VolumeWindow, ask_for_picture
from color_maps import make_property

SPACES = {"RGB": 0, "HSV": 1, "Lab": 2, "Diverging": 3}  # as in vtkColorTransferFunction.h


def make_colors(name, nodes):
    t = numpy.linspace(0, 1, nodes)[:, None]
    if name == "smooth":
        return 0.5 + 0.45 * numpy.sin(4 * t + numpy.arange(3))
    if name == "waves":
        return 0.5 + 0.45 * numpy.sin(2 * numpy.pi * (25 * t + numpy.arange(3) / 3))
    return numpy.random.default_rng(1).random((nodes, 3))


def make_window(name, space, nodes, mesh, size):
    mapper = tetralux.vtkTetrahedraRayCastMapper()
    mapper.SetAutoAdjustSampleDistances(False)
    mapper.SetInputDataObject(mesh)
    volume_property = make_property("3 nodes", mesh)
    colors = volume_property.GetRGBTransferFunction(0)
    scalars = numpy.linspace(*colors.GetRange(), nodes)[:, None]
    colors.SetColorSpace(SPACES[space])
    rows = numpy.hstack((scalars, make_colors(name, nodes)))
    colors.FillFromDataPointer(nodes, rows.ravel().tolist())
    window = VolumeWindow(mapper, volume_property, size, size)
    window.look(BLUNT_FIN_POSITION, BLUNT_FIN_FOCUS)
    return window


def move_node(window, edit):
    colors = window.volume.GetProperty().GetRGBTransferFunction(0)
    node = [0] * 6
    colors.GetNodeValue(colors.GetSize() // 2, node)
    node[1] = 0.3 + 0.01 * edit
    colors.SetNodeValue(colors.GetSize() // 2, node)


def measure(window):
    """Milliseconds of a frame, of its function, and of its table."""
    begin = time.perf_counter()
    window.window.Render()
    elapsed = time.perf_counter() - begin
    parts = json.loads(window.mapper.GetStatistics())["seconds"]
    return [1e3 * t for t in (elapsed, parts["transfer_function"], parts["table"])]


def describe(times):
    return "{:.0f} ({:.1f}, {:.0f})".format(*(statistics.median(part) for part in zip(*times)))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--nodes", default="256,1000,4096,10000")
    parser.add_argument("--maps", default="smooth,waves,random")
    parser.add_argument("--spaces", default="RGB,HSV,Lab,Diverging")
    parser.add_argument("--size", type=int, default=512, help="pixels along an edge (512)")
    parser.add_argument("--edits", type=int, default=3, help="edits of each (3)")
    options = parser.parse_args()
    if not os.environ.get("TETRALUX_DATA"):
        sys.exit("many_nodes.py: TETRALUX_DATA must name the folder with bluntfinxyz.bin")

    mesh = split_by_vtk(read_blunt_fin())
    print("| map | space | nodes | of the function | intervals | first frame | frame | edit |")
    print("|---|---|---|---|---|---|---|---|", flush=True)
    for name in options.maps.split(","):
        for space in options.spaces.split(","):
            for nodes in map(int, options.nodes.split(",")):
                window = make_window(name, space, nodes, mesh, options.size)
                first = describe([measure(window)])
                frames = []
                edits = []
                for edit in range(options.edits):
                    ask_for_picture(window)
                    frames.append(measure(window))
                    move_node(window, edit)
                    edits.append(measure(window))
                frame = statistics.median(times[0] for times in frames)
                tables = json.loads(window.mapper.GetStatistics())["tables"]
                print(
                    f"| {name} | {space} | {nodes} | {tables['transfer_function_nodes']} "
                    f"| {tables['transfer_function_intervals']} | {first} | {frame:.0f} "
                    f"| {describe(edits)} |",
                    flush=True,
                )


if __name__ == "__main__":
    main()
