# SPDX-License-Identifier: BSD-3-Clause
"""Scenes in ParaView, and pictures compared. For scripts of pvbatch and pvpython."""

import json
import os
import pathlib
import sys

from paraview import simple
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

import scenes

FOLDER = pathlib.Path(os.environ["TETRALUX_PARAVIEW_FOLDER"])
COUNTS = json.loads((FOLDER / "counts.json").read_text())

# Of 255: the rounding of two pictures to 8 bits, each within half of it, and their error of 1e-4.
LARGEST_DIFFERENCE = 1


def load_plugin():
    simple.LoadPlugin(os.environ["TETRALUX_PLUGIN"], remote=False, ns=globals())


def make_view():
    view = simple.CreateView("RenderView")
    view.ViewSize = scenes.SIZE
    view.Background = scenes.BACKGROUND
    view.UseColorPaletteForBackground = 0
    view.OrientationAxesVisibility = 0
    view.UseFXAA = 0
    # Instead of five lights one at the camera, as where nothing is said.
    view.UseLight = 0
    light = simple.AddLight(view=view)
    light.Coords = "Camera"
    return view


def read(data):
    """The reader of a data set's file. All cells must have arrived."""
    reader = simple.OpenDataFile(str(FOLDER / scenes.get_file(data)))
    reader.UpdatePipeline()
    cells = reader.GetDataInformation().GetNumberOfCells()
    expected = COUNTS[data]["cells"]
    assert cells == expected, f"{data}: {cells} of {expected} cells arrived"
    return reader


def show(data, reader, view):
    """Shows data with the colour map that the tool has, too."""
    scene = scenes.DATA[data]
    kind = "UniformGridRepresentation" if data == "neghip" else "UnstructuredGridRepresentation"
    display = simple.Show(reader, view, kind)
    simple.ColorBy(display, (scene["of"], scene["array"]))
    colors = simple.GetColorTransferFunction(scene["array"])
    colors.AutomaticRescaleRangeMode = "Never"
    colors.ColorSpace = "RGB"
    colors.RGBPoints = scenes.scale(scenes.COLORS, scene["range"])
    opacities = simple.GetOpacityTransferFunction(scene["array"])
    opacities.Points = scenes.scale(scenes.OPACITIES, scene["range"])
    return display


def make_scene(name):
    """A scene as scenes.py describes it; returns its view and what displays the data in it."""
    data, representation, settings, _ = scenes.SCENES[name]
    scene = scenes.DATA[data]
    view = make_view()
    display = show(data, read(data), view)
    set_up(display, representation, scene["unit_distance"], settings)
    place_camera(view, scene["position"], scene["focal_point"], scene["view_up"])
    return view, display


def get_statistics(display):
    """What the last frame was made of."""
    isosurface = display.Representation == "Tetralux Isosurface"
    display.UpdatePropertyInformation()
    name = f"Tetralux{'Isosurface' if isosurface else ''}Statistics"
    return json.loads(display.GetPropertyValue(name))


def finish(good):
    """Ends a test. An exit with a text makes this ParaView abort, which is not to be seen
    otherwise."""
    if not good:
        sys.exit(1)


def set_up(display, representation, unit_distance, settings):
    display.SetRepresentationType(representation)
    display.TetraluxUnitDistance = unit_distance
    # The tool's, which are those of vtkVolumeProperty.
    display.Ambient, display.Diffuse = 0.1, 0.7
    display.Specular, display.SpecularPower = 0.2, 10
    for name, value in settings.items():
        owner, _, property_name = name.rpartition(".")
        setattr(getattr(display, owner) if owner else display, property_name, value)


def place_camera(view, position, focal_point, view_up):
    """After the first Show, which places the camera itself."""
    view.CameraPosition = position
    view.CameraFocalPoint = focal_point
    view.CameraViewUp = view_up


def save(view, path, size=scenes.SIZE):
    simple.SaveScreenshot(str(path), view, ImageResolution=size)


def read_picture(path):
    reader = vtkPNGReader()
    reader.SetFileName(str(path))
    reader.Update()
    image = reader.GetOutput()
    width, height, _ = image.GetDimensions()
    pixels = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, -1)
    return pixels[..., :3].astype(int)


def compare(name, path, reference, largest=LARGEST_DIFFERENCE, share=0):
    """Returns whether a picture differs from another one by no more than largest, of 255, but for a
    share of its pixels."""
    picture, other = read_picture(path), read_picture(reference)
    if picture.shape != other.shape:
        print(f"{name}: {picture.shape} instead of {other.shape}")
        return False
    # A picture of the background alone is like another such one.
    background = [round(255 * x) for x in scenes.BACKGROUND]
    shown = (abs(other - background).max(axis=2) > 4).mean()
    difference = abs(picture - other).max()
    above = (abs(picture - other).max(axis=2) > largest).mean()
    good = above <= share and shown > 0.01
    print(
        f"{name}: largest difference {difference}/255, {above:.2%} of the pixels above {largest}, "
        f"{shown:.0%} shown{'' if good else ': FAILED'}"
    )
    sys.stdout.flush()
    return good
