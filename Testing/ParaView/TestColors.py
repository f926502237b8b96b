# SPDX-License-Identifier: BSD-3-Clause
"""Colour maps are shown as ParaView shows them on its own surfaces. For pvbatch.

A plane through a row of cells, traced by Tetralux and extracted by ParaView's Contour, coloured by
another array, without lights: colour spaces, logarithmic scale, colours below and above the range.
Then the reset of the unit distance, which has a closed form where opacity is constant.
"""

from paraview import simple

import pictures

# Of 255. ParaView colours its surfaces by a texture of 1024 texels, of which it takes the nearest.
# The steepest map goes through white in a tenth of them: by a half of 4 in half a texel. And both
# are rounded.
LARGEST_DIFFERENCE = 3

# Of the pixels: one more or less of a colour on each side of two steps, where the surface is ten
# pixels high.
SHARE_AT_STEPS = 2 * 10 / (240 * 60)

COLORS = [2, 0.1, 0.2, 0.9, 5, 0.2, 0.9, 0.4, 9, 1, 0.8, 0.2, 17, 0.8, 0.1, 0.1]
MAPS = {
    "RGB": {"ColorSpace": "RGB"},
    "HSV": {"ColorSpace": "HSV"},
    "Lab": {"ColorSpace": "Lab"},
    # VTK's paths end near the colours of the nodes. Outside of the range its function has those
    # themselves, and ParaView's surfaces have the ends of the paths.
    "CIEDE2000": {"ColorSpace": "Lab/CIEDE2000", "RGBPoints": [1, *COLORS[1:12], 21, *COLORS[13:]]},
    "diverging": {"ColorSpace": "Diverging"},
    "step": {"ColorSpace": "Step"},
    "logarithmic": {"UseLogScale": 1},
    "below and above": {
        "UseBelowRangeColor": 1,
        "BelowRangeColor": (0.1, 0.9, 0.1),
        "UseAboveRangeColor": 1,
        "AboveRangeColor": (0.9, 0.1, 0.9),
    },
}

pictures.load_plugin()
view = pictures.make_view()
view.ViewSize = (240, 60)
cells = simple.Wavelet(WholeExtent=(0, 200, 0, 8, 0, 2))
across = simple.Calculator(Input=cells, ResultArrayName="Across", Function="1 + 0.1 * coordsX")
along = simple.Calculator(Input=across, ResultArrayName="Height", Function="coordsZ")
grid = simple.Tetrahedralize(Input=along)
display = simple.Show(grid, view, "UnstructuredGridRepresentation")
simple.ColorBy(display, ("POINTS", "Across"))
display.SetRepresentationType("Tetralux Isosurface")
display.TetraluxUseContourArray = 1
display.TetraluxContourArray = ("POINTS", "Height")
display.TetraluxIsosurfaces = [0.9]
contour = simple.Contour(Input=grid, ContourBy=("POINTS", "Height"), Isosurfaces=[0.9])
contour_display = simple.Show(contour, view)
simple.ColorBy(contour_display, ("POINTS", "Across"))
contour_display.Ambient, contour_display.Diffuse = 1, 0
contour_display.InterpolateScalarsBeforeMapping = 1
colors = simple.GetColorTransferFunction("Across")
colors.AutomaticRescaleRangeMode = "Never"
colors.NumberOfTableValues = 1024
defaults = {
    "ColorSpace": "RGB",
    "RGBPoints": COLORS,
    "UseLogScale": 0,
    "UseBelowRangeColor": 0,
    "UseAboveRangeColor": 0,
}
view.CameraParallelProjection = 1
view.CameraPosition, view.CameraFocalPoint = (100, 4, 100), (100, 4, 0)
view.CameraViewUp, view.CameraParallelScale = (0, 1, 0), 24

good = True
for name, settings in MAPS.items():
    for key, value in {**defaults, **settings}.items():
        setattr(colors, key, value)
    paths = []
    for shown, hidden, of in ((grid, contour, "tetralux"), (contour, grid, "paraview")):
        simple.Show(shown, view)
        simple.Hide(hidden, view)
        paths.append(pictures.FOLDER / f"colors-{name.replace(' ', '-')}-{of}.png")
        pictures.save(view, paths[-1], view.ViewSize)
    share = SHARE_AT_STEPS if name in ("step", "below and above") else 0
    good = pictures.compare(f"colours, {name}", *paths, LARGEST_DIFFERENCE, share) and good

# Constant opacity: mean opacity times 4 volumes by the surface of the box.
opacities = simple.GetOpacityTransferFunction("Across")
opacities.Points = [0, 0.3, 0.5, 0, 30, 0.3, 0.5, 0]
simple.Show(grid, view)
display.SetRepresentationType("Tetralux Volume")
simple.Render(view)
simple.ResetProperty("TetraluxUnitDistance", display)
expected = 0.3 * 4 * (200 * 8 * 2) / (2 * (200 * 8 + 8 * 2 + 2 * 200))
print(f"unit distance: {display.TetraluxUnitDistance}, expected {expected}")
pictures.finish(good and abs(display.TetraluxUnitDistance / expected - 1) < 1e-5)
