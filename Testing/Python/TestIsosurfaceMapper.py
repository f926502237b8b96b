# SPDX-License-Identifier: BSD-3-Clause
"""The isosurface mapper is made by name; a plane has its colours, its place, and its shadow."""

import numpy
from vtkmodules.vtkRenderingCore import vtkLight
from vtkmodules.util.numpy_support import numpy_to_vtk

import tetralux
from mapper_scene import MapperScene, get_points, make_property, make_unit_cube, set_scalars

cube = make_unit_cube()
points = get_points(cube)
set_scalars(cube, "Height", points[:, 2])
place = numpy_to_vtk(points, deep=True)
place.SetName("Place")
cube.GetPointData().AddArray(place)

mapper = tetralux.vtkTetrahedraIsosurfaceMapper()
assert mapper.IsA("vtkUnstructuredGridVolumeMapper")
assert mapper.GetStatistics() == "{}"
assert mapper.GetBlendMode() == mapper.ISOSURFACE_BLEND
mapper.SetInputData(cube)

# The camera looks along -z, from 3 before the cube: planes are at right angles to its rays.
volume_property = make_property(
    colors=[(0, 1, 0, 0.5), (1, 0, 1, 0.5)], opacities=[(0, 0.2), (1, 0.6)]
)
volume_property.GetIsoSurfaceValues().SetValue(0, 0.25)
volume_property.GetIsoSurfaceValues().SetValue(1, 0.75)
scene = MapperScene(mapper, volume_property, 120, 80)
scene.look_at_unit_cube()

# The nearer plane, of opacity 0.5, over the farther one of 0.3.
rgba, depth, statistics = scene.render()
inside = (slice(20, 60), slice(40, 80))
assert rgba.shape == (80, 120, 4) and rgba.dtype == numpy.float32
near = 0.5 * numpy.array([0.25, 0.75, 0.5, 1])
far = 0.3 * numpy.array([0.75, 0.25, 0.5, 1])
assert numpy.abs(rgba[inside] - (near + 0.5 * far)).max() < 1e-5
assert (rgba[:20] == 0).all() and (rgba[:, :40] == 0).all()
assert numpy.abs(depth[inside] - 3.25).max() < 1e-5
assert (depth[:20] == -1).all()
assert statistics["method"] == "isosurface"
assert statistics["rays"]["hits"] == 2 * 40 * 40
assert statistics["hierarchy"]["rebuilt"] == ["tree", "ranges", "isopolygons"]
assert mapper.GetErrorEstimate() <= mapper.GetMaximumError()

# Values change at little cost.
volume_property.GetIsoSurfaceValues().SetNumberOfContours(1)
rgba, _, statistics = scene.render()
assert numpy.abs(rgba[inside] - far).max() < 1e-5
assert statistics["hierarchy"]["rebuilt"] == ["isopolygons"]

# Coloured by another array, along x.
mapper.SetColorArrayName("Place")
mapper.SetColorArrayComponent(0)
rgba, _, _ = scene.render()
x = (numpy.arange(40, 80) + 0.5 - 40) / 40
opacity = 0.2 + 0.4 * x
expected = opacity[:, None] * numpy.stack([1 - x, x, numpy.full(40, 0.5), numpy.ones(40)], axis=1)
assert numpy.abs(rgba[inside] - expected[None]).max() < 1e-5
mapper.SetColorArrayName(None)
assert mapper.GetColorArrayName() is None

# Light along (-1, 0, -2): the plane at 0.75 shades all of that at 0.25 but 0.25 at its right side.
volume_property.GetIsoSurfaceValues().SetValue(1, 0.75)
volume_property.ShadeOn()
volume_property.SetAmbient(0.1)
volume_property.SetSpecular(0)
light = vtkLight()
light.SetPosition(1, 0, 2)
light.SetFocalPoint(0, 0, 0)
scene.renderer.RemoveAllLights()  # that of the camera
scene.renderer.AddLight(light)
lit, _, _ = scene.render()
mapper.ShadowsOn()
dark, _, statistics = scene.render()
assert "shadows" not in statistics["left_out"]
assert (dark <= lit).all()
shadow = numpy.abs(dark - lit)[20:60, :, :3].max(axis=2) > 0.01
assert shadow[:, 40:69].all() and not shadow[:, 71:].any() and not shadow[:, :40].any()

# Light from all around comes in samples, and frames that rest add further ones.
mapper.AmbientOcclusionOn()
mapper.SetMaximumSamples(8)
counts = [scene.render()[2]["rays"]["light_samples"] for _ in range(3)]
assert counts == [4, 8, 8]

# One error of one line, of as many frames as there are.
errors = []
mapper.AddObserver("ErrorEvent", lambda *_: errors.append(1))
mapper.SetColorArrayName("Temperature")
scene.window.Render()
scene.window.Render()
assert len(errors) == 1 and tetralux.picture(mapper)[0].shape == (0, 0, 4)
