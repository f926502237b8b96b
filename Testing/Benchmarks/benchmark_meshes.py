# SPDX-License-Identifier: BSD-3-Clause
"""Meshes that the benchmarks in Python measure on."""

import os
import subprocess
import tempfile

from vtkmodules.vtkFiltersGeneral import vtkDataSetTriangleFilter
from vtkmodules.vtkIOParallel import vtkMultiBlockPLOT3DReader
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader


def read_blunt_fin():
    """The structured grid of the NASA blunt fin with its density, or None without TETRALUX_DATA."""
    folder = os.environ.get("TETRALUX_DATA")
    if not folder:
        return None
    reader = vtkMultiBlockPLOT3DReader()
    reader.SetXYZFileName(os.path.join(folder, "bluntfinxyz.bin"))
    reader.SetQFileName(os.path.join(folder, "bluntfinq.bin"))
    reader.SetScalarFunctionNumber(100)
    reader.Update()
    grid = reader.GetOutput().GetBlock(0)
    grid.GetPointData().SetActiveScalars("Density")
    return grid


def split_by_vtk(grid):
    """Tetrahedra by VTK's own filter: its mappers take nothing else."""
    tetrahedra = vtkDataSetTriangleFilter()
    tetrahedra.SetInputData(grid)
    tetrahedra.TetrahedraOnlyOn()
    tetrahedra.Update()
    return tetrahedra.GetOutput()


def generate(tool, name, *options):
    """A mesh that the command-line tool makes, with a field of its points as scalars."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "mesh.vtu")
        subprocess.run([tool, "generate", name, *options, "--output", path], check=True)
        reader = vtkXMLUnstructuredGridReader()
        reader.SetFileName(path)
        reader.Update()
        return reader.GetOutput()
