# SPDX-License-Identifier: BSD-3-Clause
"""A frame rebuilds what was changed, and no more. For pvbatch."""

from paraview import simple

import pictures
import scenes


def get_rebuilt():
    """What the last frame rebuilt."""
    return pictures.get_statistics(display)["rebuilt"]


def expect(what, rebuilt, expected):
    print(f"{what}: {', '.join(rebuilt) or 'nothing'}")
    assert set(rebuilt) == set(expected), f"{what}: {rebuilt} instead of {expected}"


pictures.load_plugin()
scene = scenes.DATA["disk"]
view = pictures.make_view()
files = [str(pictures.FOLDER / f"step{step}.vtu") for step in range(2)]
reader = simple.XMLUnstructuredGridReader(FileName=files)
display = pictures.show("disk", reader, view)
times = reader.TimestepValues
assert len(times) == 2
simple.Render(view)  # twice, to place the camera
opacities = simple.GetOpacityTransferFunction(scene["array"])

pictures.set_up(
    display, "Tetralux Volume", scene["unit_distance"], {"TetraluxMethod": "Ray casting"}
)
simple.Render(view)
expect("volume, first frame", get_rebuilt(), ["mesh", "scalars", "transfer function"])
simple.Render(view)
expect("volume, the same", get_rebuilt(), [])
view.CameraPosition = (10, 20, 30)
simple.Render(view)
expect("volume, camera", get_rebuilt(), [])
opacities.Points = [300, 0, 0.5, 0, 900, 0.3, 0.5, 0]
simple.Render(view)
expect("volume, a point of opacity", get_rebuilt(), ["transfer function"])
view.ViewTime = times[1]
simple.Render(view)
expect("volume, time step", get_rebuilt(), ["scalars"])
display.TetraluxMaximumError = 1e-3
simple.Render(view)
assert "mesh" not in get_rebuilt() and "scalars" not in get_rebuilt()

display.SetRepresentationType("Tetralux Isosurface")
display.TetraluxIsosurfaces = [400]
simple.Render(view)
display.TetraluxIsosurfaces = [500]
simple.Render(view)
expect("isosurface, isovalue", get_rebuilt(), ["transfer function"])
view.ViewTime = times[0]
simple.Render(view)
expect("isosurface, time step", get_rebuilt(), ["scalars"])
