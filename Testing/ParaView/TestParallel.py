# SPDX-License-Identifier: BSD-3-Clause
"""Any number of processes gives the picture of one: TestParallel.py reference | compare

For mpirun pvbatch. With "reference", saves the pictures; with "compare", compares with those. Eight
cameras around the reactor's hexahedra, among them one inside and one along a border.
"""

import sys

from paraview import simple
from vtkmodules.vtkParallelCore import vtkMultiProcessController

import pictures
import scenes

# Positions and focal points. The data are cut in the middle of their longest axis, z, first.
CAMERAS = {
    "oblique": ((20, 28, 17), (0, 0, 0.1)),
    "opposite": ((-20, -28, -17), (0, 0, 0.1)),
    "front": ((0, 40, 0.1), (0, 0, 0.1)),
    "back": ((0, -40, 0.1), (0, 0, 0.1)),
    "above": ((1, 2, 45), (0, 0, 0.1)),
    "below": ((1, 2, -45), (0, 0, 0.1)),
    "inside": ((1, 1, -3), (0, 0, 8)),
    "along a border": ((5, 0.08, 0.08), (0, 0.08, 0.08)),
}
REPRESENTATIONS = {
    "volume": ("Tetralux Volume", {"TetraluxMethod": "Ray casting"}),
    "projection": ("Tetralux Volume", {"TetraluxMethod": "Projection"}),
    "isosurface": (
        "Tetralux Isosurface",
        {"TetraluxIsosurfaces": [400, 700], "TetraluxMapOpacity": 1},
    ),
}

controller = vtkMultiProcessController.GetGlobalController()
root = controller.GetLocalProcessId() == 0
comparing = sys.argv[1] == "compare"
pictures.load_plugin()
scene = scenes.DATA["disk"]
view = pictures.make_view()
reader = pictures.read("disk")
display = pictures.show("disk", reader, view)
good = True
for name, (representation, settings) in REPRESENTATIONS.items():
    pictures.set_up(display, representation, scene["unit_distance"], settings)
    for camera, (position, focal_point) in CAMERAS.items():
        view_up = (0, 1, 0) if camera in ("above", "below", "inside") else (0, 0, 1)
        pictures.place_camera(view, position, focal_point, view_up)
        label = f"{name}, {camera}"
        reference = pictures.FOLDER / f"one-{name}-{camera.replace(' ', '-')}.png"
        path = reference.with_name(reference.name.replace("one-", "several-"))
        pictures.save(view, path if comparing else reference)
        if root and comparing:
            label += f", {controller.GetNumberOfProcesses()} processes"
            good = pictures.compare(label, path, reference) and good
if not good:
    sys.exit(1)  # an exit by name makes this ParaView abort, which is not to be seen otherwise
