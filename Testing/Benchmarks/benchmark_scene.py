# SPDX-License-Identifier: BSD-3-Clause
"""A volume in a window without a display, and how long its frames take, for benchmarks."""

import json
import time

import tetralux
from vtkmodules.vtkCommonDataModel import vtkPiecewiseFunction
from vtkmodules.vtkRenderingCore import (
    vtkColorTransferFunction,
    vtkRenderer,
    vtkVolume,
    vtkVolumeProperty,
)

# A view of the whole blunt fin, and nodes of the transfer functions of its density.
BLUNT_FIN_POSITION = (30, 25, 35)
BLUNT_FIN_FOCUS = (3.3, 4.2, 2.9)
BLUNT_FIN_NODES = (
    (0.19, 0, 0, 1, 0.0),
    (0.8, 0, 1, 1, 0.02),
    (1.2, 0, 1, 0, 0.3),
    (2.0, 1, 1, 0, 0.05),
    (4.98, 1, 0, 0, 1.0),
)


def make_property(nodes, unit_distance=1.0):
    """nodes: scalar, red, green, blue, opacity in unit_distance."""
    color = vtkColorTransferFunction()
    opacity = vtkPiecewiseFunction()
    for scalar, red, green, blue, alpha in nodes:
        color.AddRGBPoint(scalar, red, green, blue)
        opacity.AddPoint(scalar, alpha)
    volume_property = vtkVolumeProperty()
    volume_property.SetColor(color)
    volume_property.SetScalarOpacity(opacity)
    volume_property.SetScalarOpacityUnitDistance(unit_distance)
    volume_property.SetInterpolationTypeToLinear()
    return volume_property


class VolumeWindow:
    """What a mapper draws by a property, alone in a window."""

    def __init__(self, mapper, volume_property, width, height):
        self.mapper = mapper
        self.volume = vtkVolume()
        self.volume.SetMapper(mapper)
        self.volume.SetProperty(volume_property)
        self.renderer = vtkRenderer()
        self.renderer.AddVolume(self.volume)
        self.camera = self.renderer.GetActiveCamera()
        self.window = tetralux.vtkHeadlessRenderWindow()
        self.window.SetMultiSamples(0)  # there is no geometry to smooth
        self.window.SetSize(width, height)
        self.window.AddRenderer(self.renderer)

    def look(self, position, focus, angle=30):
        """From a position at a focus, y upwards, angle degrees from the lower to the upper edge."""
        self.camera.SetPosition(*position)
        self.camera.SetFocalPoint(*focus)
        self.camera.SetViewUp(0, 1, 0)
        self.camera.SetViewAngle(angle)
        self.renderer.ResetCameraClippingRange()


def ask_for_picture(entry):
    """The next frame of a VolumeWindow makes its picture anew, though nothing has changed."""
    entry.camera.Modified()
    if hasattr(entry.mapper, "GetStatistics"):  # VTK's mappers would build their tables anew
        entry.mapper.Modified()


def time_render(entry):
    """Seconds of a frame of a VolumeWindow, until it is there."""
    ask_for_picture(entry)
    begin = time.perf_counter()
    entry.window.Render()
    entry.window.WaitForCompletion()
    return time.perf_counter() - begin


def get_statistics(entry):
    """What the mapper of a VolumeWindow says of its last frame."""
    return json.loads(entry.mapper.GetStatistics())


def time_frames(volume_windows, rounds):
    """The best seconds of a frame of each window, and the best processor seconds of all threads.

    Each window renders a frame before any is timed. Then they take turns.
    """
    for entry in volume_windows:
        entry.window.Render()
    best = [float("inf")] * len(volume_windows)
    processor = [float("inf")] * len(volume_windows)
    for _ in range(rounds):
        for index, entry in enumerate(volume_windows):
            ask_for_picture(entry)
            used = time.process_time()
            start = time.perf_counter()
            entry.window.Render()
            best[index] = min(best[index], time.perf_counter() - start)
            processor[index] = min(processor[index], time.process_time() - used)
    return best, processor
