# SPDX-License-Identifier: BSD-3-Clause
"""The projection mapper is made by name; a cube has the opacity of its optical depth."""

import math

import numpy

import tetralux
from mapper_scene import MapperScene, get_points, make_property, make_unit_cube, set_scalars

cube = make_unit_cube()
set_scalars(cube, "Ramp", get_points(cube)[:, 0])

mapper = tetralux.vtkTetrahedraProjectionMapper()
assert mapper.IsA("vtkUnstructuredGridVolumeMapper")
assert mapper.GetStatistics() == "{}"
mapper.SetInputData(cube)

# Along z the scalar of a ray is constant: that of its x.
volume_property = make_property(
    colors=[(0, 1, 0, 0.5), (1, 0, 1, 0.5)], opacities=[(0, 0.1), (1, 0.4)], unit_distance=0.2
)
scene = MapperScene(mapper, volume_property, 120, 80)
scene.look_at_unit_cube()

rgba, depth, statistics = scene.render()
assert rgba.shape == (80, 120, 4) and rgba.dtype == numpy.float32
x = (numpy.arange(40, 80) + 0.5 - 40) / 40
alpha = 1 - numpy.exp(-(0.1 + 0.3 * x) / 0.2)
expected = alpha[:, None] * numpy.stack([1 - x, x, numpy.full(40, 0.5), numpy.ones(40)], axis=1)
inside = rgba[20:60, 40:80]
assert numpy.abs(inside - expected[None]).max() < mapper.GetMaximumError()
assert (rgba[:20] == 0).all() and (rgba[:, :40] == 0).all()
assert numpy.abs(depth[20:60, 40:80] - 3).max() < 1e-5
assert (depth[:20] == -1).all()
assert statistics["method"] == "projection"
assert statistics["projection"]["tetrahedra_drawn"] == 5 * 27
assert statistics["projection"]["order"] == "meshed polyhedra, across gaps"
assert statistics["projection"]["cycles"] == 0
assert mapper.GetErrorEstimate() <= mapper.GetMaximumError()

# Absorption alone needs no order.
mapper.SetBlendModeToAbsorption()
rgba, _, statistics = scene.render()
assert statistics["projection"]["order"] == "none" and "order" in statistics["left_out"]
assert numpy.abs(rgba[20:60, 40:80, 3] - alpha[None]).max() < 1e-5
mapper.SetBlendModeToComposite()

# 8 bits a channel.
mapper.SetColorBufferToUNorm8()
rgba, _, statistics = scene.render()
assert statistics["projection"]["color_buffer"] == "8-bit"
assert not statistics["projection"]["alpha_dithering"] # where it is not clearly better
assert "alpha dithering" in statistics["left_out"]
assert numpy.abs(rgba[20:60, 40:80] - expected[None]).mean() < 2 / 255

# More than MaximumError, which one warning says, of as many frames as there are.
warnings = []
mapper.AddObserver("WarningEvent", lambda *_: warnings.append(mapper.GetErrorEstimate()))
mapper.SetMaximumError(1e-3)
scene.render()
assert mapper.GetErrorEstimate() > mapper.GetMaximumError() and not warnings
mapper.SetColorBufferToFloat()
scene.render()
assert mapper.GetErrorEstimate() <= mapper.GetMaximumError() and not warnings
mapper.SetColorBufferToUNorm8()
scene.render()
scene.render()
assert len(warnings) == 1
mapper.SetMaximumError(1e-7)  # nothing is as good as that
scene.render()
mapper.SetMaximumError(1e-4)
scene.render()
assert len(warnings) == 2

for name, value in (
    ("PerspectiveInterpolation", 0),
    ("ColorBuffer", mapper.HALF_BUFFER),
    ("AlphaDithering", 0),
    ("Order", tetralux.vtkMeshedPolyhedraVisibilitySort.CENTROID_ORDER),
):
    getattr(mapper, "Set" + name)(value)
    assert getattr(mapper, "Get" + name)() == value
    assert name + ": " in str(mapper)
assert math.isfinite(scene.render()[0].sum())
