# SPDX-License-Identifier: BSD-3-Clause
"""Several processes give the picture of one: TestParallel.py reference | compare

For mpirun pvbatch. With "reference", saves the pictures; with "compare", compares with those. Eight
cameras around the reactor's hexahedra, among them one inside and one along a border.
"""

import json
import sys

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



def get_largest_difference(processes):
    """Of 255. ParaView composites pictures of 8 bits: each has colours and opacity that are
    rounded, half a step each, and where two meet the result is cut off, by a step. Half a step is
    of the reference. The opacity of the last picture covers nothing but the background, whose
    colours are exact."""
    return int(0.5 * processes + 0.5 * (processes - 1) + (processes - 1) + 0.5)


# pvbatch runs a script by the first process.
processes = vtkMultiProcessController.GetGlobalController().GetNumberOfProcesses()
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
        if comparing:
            label += f", {processes} processes"
            largest = get_largest_difference(processes)
            good = pictures.compare(label, path, reference, largest) and good

display.UpdatePropertyInformation()
statistics = json.loads(display.GetPropertyValue("TetraluxStatistics"))
tetrahedra = statistics["tables"]["tetrahedra"]
all_tetrahedra = pictures.COUNTS["disk"]["tetrahedra"]
if comparing and not 0 < tetrahedra < 0.8 * all_tetrahedra:
    print(f"the first process has {tetrahedra} of {all_tetrahedra} tetrahedra: FAILED")
    good = False
if not good:
    sys.exit(1)  # an exit by name makes this ParaView abort, which is not to be seen otherwise
