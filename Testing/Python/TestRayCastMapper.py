# SPDX-License-Identifier: BSD-3-Clause
"""The ray cast mapper from Python: created by name, a cube's opacity as its optical depth says."""

import math

import numpy
from vtkmodules.vtkCommonDataModel import vtkMultiBlockDataSet

import tetralux
from mapper_scene import MapperScene, make_property, make_unit_cube, set_scalars

cube = make_unit_cube()
set_scalars(cube, "Constant", numpy.full(64, 2.5))

mapper = tetralux.vtkTetrahedraRayCastMapper()
assert mapper.IsA("vtkUnstructuredGridVolumeMapper")
assert mapper.GetStatistics() == "{}"
mapper.SetInputData(cube)
assert mapper.GetBounds() == (0, 1, 0, 1, 0, 1)

volume_property = make_property(
    colors=[(0, 0, 1, 0.25), (5, 1, 1, 0.25)],  # at 2.5: one half, 1, 0.25
    opacities=[(0, 0), (10, 1)],  # at 2.5: 0.25
    unit_distance=0.2,
)
scene = MapperScene(mapper, volume_property, 120, 80)
scene.look_at_unit_cube()


def check(thickness):
    rgba, depth, statistics = scene.render()
    assert rgba.shape == (80, 120, 4) and rgba.dtype == numpy.float32
    alpha = 1 - math.exp(-0.25 / 0.2 * thickness)
    inside = numpy.zeros((80, 120), bool)
    inside[20:60, 40:80] = True
    expected = alpha * numpy.array([0.5, 1, 0.25, 1])
    assert numpy.abs(rgba[inside] - expected).max() < mapper.GetMaximumError()
    assert (rgba[~inside] == 0).all()
    assert numpy.abs(depth[inside] - 3).max() < 1e-5
    assert (depth[~inside] == -1).all()
    assert statistics["error"]["estimate"] == mapper.GetErrorEstimate()
    assert mapper.GetErrorEstimate() <= mapper.GetMaximumError()
    return statistics


statistics = check(thickness=1)
assert statistics["rebuilt"] == ["mesh", "scalars", "transfer function"]
assert statistics["tables"]["tetrahedra"] == 5 * 27
assert statistics["rays"]["width"] == 120 and statistics["rays"]["rays"] == 120 * 80
assert "cropping" in statistics["left_out"]
assert check(thickness=1)["rebuilt"] == []

mapper.CroppingOn()
mapper.SetCroppingRegionPlanes(-1, 2, -1, 2, 0.4, 2)
assert "cropping" not in check(thickness=0.6)["left_out"]
mapper.CroppingOff()

# The same in a block of a composite.
blocks = vtkMultiBlockDataSet()
blocks.SetBlock(1, cube)
mapper.SetInputData(blocks)
assert mapper.GetBounds() == (0, 1, 0, 1, 0, 1)
check(thickness=1)

# Other optical models: the cube's one colour at its one scalar.
inside = (slice(25, 55), slice(45, 75))
mapper.SetBlendModeToMaximumIntensity()
rgba, _, statistics = scene.render()
assert statistics["segments"]["integration"] == "largest scalar"
assert numpy.abs(rgba[inside] - 0.25 * numpy.array([0.5, 1, 0.25, 1])).max() < 1e-6
mapper.SetBlendModeToAdditive()
rgba, _, _ = scene.render()
assert numpy.abs(rgba[inside] - 0.25 / 0.2 * numpy.array([0.5, 1, 0.25, 0])).max() < 1e-5
mapper.SetBlendModeToAbsorption()
rgba, _, _ = scene.render()
opacity = 1 - math.exp(-0.25 / 0.2)
assert numpy.abs(rgba[inside] - opacity * numpy.array([0, 0, 0, 1])).max() < 1e-5
mapper.SetBlendModeToComposite()

# Through imaginary cells, of which a cube needs none.
mapper.SetReentryToImaginaryCells()
assert check(thickness=1)["rays"]["reentry"] == "boundary hierarchy"
mapper.SetReentryToAutomatic()

for name, value in (
    ("MaximumError", 1e-3),
    ("NumberOfThreads", 1),
    ("Precision", mapper.DOUBLE_PRECISION),
    ("Integration", mapper.TABLE_INTEGRATION),
    ("TableScalarSize", 64),
    ("TableLengthSize", 32),
    ("TableLengthScale", mapper.LOGARITHMIC_SCALE),
    ("TableScalarAxis", mapper.NODES_AXIS),
    ("TableFormat", mapper.HALF_FORMAT),
    ("TableMaximumBytes", 1 << 20),
    ("VectorMode", mapper.MAGNITUDE_MODE),
    ("AutoAdjustSampleDistances", 0),
    ("IntermixIntersectingGeometry", 0),
):
    getattr(mapper, "Set" + name)(value)
    assert getattr(mapper, "Get" + name)() == value
statistics = check(thickness=1)
assert statistics["rays"]["threads"] == 1 and statistics["rays"]["precision"] == "double"
