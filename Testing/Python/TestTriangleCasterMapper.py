# SPDX-License-Identifier: BSD-3-Clause
"""The triangle caster from Python: a cube's opacity as its optical model says."""

import math

import numpy

import tetralux
from mapper_scene import MapperScene, get_points, make_property, make_unit_cube, set_scalars

cube = make_unit_cube()
set_scalars(cube, "Constant", numpy.full(64, 2.5))

mapper = tetralux.vtkTriangleCasterMapper()
assert mapper.IsA("vtkVolumeMapper")
assert mapper.GetStatistics() == "{}"
assert mapper.GetObstacle() == "there is no input"
mapper.SetInputData(cube)
assert mapper.GetBounds() == (0, 1, 0, 1, 0, 1)
assert mapper.GetObstacle() == ""

volume_property = make_property(
    colors=[(0, 0, 1, 0.25), (5, 1, 1, 0.25)],  # at 2.5: one half, 1, 0.25
    opacities=[(0, 0), (10, 1)],  # at 2.5: 0.25
    unit_distance=0.2,
)
scene = MapperScene(mapper, volume_property, 120, 80)
scene.look_at_unit_cube()


def check(alpha):
    rgba, depth, statistics = scene.render()
    assert rgba.shape == (80, 120, 4) and rgba.dtype == numpy.float32
    inside = numpy.zeros((80, 120), bool)
    inside[20:60, 40:80] = True
    expected = alpha * numpy.array([0.5, 1, 0.25, 1])
    assert numpy.abs(rgba[inside] - expected).max() < mapper.GetMaximumError()
    assert (rgba[~inside] == 0).all()
    assert numpy.abs(depth[inside] - 3).max() < 1e-5
    assert (depth[~inside] == -1).all()
    assert statistics["method"] == "triangle-caster"
    # What is between slices is measured when it is asked for.
    assert 0 < statistics["error"]["estimate"] <= mapper.GetErrorEstimate()
    assert mapper.IsMaximumErrorKept()
    return statistics


statistics = check(1 - (1 - 0.25) ** (1 / 0.2))
assert statistics["rebuilt"] == ["scalars", "transfer function"]
assert statistics["input"]["dimensions"] == [4, 4, 4]
assert statistics["rays"]["rays"] == 40 * 40  # that go through the cube
assert statistics["slices"]["distance"] > 0
assert "cropping" in statistics["left_out"]
assert check(1 - (1 - 0.25) ** (1 / 0.2))["rebuilt"] == []

mapper.SetOpacityModelToAttenuation()
check(1 - math.exp(-0.25 / 0.2))
mapper.SetOpacityModelToPower()

mapper.CroppingOn()
mapper.SetCroppingRegionPlanes(-1, 2, -1, 2, 0.4, 2)
check(1 - (1 - 0.25) ** (0.6 / 0.2))
mapper.CroppingOff()

# The largest scalar of a constant cube has its opacity, however long the ray is.
mapper.SetBlendModeToMaximumIntensity()
rgba, _, _ = scene.render()
assert abs(rgba[40, 60] - 0.25 * numpy.array([0.5, 1, 0.25, 1])).max() < 1e-6
mapper.SetBlendModeToComposite()
mapper.SetAverageIPScalarRange((1, 2))
assert mapper.GetAverageIPScalarRange() == (1, 2)

# Colours at the front are half as bright, and at the back all black.
mapper.SetNearColor(0.5, 0.5, 0.5)
mapper.SetFarColor((0, 0, 0))
rgba, _, _ = scene.render()
assert 0 < rgba[40, 60, 0] < 0.5 * 0.5 * rgba[40, 60, 3]
mapper.SetNearColor(1, 1, 1)
mapper.SetFarColor(1, 1, 1)

for name, value in (
    ("MaximumError", 1e-3),
    ("SampleDistance", 0.03),
    ("InteractiveSampleDistance", 0.1),
    ("SliceShape", mapper.SHELL_SLICES),
    ("NumberOfThreads", 1),
    ("TileSize", 16),
    ("CastTriangles", 1),
    ("EndTriangles", 0),
    ("SkipPixels", 0),
    ("SkipEmptySpace", 0),
    ("AutoAdjustSampleDistances", 0),
    ("IntermixIntersectingGeometry", 0),
):
    getattr(mapper, "Set" + name)(value)
    assert getattr(mapper, "Get" + name)() == value
statistics = check(1 - (1 - 0.25) ** (1 / 0.2))
assert statistics["rays"]["threads"] == 1 and statistics["slices"]["distance"] == 0.03

# Where the scalar varies, the picture is brighter where there is more of it.
set_scalars(cube, "Ramp", get_points(cube)[:, 1].astype(numpy.float32))
mapper.SetInputData(cube)
volume_property.GetScalarOpacity().RemoveAllPoints()
volume_property.GetScalarOpacity().AddPoint(0, 0)
volume_property.GetScalarOpacity().AddPoint(1, 0.5)
rgba, _, _ = scene.render()
assert (numpy.diff(rgba[22:58, 60, 3]) > 0).all()
