# SPDX-License-Identifier: BSD-3-Clause
"""Prepares the comparison with ParaView: prepare.py TOOL DATA_FOLDER OUTPUT_FOLDER

Writes the data sets as files that any ParaView reads, the pictures of the tool, and counts.json:
how many cells each file has and how many tetrahedra the tool made of them. Files have their arrays
inline, since some libraries make ParaView lose cells of others without a word.
"""

import json
import pathlib
import subprocess
import sys

from vtkmodules.vtkCommonCore import vtkIdList
from vtkmodules.vtkCommonDataModel import vtkMultiBlockDataSet
from vtkmodules.vtkFiltersCore import vtkAppendFilter
from vtkmodules.vtkFiltersExtraction import vtkExtractCells
from vtkmodules.vtkIOExodus import vtkExodusIIReader
from vtkmodules.vtkIOImage import vtkSLCReader
from vtkmodules.vtkIOParallel import vtkMultiBlockPLOT3DReader
from vtkmodules.vtkIOXML import (
    vtkXMLImageDataWriter,
    vtkXMLMultiBlockDataWriter,
    vtkXMLUnstructuredGridReader,
    vtkXMLUnstructuredGridWriter,
)

import scenes


def read_data(folder):
    """Name -> data set."""
    fin = vtkMultiBlockPLOT3DReader()
    fin.SetXYZFileName(str(folder / "bluntfinxyz.bin"))
    fin.SetQFileName(str(folder / "bluntfinq.bin"))
    fin.SetScalarFunctionNumber(100)
    fin.Update()
    cells = vtkAppendFilter()
    cells.AddInputData(fin.GetOutput().GetBlock(0))
    cells.Update()

    disk = vtkExodusIIReader()
    disk.SetFileName(str(folder / "disk_out_ref.ex2"))
    disk.UpdateInformation()
    disk.SetAllArrayStatus(vtkExodusIIReader.NODAL, 1)
    disk.Update()

    can = vtkXMLUnstructuredGridReader()
    can.SetFileName(str(folder / "can.vtu"))
    can.Update()

    disk_block = disk.GetOutput().GetBlock(0).GetBlock(0)
    halves = vtkMultiBlockDataSet()
    count = disk_block.GetNumberOfCells()
    for i, ids in enumerate((range(count // 2), range(count // 2, count))):
        cells_of_half = vtkIdList()
        for cell in ids:
            cells_of_half.InsertNextId(cell)
        half = vtkExtractCells()
        half.SetInputData(disk_block)
        half.SetCellList(cells_of_half)
        half.Update()
        halves.SetBlock(i, half.GetOutput())

    neghip = vtkSLCReader()
    neghip.SetFileName(str(folder / "neghip.slc"))
    neghip.Update()
    return {
        "fin": cells.GetOutput(),
        "disk": disk_block,
        "blocks": halves,
        "can": can.GetOutput(),
        "neghip": neghip.GetOutput(),
    }


def write_data(name, data, output):
    """Writes a data set; returns the file's path."""
    if data.IsA("vtkImageData"):
        writer = vtkXMLImageDataWriter()
    elif data.IsA("vtkMultiBlockDataSet"):
        writer = vtkXMLMultiBlockDataWriter()
    else:
        writer = vtkXMLUnstructuredGridWriter()
    path = output / scenes.get_file(name)
    writer.SetInputData(data)
    writer.SetFileName(str(path))
    writer.SetDataModeToBinary()  # inline
    assert writer.Write() == 1, path
    return path


def write_steps(disk, output):
    """Two time steps of the same cells, whose temperatures differ."""
    for step in range(2):
        data = disk.NewInstance()
        data.DeepCopy(disk)
        temperatures = data.GetPointData().GetArray("Temp")
        for i in range(temperatures.GetNumberOfTuples()):
            temperatures.SetValue(i, temperatures.GetValue(i) * (1 + 0.1 * step))
        write_data(f"step{step}", data, output)


def join(numbers):
    return ",".join(map(str, numbers))


def render(tool, name, output):
    """The picture of a scene by the tool; returns the number of tetrahedra."""
    data, _, _, options = scenes.SCENES[name]
    scene = scenes.DATA[data]
    transfer = output / f"{data}.json"
    transfer.write_text(
        json.dumps(
            [
                {
                    "Name": data,
                    "ColorSpace": "RGB",
                    "RGBPoints": scenes.scale(scenes.COLORS, scene["range"]),
                    "Points": scenes.scale(scenes.OPACITIES, scene["range"]),
                }
            ]
        )
    )
    statistics = output / f"{name}-stats.json"
    command = [
        *(tool, "render", output / scenes.get_file(data), "--array", scene["array"]),
        *("--transfer", transfer, "--opacity-unit-distance", scene["unit_distance"]),
        *("--camera-position", join(scene["position"])),
        *("--camera-focal-point", join(scene["focal_point"])),
        *("--camera-view-up", join(scene["view_up"])),
        *("--size", join(scenes.SIZE), "--background", join(scenes.BACKGROUND), *options),
        *("--stats", statistics, "--output", output / f"{name}-tool.png"),
    ]
    subprocess.run([str(word) for word in command], check=True)
    return json.loads(statistics.read_text()).get("tables", {}).get("tetrahedra", 0)


def main():
    tool, data_folder, output = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
    output.mkdir(parents=True, exist_ok=True)
    counts = {}
    for name, data in read_data(data_folder).items():
        write_data(name, data, output)
        counts[name] = {"cells": data.GetNumberOfCells()}
        if name == "disk":
            write_steps(data, output)
    for name in scenes.SCENES:
        tetrahedra = render(tool, name, output)
        counts[scenes.SCENES[name][0]]["tetrahedra"] = tetrahedra
    (output / "counts.json").write_text(json.dumps(counts))


if __name__ == "__main__":
    main()
