# SPDX-License-Identifier: BSD-3-Clause
"""Windows with and without a display take turns in one process: TestWindowsOfBothKinds.py
display|headless, whichever is the first."""

import sys

import numpy
import vtkmodules.vtkInteractionStyle  # noqa: F401
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401
from mapper_scene import MapperScene, get_points, make_property, make_unit_cube, set_scalars
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkRenderingCore import vtkRenderWindow, vtkWindowToImageFilter

import tetralux

SIZE = (64, 48)


def grab(window):
    grabber = vtkWindowToImageFilter()
    grabber.SetInput(window)
    grabber.ReadFrontBufferOff()
    grabber.ShouldRerenderOff()
    grabber.Update()
    return vtk_to_numpy(grabber.GetOutput().GetPointData().GetScalars()).copy()


def make_scene(mapper, has_display):
    cube = make_unit_cube()
    set_scalars(cube, "x", get_points(cube)[:, 0].copy())
    mapper.SetInputData(cube)
    volume_property = make_property([(0, 1, 0, 0), (1, 0, 0, 1)], [(0, 0.2), (1, 0.9)])
    window = vtkRenderWindow() if has_display else None
    scene = MapperScene(mapper, volume_property, *SIZE, window)
    scene.look_at_unit_cube()
    assert scene.window.IsA("vtkHeadlessRenderWindow") != has_display
    return scene


def expect_same(scenes):
    pictures = [scene.render()[0].copy() for scene in scenes]
    grabs = [grab(scene.window) for scene in scenes]
    assert pictures[0].max() > 0.2
    assert numpy.array_equal(*pictures)
    assert numpy.abs(grabs[0].astype(int) - grabs[1]).max() <= 1


display_first = sys.argv[1] == "display"
for make_mapper in (
    tetralux.vtkTetrahedraRayCastMapper,
    tetralux.vtkTetrahedraGPURayCastMapper,
    tetralux.vtkTetrahedraProjectionMapper,
):
    scenes = []
    for has_display in (display_first, not display_first):
        scenes.append(make_scene(make_mapper(), has_display))
        scenes[-1].render()
        grab(scenes[-1].window)
    for _ in range(2):
        expect_same(scenes)
    # A window goes, and a new one comes.
    scenes[0] = None
    scenes[1].render()
    scenes[0] = make_scene(make_mapper(), display_first)
    expect_same(scenes)
