# SPDX-License-Identifier: BSD-3-Clause
"""Scenes of VTK's own tests of its mappers of unstructured grids, with generated data: exchange the
class name, and every call is there, and all three pictures are the same."""

import numpy
from vtkmodules.util.misc import calldata_type
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.util.vtkConstants import VTK_STRING
from vtkmodules.vtkCommonCore import vtkLookupTable
from vtkmodules.vtkCommonDataModel import (
    VTK_HEXAHEDRON,
    VTK_TETRA,
    vtkMultiBlockDataSet,
    vtkPiecewiseFunction,
    vtkPlane,
)
from vtkmodules.vtkCommonTransforms import vtkTransform
from vtkmodules.vtkFiltersCore import vtkPointDataToCellData
from vtkmodules.vtkFiltersGeneral import vtkDataSetTriangleFilter
from vtkmodules.vtkFiltersSources import vtkCellTypeSource, vtkSphereSource
from vtkmodules.vtkRenderingCore import (
    vtkActor,
    vtkCellCenterDepthSort,
    vtkColorTransferFunction,
    vtkPolyDataMapper,
    vtkRenderer,
    vtkVolume,
    vtkVolumeProperty,
)
from vtkmodules.vtkRenderingVolume import (
    vtkUnstructuredGridBunykRayCastFunction,
    vtkUnstructuredGridHomogeneousRayIntegrator,
    vtkUnstructuredGridLinearRayIntegrator,
    vtkUnstructuredGridPartialPreIntegration,
    vtkUnstructuredGridPreIntegration,
)

import tetralux

CLASSES = [
    tetralux.vtkTetrahedraRayCastMapper,
    tetralux.vtkTetrahedraGPURayCastMapper,
    tetralux.vtkTetrahedraProjectionMapper,
]

TOLERANCE = 1 / 255  # of a channel: one step of a window's colours

SIZE = (60, 45)


def make_grid(cell=VTK_TETRA, blocks=5):
    """Cells from 0 to 1 with scalars from 0 to 255, and the vectors of their places."""
    source = vtkCellTypeSource()
    source.SetCellType(cell)
    source.SetBlocksDimensions(blocks, blocks, blocks)
    source.Update()
    grid = source.GetOutput()
    points = vtk_to_numpy(grid.GetPoints().GetData()).astype(float) / blocks
    grid.GetPoints().SetData(numpy_to_vtk(points, deep=True))
    x, y, z = points.T
    scalars = numpy_to_vtk(255 * (0.5 + 0.5 * numpy.sin(4 * x + y) * numpy.cos(3 * z)), deep=True)
    scalars.SetName("scalars")
    grid.GetPointData().SetScalars(scalars)
    vectors = numpy_to_vtk(255 * points, deep=True)
    vectors.SetName("coords")
    grid.GetPointData().AddArray(vectors)
    return grid


OPACITIES = numpy.array([(0, 0), (80, 0), (120, 0.3), (255, 0.9)])
COLORS = numpy.array([(0, 0, 0, 1), (64, 0, 1, 1), (128, 0, 1, 0), (192, 1, 1, 0), (255, 1, 0, 0)])
UNIT_DISTANCE = 0.3


def make_property():
    opacity = vtkPiecewiseFunction()
    for node in OPACITIES:
        opacity.AddPoint(*node)
    color = vtkColorTransferFunction()
    for node in COLORS:
        color.AddRGBPoint(*node)
    volume_property = vtkVolumeProperty()
    volume_property.SetColor(color)
    volume_property.SetScalarOpacity(opacity)
    volume_property.SetScalarOpacityUnitDistance(UNIT_DISTANCE)
    volume_property.ShadeOff()
    volume_property.SetInterpolationTypeToLinear()
    return volume_property


POSITION = numpy.array((1.8, 1.5, 2.4))
FOCAL_POINT = numpy.array((0.5, 0.5, 0.5))
VIEW_UP = numpy.array((0, 1, 0.1))
VIEW_ANGLE = 30


def march(steps=4000):
    """What a camera sees whose volume is the unit cube with a scalar of 255 y: by small steps."""
    width, height = SIZE
    forward = FOCAL_POINT - POSITION
    forward /= numpy.linalg.norm(forward)
    right = numpy.cross(forward, VIEW_UP)
    right /= numpy.linalg.norm(right)
    up = numpy.cross(right, forward)
    half = numpy.tan(numpy.radians(VIEW_ANGLE) / 2)
    x = (2 * (numpy.arange(width) + 0.5) / width - 1) * half * width / height
    y = (2 * (numpy.arange(height) + 0.5) / height - 1) * half
    rays = forward + x[None, :, None] * right + y[:, None, None] * up
    rays /= numpy.linalg.norm(rays, axis=2, keepdims=True)
    sides = (numpy.array((0, 1))[:, None, None, None] - POSITION) / rays
    near, far = sides.min(axis=0).max(axis=2), sides.max(axis=0).min(axis=2)
    length = numpy.maximum(far - near, 0) / steps
    picture = numpy.zeros((height, width, 4))
    for step in range(steps):
        scalar = 255 * (POSITION[1] + (near + (step + 0.5) * length) * rays[..., 1])
        attenuation = numpy.interp(scalar, *OPACITIES.T) / UNIT_DISTANCE
        visible = (1 - picture[..., 3]) * -numpy.expm1(-attenuation * length)
        for channel in range(3):
            color = numpy.interp(scalar, COLORS[:, 0], COLORS[:, channel + 1])
            picture[..., channel] += visible * color
        picture[..., 3] += visible
    return picture


class Scene:
    """A volume in a window, with the errors and warnings of its mapper."""

    def __init__(self, mapper, volume_property=None):
        self.mapper = mapper
        self.messages = []

        @calldata_type(VTK_STRING)
        def hear(_, event, text):
            if "the estimated error" not in text:  # of single precision on the graphics card
                self.messages.append((event, text))

        mapper.AddObserver("ErrorEvent", hear)
        mapper.AddObserver("WarningEvent", hear)
        self.volume = vtkVolume()
        self.volume.SetMapper(mapper)
        self.volume.SetProperty(volume_property or make_property())
        self.renderer = vtkRenderer()
        self.renderer.SetBackground(0.1, 0.2, 0.3)
        self.renderer.AddVolume(self.volume)
        self.window = tetralux.vtkHeadlessRenderWindow()
        self.window.SetMultiSamples(0)
        self.window.SetSize(*SIZE)
        self.window.AddRenderer(self.renderer)

    def render(self):
        camera = self.renderer.GetActiveCamera()
        camera.SetPosition(POSITION)
        camera.SetFocalPoint(FOCAL_POINT)
        camera.SetViewUp(VIEW_UP)
        self.renderer.ResetCameraClippingRange()
        self.window.Render()
        return tetralux.picture(self.mapper)[0].copy()


def compare(make_scene, warnings=0):
    """make_scene(mapper): a Scene. Returns the pictures, which are the same."""
    pictures = []
    for cls in CLASSES:
        scene = make_scene(cls())
        pictures.append(scene.render())
        assert len(scene.messages) == warnings, (make_scene.__name__, cls, scene.messages)
        assert pictures[-1][..., 3].max() > 0.3, (make_scene.__name__, cls)
        difference = numpy.abs(pictures[-1] - pictures[0]).max()
        assert difference < TOLERANCE, (make_scene.__name__, cls, difference)
    return pictures


def hexahedra(mapper):
    """UnstructuredGridVolumeRayCast of cells that VTK has to split before."""
    split = vtkDataSetTriangleFilter()
    split.SetInputData(make_grid(VTK_HEXAHEDRON))
    mapper.SetInputConnection(split.GetOutputPort())
    return Scene(mapper)


def homogeneous(mapper):
    """HomogeneousRayIntegration: scalars at cells."""
    to_cells = vtkPointDataToCellData()
    to_cells.SetInputData(make_grid())
    mapper.SetInputConnection(to_cells.GetOutputPort())
    mapper.SetRayIntegrator(vtkUnstructuredGridHomogeneousRayIntegrator())
    return Scene(mapper)


def make_integration(integrator):
    def integration(mapper):
        mapper.SetInputData(make_grid())
        scene = Scene(mapper)
        mapper.SetRayIntegrator(integrator())
        mapper.SetRayIntegrator(integrator())
        return scene

    return integration


def projected_tetrahedra(mapper):
    """ProjectedTetrahedra: a program that asks whether it may, and zooms in."""
    mapper.SetInputData(make_grid())
    mapper.SetUseFloatingPointFrameBuffer(True)
    scene = Scene(mapper)
    scene.window.Render()
    assert mapper.IsSupported(scene.window)
    scene.renderer.GetActiveCamera().SetViewAngle(12)
    return scene


def transformed(mapper):
    """TestProjectedTetrahedraTransform."""
    mapper.SetInputData(make_grid())
    scene = Scene(mapper)
    transform = vtkTransform()
    transform.Translate(0.2, -0.1, 0)
    transform.RotateZ(20)
    transform.Scale(0.8, 1.1, 0.7)
    scene.volume.SetUserTransform(transform)
    return scene


def z_sweep(mapper):
    """TestPTZSweep, with a sphere inside of the volume."""
    mapper.SetInputData(make_grid())
    mapper.SetMaxPixelListSize(64)
    mapper.IntermixIntersectingGeometryOn()
    scene = Scene(mapper)
    sphere = vtkSphereSource()
    sphere.SetCenter(0.5, 0.5, 0.5)
    sphere.SetRadius(0.3)
    actor = vtkActor()
    actor.SetMapper(vtkPolyDataMapper())
    actor.GetMapper().SetInputConnection(sphere.GetOutputPort())
    scene.renderer.AddActor(actor)
    return scene


def vector_component(mapper):
    """TestProjectedTetrahedraVectorComponent: y, by the colour function."""
    mapper.SetInputData(make_grid())
    mapper.SetScalarModeToUsePointFieldData()
    mapper.SetArrayAccessMode(1)
    mapper.SelectScalarArray("coords")
    scene = Scene(mapper)
    color = scene.volume.GetProperty().GetRGBTransferFunction()
    color.SetVectorModeToComponent()
    color.SetVectorComponent(1)
    return scene


def blocks(mapper):
    """TestMultiBlockUnstructuredGridVolumeMapper: two, one behind the other."""
    both = vtkMultiBlockDataSet()
    both.SetBlock(0, make_grid())
    both.SetBlock(1, make_grid(blocks=4))
    moved = vtk_to_numpy(both.GetBlock(1).GetPoints().GetData())
    moved -= (0, 0, 1.2)
    mapper.SetInputDataObject(both)
    mapper.SelectScalarArray("scalars")
    mapper.SetScalarMode(3)
    return Scene(mapper)


def exercise(mapper):
    """ExerciseUnstructuredGridRayCastMapper: every call of VTK's ray casters."""
    mapper.SetInputData(make_grid())
    mapper.AutoAdjustSampleDistancesOff()
    mapper.SetMinimumImageSampleDistance(1)
    mapper.SetMaximumImageSampleDistance(4)
    mapper.SetImageSampleDistance(1)
    mapper.SetNumberOfThreads(3)
    mapper.SetIntermixIntersectingGeometry(1)
    mapper.SetBlendModeToComposite()
    mapper.SetMaxPixelListSize(32)
    mapper.UseFloatingPointFrameBufferOn()
    mapper.SetVisibilitySort(None)
    mapper.SetRayIntegrator(None)
    mapper.SetRayCastFunction(None)
    assert mapper.GetImageSampleDistance() == mapper.GetMinimumImageSampleDistance() == 1
    assert mapper.GetMaximumImageSampleDistance() >= 1 and mapper.GetNumberOfThreads() >= 0
    assert not mapper.GetAutoAdjustSampleDistances() and mapper.GetUseFloatingPointFrameBuffer()
    assert mapper.GetRayIntegrator() is None and mapper.GetRayCastFunction() is None
    assert mapper.GetVisibilitySort() is None and mapper.GetMaxPixelListSize() >= 0
    return Scene(mapper)


def clipped(mapper):
    mapper.SetInputData(make_grid())
    plane = vtkPlane()
    plane.SetOrigin(0.5, 0.5, 0.5)
    plane.SetNormal(1, 0.3, 0.2)
    mapper.AddClippingPlane(plane)
    return Scene(mapper)


def test_scenes():
    compare(hexahedra)
    compare(projected_tetrahedra)
    compare(transformed)
    compare(z_sweep)
    expected = march()
    for picture in compare(vector_component):
        assert numpy.abs(picture - expected).max() < TOLERANCE
    compare(blocks)
    compare(clipped)
    pictures = compare(exercise)
    for integrator in (
        vtkUnstructuredGridLinearRayIntegrator,
        vtkUnstructuredGridPartialPreIntegration,
        vtkUnstructuredGridPreIntegration,
    ):
        again = compare(make_integration(integrator), warnings=1)
        assert (again[0] == pictures[0]).all()
    compare(homogeneous)  # the warning was given before anybody listened


def test_calls_that_are_not_used():
    for cls in CLASSES:
        scene = Scene(cls())
        mapper = scene.mapper
        mapper.SetRayCastFunction(vtkUnstructuredGridBunykRayCastFunction())
        mapper.SetRayCastFunction(vtkUnstructuredGridBunykRayCastFunction())
        assert [event for event, _ in scene.messages] == ["WarningEvent"]
        assert "RayCastFunction is not used" in scene.messages[0][1]


def test_other_names():
    scene = Scene(tetralux.vtkTetrahedraProjectionMapper())
    mapper = scene.mapper
    assert mapper.GetVisibilitySort() is None and mapper.GetUseFloatingPointFrameBuffer()
    sort = tetralux.vtkMeshedPolyhedraVisibilitySort()
    sort.SetOrderToNonConvex()
    mapper.SetVisibilitySort(sort)
    assert mapper.GetOrderAsString() == sort.GetOrderAsString() == "non-convex"
    assert mapper.GetVisibilitySort() is sort
    mapper.SetVisibilitySort(vtkCellCenterDepthSort())
    assert mapper.GetOrderAsString() == "centroid"
    mapper.SetVisibilitySort(None)
    assert mapper.GetOrderAsString() == "automatic"
    mapper.UseFloatingPointFrameBufferOff()
    assert mapper.GetColorBufferAsString() == "unorm8"
    assert not mapper.GetUseFloatingPointFrameBuffer()
    mapper.UseFloatingPointFrameBufferOn()
    assert mapper.GetColorBufferAsString() == "automatic"
    mapper.SetColorBufferToHalf()
    mapper.UseFloatingPointFrameBufferOn()
    assert mapper.GetColorBufferAsString() == "half" and not scene.messages


def test_table_of_a_reader():
    """A lookup table that comes with an array says which component is shown."""
    pictures = []
    for component in (0, 2):
        grid = make_grid()
        grid.GetPointData().SetActiveScalars("coords")
        table = vtkLookupTable()
        table.SetVectorModeToComponent()
        table.SetVectorComponent(component)
        grid.GetPointData().GetScalars().SetLookupTable(table)

        def with_table(mapper, grid=grid):
            mapper.SetInputData(grid)
            return Scene(mapper)

        pictures.append(compare(with_table)[0])
    assert (pictures[0] != pictures[1]).any()


if __name__ == "__main__":
    test_scenes()
    test_calls_that_are_not_used()
    test_other_names()
    test_table_of_a_reader()
