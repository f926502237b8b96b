# SPDX-License-Identifier: BSD-3-Clause
"""The NASA blunt fin, for tests with real data."""

import os

from vtkmodules.vtkIOParallel import vtkMultiBlockPLOT3DReader


def read_blunt_fin(folder):
    """A composite of one structured grid, with the point array Density."""
    reader = vtkMultiBlockPLOT3DReader()
    reader.SetXYZFileName(os.path.join(folder, "bluntfinxyz.bin"))
    reader.SetQFileName(os.path.join(folder, "bluntfinq.bin"))
    reader.AddFunction(100)
    reader.Update()
    return reader.GetOutput()
