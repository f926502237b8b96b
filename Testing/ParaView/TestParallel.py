# SPDX-License-Identifier: BSD-3-Clause
"""Several processes give the picture of one: TestParallel.py reference | compare

For mpirun pvbatch. With "reference", saves the pictures; with "compare", compares with those. Eight
cameras around the reactor's hexahedra, among them one inside and one along a border; one that has
a part of the data outside of its view, where IceT moves what processes draw; a surface that hides a
part of the volume; cells that planes part already, also turned, and sheared; and image data.
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
OUTSIDE = {"partly outside": ((20, 28, 17), (-8, 6, 4))}
IMAGE_CAMERAS = {
    "image": ((110, 80, 150), (32.5, 32.5, 32.5)),
    "image, opposite": ((-50, 0, -90), (32.5, 32.5, 32.5)),
    "image, inside": ((30, 32, 31), (40, 36, 60)),
}
LINEAR = "600 + 12 * coordsX - 10 * coordsY + 14 * coordsZ"
BOX_CAMERAS = {
    "oblique": ((45, 38, 57), (0, 0, 0)),
    "opposite": ((-45, -38, -57), (0, 0, 0)),
    "side": ((60, 2, 3), (0, 0, 0)),
    "inside": ((1, 2, -3), (0, 0, 8)),
    "along a border": ((30, 20, 0.01), (0, 0, 0.01)),
}
# Turns and shears boxes so that those along the axes overlap.
SHEARED = (
    "(coordsX + 0.8 * coordsY) * iHat + (coordsY - 0.6 * coordsX) * jHat"
    " + (coordsZ + 0.5 * coordsX + 0.4 * coordsY) * kHat"
)
TURNED = (
    "Tetralux Volume",
    8,
    {"TetraluxMethod": "Ray casting", "Orientation": (50, 70, 30), "Scale": (1, 0.8, 1.2)},
)
VIEW_UPS = {"above": (0, 1, 0), "below": (0, 1, 0), "inside": (0, 1, 0)}
REPRESENTATIONS = {
    "volume": ("Tetralux Volume", {"TetraluxMethod": "Ray casting"}),
    "projection": ("Tetralux Volume", {"TetraluxMethod": "Projection"}),
    "isosurface": (
        "Tetralux Isosurface",
        {"TetraluxIsosurfaces": [400, 700], "TetraluxMapOpacity": 1},
    ),
}

# pvbatch runs a script by the first process.
processes = vtkMultiProcessController.GetGlobalController().GetNumberOfProcesses()
comparing = sys.argv[1] == "compare"
good = True


def get_path(processes, label):
    return pictures.FOLDER / f"{processes}-{label.replace(', ', '-').replace(' ', '-')}.png"


def check(name, cameras, view, display, of=None, stay=False):
    """Whether pictures are those of one process, or those of another name, from all cameras.

    stay: the data are to stay in the processes that have them.
    """
    equal = True
    for camera, (position, focal_point) in cameras.items():
        pictures.place_camera(view, position, focal_point, VIEW_UPS.get(camera, (0, 0, 1)))
        label = f"{name}, {camera}"
        reference = get_path("one", f"{of or name}, {camera}")
        if not comparing:
            pictures.save(view, reference)
            continue
        path = get_path("several", label)
        pictures.save(view, path)
        equal = pictures.compare(f"{label}, {processes} processes", path, reference) and equal
        # A frame that ParaView composites alone, in 8 bits, has none.
        frame = pictures.get_statistics(display)
        assert frame["composited"]["bytes"] > 0
        distributed = frame["distributed"]["bytes"]
        if (distributed == 0) != stay:
            print(f"{label}: {distributed} bytes of data were distributed: FAILED")
            equal = False
    return equal


pictures.load_plugin()
scene = scenes.DATA["disk"]
view = pictures.make_view()
reader = pictures.read("disk")
display = pictures.show("disk", reader, view)
for name, (representation, settings) in REPRESENTATIONS.items():
    pictures.set_up(display, representation, scene["unit_distance"], settings)
    cameras = CAMERAS | OUTSIDE if name == "volume" else CAMERAS
    good = check(name, cameras, view, display) and good

tetrahedra = pictures.get_statistics(display)["tables"]["tetrahedra"]
all_tetrahedra = pictures.COUNTS["disk"]["tetrahedra"]
if comparing and not 0 < tetrahedra < 0.8 * all_tetrahedra:
    print(f"the first process has {tetrahedra} of {all_tetrahedra} tetrahedra: FAILED")
    good = False

# A surface in the middle of the volume, which the processes have parts of.
plane = simple.Plane(Origin=(-4, -4, 1), Point1=(4, -4, -1), Point2=(-4, 4, 2))
plane_display = simple.Show(plane, view)
plane_display.Ambient, plane_display.Diffuse = 1, 0
representation, settings = REPRESENTATIONS["volume"]
pictures.set_up(display, representation, scene["unit_distance"], settings)
for camera in ("oblique", "below"):
    good = check("surface in a volume", {camera: CAMERAS[camera]}, view, display) and good
simple.Hide(plane, view)

simple.ResetSession()

# Each process makes a box of cells of its own: nothing is moved. Scalars are linear, since how a
# cell is split into tetrahedra depends on the numbers of its points.
view = pictures.make_view()
boxes = simple.Wavelet(WholeExtent=(-12, 12, -10, 10, -8, 8))
linear = simple.Calculator(Input=boxes, ResultArrayName="Temp", Function=LINEAR)
cells = simple.AppendDatasets(Input=linear)
display = pictures.show("disk", cells, view)
for name, cameras in (("volume", BOX_CAMERAS), ("isosurface", {"side": BOX_CAMERAS["side"]})):
    representation, settings = REPRESENTATIONS[name]
    pictures.set_up(display, representation, 8, settings)
    good = check(f"boxes, {name}", cameras, view, display, stay=True) and good
pictures.set_up(display, *TURNED)
turned = {name: BOX_CAMERAS[name] for name in ("oblique", "inside")}
good = check("boxes, turned", turned, view, display, stay=True) and good
display.TetraluxDistribution = "Always"
good = check("boxes, turned and moved", turned, view, display, of="boxes, turned") and good
display.TetraluxDistribution = "Automatic"
view.CameraParallelProjection = 1
side = {"side": BOX_CAMERAS["side"]}
good = check("boxes, parallel rays", side, view, display, stay=True) and good
simple.ResetSession()

# Oblique planes part these.
view = pictures.make_view()
boxes = simple.Wavelet(WholeExtent=(-12, 12, -10, 10, -8, 8))
linear = simple.Calculator(Input=boxes, ResultArrayName="Temp", Function=LINEAR)
cells = simple.AppendDatasets(Input=linear)
sheared = simple.Calculator(Input=cells, CoordinateResults=1, Function=SHEARED)
display = pictures.show("disk", sheared, view)
settings = {"TetraluxMethod": "Ray casting", "TetraluxDistribution": "Never"}
pictures.set_up(display, "Tetralux Volume", 8, settings)
sheared_cameras = {name: BOX_CAMERAS[name] for name in ("oblique", "opposite", "inside")}
good = check("sheared boxes", sheared_cameras, view, display, stay=True) and good
simple.ResetSession()

view, display = pictures.make_scene("neghip-triangle-caster")
good = check("triangle caster", IMAGE_CAMERAS, view, display, stay=True) and good
pictures.finish(good)
