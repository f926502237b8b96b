# SPDX-License-Identifier: BSD-3-Clause
"""Every value of every enumeration has a setter and a name, and picture() gives arrays."""

import re
import subprocess
import sys

import numpy

import tetralux
from mapper_scene import MapperScene, get_points, make_property, make_unit_cube, set_scalars

NUMBERS = range(-3, 21)  # more than any enumeration has

CLASSES = {
    tetralux.vtkTetrahedraRayCastMapper: [
        "BlendMode", "Integration", "MergePoints", "Precision", "Reentry", "TableFormat",
        "TableLengthScale", "TableScalarAxis", "VectorMode",
    ],
    tetralux.vtkTetrahedraGPURayCastMapper: [
        "BlendMode", "Integration", "MergePoints", "Reentry", "TableFormat", "TableLengthScale",
        "TableScalarAxis", "VectorMode",
    ],
    tetralux.vtkTetrahedraProjectionMapper: [
        "BlendMode", "ColorBuffer", "Integration", "MergePoints", "Order", "TableFormat",
        "TableLengthScale", "TableScalarAxis", "VectorMode",
    ],
    tetralux.vtkTetrahedraIsosurfaceMapper: ["MergePoints", "VectorMode"],
    tetralux.vtkTriangleCasterMapper: [
        "BlendMode", "GradientNorm", "GradientSource", "LightSum", "OpacityModel", "SliceShape",
        "VectorMode",
    ],
    tetralux.vtkPreIntegrationTableSource: ["BlendMode", "Format", "LengthScale", "ScalarAxis"],
    tetralux.vtkMeshedPolyhedraVisibilitySort: ["Order"],
}

# What a class inherits and refuses; BlendMode is isosurface, and nothing else.
FOREIGN = {
    tetralux.vtkTetrahedraProjectionMapper: {"Reentry"},
    tetralux.vtkTetrahedraIsosurfaceMapper: {
        "BlendMode", "Integration", "Reentry", "TableFormat", "TableLengthScale",
        "TableScalarAxis",
    },
}


def find_enumerations(cls):
    """Properties with a getter of the name and a setter."""
    names = [name[3:-8] for name in dir(cls) if re.fullmatch("Get.*AsString", name)]
    return [name for name in names if hasattr(cls, f"Set{name}")]


def find_accepted(thing, name):
    """Number -> name of the values that a setter takes; the others give one error each."""
    accepted = {}
    errors = []
    thing.AddObserver("ErrorEvent", lambda *_: errors.append(1))
    for number in NUMBERS:
        before = getattr(thing, f"Get{name}")()
        count = len(errors)
        getattr(thing, f"Set{name}")(number)
        if len(errors) == count:
            accepted[number] = getattr(thing, f"Get{name}AsString")()
            assert getattr(thing, f"Get{name}")() == number
        else:
            assert len(errors) == count + 1 and getattr(thing, f"Get{name}")() == before
    thing.RemoveAllObservers()
    return accepted


def test_enumerations():
    for cls, expected in CLASSES.items():
        names = find_enumerations(cls)
        # ScalarMode is VTK's. Mappers refuse all values of what belongs to others.
        foreign = {"ScalarMode"} | FOREIGN.get(cls, set())
        names = [name for name in names if name not in foreign]
        assert names == expected, (cls, names)
        for name in names:
            thing = cls()
            accepted = find_accepted(thing, name)
            assert len(set(accepted.values())) == len(accepted) >= 2, (name, accepted)
            for number, text in accepted.items():
                setter = f"Set{name}To" + text.replace("-", "")
                matching = [method for method in dir(cls) if method.lower() == setter.lower()]
                assert len(matching) == 1, (cls, setter)
                getattr(thing, matching[0])()
                assert getattr(thing, f"Get{name}")() == number
                line = f"\n  {name}: {text}\n"
                assert line in str(thing), (line, str(thing))


def test_refused_enumerations():
    for cls, names in FOREIGN.items():
        for name in names:
            accepted = find_accepted(cls(), name)
            assert len(accepted) == (name == "BlendMode"), (cls, name, accepted)
    assert tetralux.vtkTetrahedraIsosurfaceMapper().GetBlendModeAsString() == "isosurface"


def test_picture():
    cube = make_unit_cube()
    set_scalars(cube, "Ramp", get_points(cube)[:, 1])
    mapper = tetralux.vtkTetrahedraRayCastMapper()
    rgba, depth = tetralux.picture(mapper)
    assert rgba.shape == (0, 0, 4) and depth.shape == (0, 0)
    mapper.SetInputData(cube)
    # Absorption grows upwards; the camera looks along -z, and nothing is above the cube.
    volume_property = make_property([(0, 1, 1, 1), (1, 1, 1, 1)], [(0, 0.1), (1, 0.9)])
    scene = MapperScene(mapper, volume_property, 30, 20)
    scene.look_at_unit_cube()
    scene.window.Render()
    rgba, depth = tetralux.picture(mapper)
    assert rgba.shape == (20, 30, 4) and depth.shape == (20, 30)
    assert rgba.dtype == depth.dtype == numpy.float32
    column = rgba[5:15, 15, 3]
    assert (numpy.diff(column) > 0).all()
    assert (rgba[..., 3] > 0).sum() == (depth > 0).sum() == 100
    assert (depth[rgba[..., 3] == 0] == -1).all()
    kept = rgba.copy()
    volume_property.SetScalarOpacityUnitDistance(2)
    scene.window.Render()
    assert (rgba == kept).all() and (tetralux.picture(mapper)[0] != kept).any()


def test_numpy_is_imported_when_needed():
    program = "import sys, tetralux; sys.exit('numpy' in sys.modules)"
    subprocess.run([sys.executable, "-c", program], check=True)


if __name__ == "__main__":
    test_enumerations()
    test_refused_enumerations()
    test_picture()
    test_numpy_is_imported_when_needed()
