# SPDX-License-Identifier: BSD-3-Clause
"""The mapper on the graphics card has the picture of the mapper on the processor."""

import numpy
from vtkmodules.vtkCommonDataModel import vtkImageData

import tetralux
from mapper_scene import MapperScene, get_points, make_property, set_scalars

image = vtkImageData()
image.SetDimensions(6, 5, 4)
set_scalars(image, "Field", numpy.sin(get_points(image) @ numpy.array([1.0, 0.7, -1.3])))
colors = [(-1, 0, 0.3, 1), (1, 1, 0.6, 0)]
opacities = [(-1, 0.1), (1, 0.8)]


def make_scene(mapper):
    mapper.SetInputData(image)
    scene = MapperScene(mapper, make_property(colors, opacities), 60, 50)
    scene.camera.SetPosition(9, 7, 11)
    scene.camera.SetFocalPoint(2.5, 2, 1.5)
    scene.renderer.ResetCameraClippingRange()
    return scene


expected, expected_depths, _ = make_scene(tetralux.vtkTetrahedraRayCastMapper()).render()
assert (expected[..., 3] > 0.1).sum() > 300

mapper = tetralux.vtkTetrahedraGPURayCastMapper()
assert mapper.IsA("vtkTetrahedraVolumeMapper")
mapper.SetReentryToBoundaryLayers()
mapper.SetStepsPerPass(3)
mapper.CountFragmentsOn()
scene = make_scene(mapper)
picture, depths, statistics = scene.render()
assert abs(picture - expected).max() < 5e-5
assert abs(depths - expected_depths).max() < 1e-3

assert statistics["method"] == "gpu-ray-cast"
rays = statistics["rays"]
assert rays["reentry"] == "boundary layers"
assert rays["passes"] > 2
assert rays["fragments_per_pass"][0] >= (expected[..., 3] > 0).sum()
assert rays["fragments_per_pass"] == sorted(rays["fragments_per_pass"], reverse=True)
assert rays["segments"] > 1000
assert mapper.IsSupported(scene.window)
assert mapper.IsAccelerated(scene.window) != statistics["graphics_card"]["software"]
assert statistics["graphics_card"]["renderer"] in mapper.GetSupportReason()

# In bands of rows: the same picture.
assert rays["bands"] == 1
assert statistics["graphics_card"]["picture_bytes_per_pixel"] == 42 + 20 + 4
mapper.SetRayMaximumBytes(60 * 42 * 8)
banded, banded_depths, statistics = scene.render()
assert statistics["rays"]["bands"] == 7 and statistics["rays"]["rows_per_band"] == 8
assert (banded == picture).all() and (banded_depths == depths).all()
