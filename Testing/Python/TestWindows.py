# SPDX-License-Identifier: BSD-3-Clause
"""Each mapper in each kind of window, and whichever goes first in the end: the rows of the tables
in Documentation/windows.md."""

import gc

import numpy
import tetralux
import vtkmodules.vtkRenderingOpenGL2 as opengl
from mapper_scene import get_points, make_unit_cube, set_scalars
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPiecewiseFunction
from vtkmodules.vtkRenderingCore import (
    vtkColorTransferFunction,
    vtkRenderer,
    vtkRenderWindow,
    vtkVolume,
    vtkVolumeProperty,
    vtkWindowToImageFilter,
)

SIZE = (48, 36)
TOLERANCE = 2  # of 255: both pictures are rounded, by two ways into a window
EDGE_TOLERANCE = 4  # the same at edges with samples
MAPPERS = (
    tetralux.vtkTetrahedraRayCastMapper,
    tetralux.vtkTetrahedraGPURayCastMapper,
    tetralux.vtkTetrahedraProjectionMapper,
    tetralux.vtkTetrahedraIsosurfaceMapper,
    tetralux.vtkTriangleCasterMapper,
)


def has_picture(mapper):
    return mapper.GetOutputImage().GetNumberOfPoints() > 0


def make_renderer(volume):
    renderer = vtkRenderer()
    renderer.AddVolume(volume)
    camera = renderer.GetActiveCamera()
    camera.SetPosition(1.4, 1.6, 3.2)
    camera.SetFocalPoint(0.5, 0.5, 0.5)
    camera.SetClippingRange(0.5, 8)
    return renderer


def make_volume(mapper):
    cube = make_unit_cube()
    x, y, z = get_points(cube).T
    set_scalars(cube, "field", numpy.sin(3 * x) * numpy.cos(2 * y + z))
    mapper.SetInputDataObject(cube)
    color = vtkColorTransferFunction()
    color.AddRGBPoint(-1, 0.1, 0.2, 0.9)
    color.AddRGBPoint(1, 1, 0.4, 0)
    opacity = vtkPiecewiseFunction()
    opacity.AddPoint(-1, 0.3)
    opacity.AddPoint(1, 0.9)
    volume_property = vtkVolumeProperty()
    volume_property.SetColor(color)
    volume_property.SetScalarOpacity(opacity)
    volume_property.GetIsoSurfaceValues().SetValue(0, 0.2)
    volume = vtkVolume()
    volume.SetMapper(mapper)
    volume.SetProperty(volume_property)
    return volume


def grab(window):
    grabber = vtkWindowToImageFilter()
    grabber.SetInput(window)
    grabber.ReadFrontBufferOff()
    grabber.ShouldRerenderOff()
    grabber.Update()
    image = grabber.GetOutput()
    width, height, _ = image.GetDimensions()
    pixels = vtk_to_numpy(image.GetPointData().GetScalars())
    return pixels.reshape(height, width, -1)[..., :3].astype(int)


class Foreign:
    """A window of VTK in a context that another window made, as toolkits do it."""

    def __init__(self):
        self.host = host = vtkRenderWindow()
        host.SetShowWindow(False)
        host.SetSize(*SIZE)
        host.Initialize()
        host.MakeCurrent()
        self.window = opengl.vtkGenericOpenGLRenderWindow()
        self.window.SetReadyForRendering(True)
        self.window.SetSupportsOpenGL(1)
        self.window.SetOwnContext(0)
        self.window.SetIsCurrent(True)
        self.window.AddObserver("WindowMakeCurrentEvent", lambda *_: host.MakeCurrent())
        self.window.OpenGLInitContext()
        self.window.OpenGLInit()
        self.window.SetFrameBlitModeToNoBlit()


HOSTS = []  # live as long as the contexts that they lend


def make_headless():
    return tetralux.vtkHeadlessRenderWindow()


def make_shown():
    return vtkRenderWindow()


def make_off_screen():
    window = vtkRenderWindow()
    window.SetOffScreenRendering(1)
    return window


def make_hidden():
    window = vtkRenderWindow()
    window.SetShowWindow(False)
    return window


def make_foreign():
    foreign = Foreign()
    HOSTS.append(foreign.host)
    return foreign.window


CONTEXTS = {
    "`vtkHeadlessRenderWindow`": make_headless,
    "`vtkXOpenGLRenderWindow`, shown": make_shown,
    "`vtkXOpenGLRenderWindow`, not shown": make_hidden,
    "`vtkXOpenGLRenderWindow`, `OffScreenRendering`": make_off_screen,
    "`vtkGenericOpenGLRenderWindow`, context of others": make_foreign,
}
if hasattr(opengl, "vtkEGLRenderWindow"):
    CONTEXTS["`vtkEGLRenderWindow`"] = opengl.vtkEGLRenderWindow


class Scene:
    def __init__(self, make_mapper, make_window=make_headless, samples=0, mapper=None):
        self.mapper = mapper or make_mapper()
        self.volume = make_volume(self.mapper)
        self.renderer = make_renderer(self.volume)
        self.window = make_window()
        self.window.SetMultiSamples(samples)
        self.window.SetSize(*SIZE)
        self.window.AddRenderer(self.renderer)

    def render(self):
        self.window.Render()
        return grab(self.window)

    def end(self):
        self.volume = self.renderer = self.window = self.mapper = None
        gc.collect()


def expect_same(found, expected, tolerance=TOLERANCE):
    assert found.shape == expected.shape, (found.shape, expected.shape)
    worst = numpy.abs(found - expected).max()
    assert worst <= tolerance, worst


# What ends, and in which order. Each is given a scene that has drawn, and the picture of it.


def window_first(scene, _):
    mapper = scene.mapper
    scene.renderer = scene.volume = scene.window = None
    gc.collect()
    assert not has_picture(mapper)


def mapper_first(scene, _):
    scene.volume.SetMapper(None)  # VTK gives an error if it draws the volume then
    scene.mapper = None
    gc.collect()


def renderer_first(scene, _):
    scene.window.RemoveRenderer(scene.renderer)
    scene.renderer = None
    gc.collect()
    scene.window.Render()  # of nothing: it shows what it did
    mapper = scene.mapper
    scene.end()
    assert not has_picture(mapper)


def volume_first(scene, _):
    scene.renderer.RemoveVolume(scene.volume)
    scene.volume = None
    gc.collect()
    assert (scene.render() == 0).all()


def back_after_removal(scene, expected):
    scene.renderer.RemoveVolume(scene.volume)
    assert (scene.render() == 0).all()
    scene.renderer.AddVolume(scene.volume)
    expect_same(scene.render(), expected)


def finalized(scene, expected):
    scene.window.Finalize()
    assert not has_picture(scene.mapper)
    if scene.window.IsA("vtkHeadlessRenderWindow") or scene.window.IsA("vtkXOpenGLRenderWindow"):
        expect_same(scene.render(), expected)


def released(scene, expected):
    scene.mapper.ReleaseGraphicsResources(scene.window)
    assert not has_picture(scene.mapper)
    expect_same(scene.render(), expected)


def other_window(scene, expected):
    """The renderer moves into a new window of the kind, the old one goes."""
    if scene.window.IsA("vtkHeadlessRenderWindow"):
        window = make_headless()
    elif scene.window.IsA("vtkGenericOpenGLRenderWindow"):
        window = make_foreign()
    else:
        window = make_hidden()
    scene.window.RemoveRenderer(scene.renderer)
    window.SetMultiSamples(0)
    window.SetSize(*SIZE)
    window.AddRenderer(scene.renderer)
    scene.window = window
    gc.collect()
    expect_same(scene.render(), expected)


def another_mapper(scene, expected):
    """Another mapper takes the place of one that has drawn, which then draws elsewhere."""
    before = scene.mapper
    scene.volume.SetMapper(type(before)())
    scene.volume.GetMapper().SetInputDataObject(before.GetDataObjectInput())
    expect_same(scene.render(), expected)
    other = Scene(type(before), mapper=before)
    expect_same(other.render(), expected)
    assert has_picture(before)


ENDS = {
    "window before mapper": window_first,
    "mapper before window": mapper_first,
    "renderer first": renderer_first,
    "volume first": volume_first,
    "volume removed, and back": back_after_removal,
    "`Finalize`, and again": finalized,
    "`ReleaseGraphicsResources`, and again": released,
    "renderer into another window": other_window,
    "another mapper in its place": another_mapper,
}


# Ways to use a window. Each returns the picture that is expected, and the one that was found.


def of_samples(samples):
    def use(make_mapper):
        scene = Scene(make_mapper, samples=samples)
        found = scene.render()
        # As far as pixels have no edges, the same; a mean of samples at edges, at most their range.
        plain = Scene(make_mapper).render()
        assert (found != plain).any()
        neighbours = [numpy.roll(plain, shift, (0, 1)) for shift in numpy.ndindex(3, 3)]
        neighbours = numpy.array([numpy.roll(n, (-1, -1), (0, 1)) for n in neighbours])
        lowest, highest = neighbours.min(axis=0), neighbours.max(axis=0)
        return numpy.clip(found, lowest, highest), found, EDGE_TOLERANCE

    return use


def samples_change(make_mapper):
    scene = Scene(make_mapper, samples=4)
    sampled = scene.render()
    scene.window.SetMultiSamples(0)
    expect_same(scene.render(), Scene(make_mapper).render())
    scene.window.SetMultiSamples(4)
    return sampled, scene.render()


def size_changes(make_mapper):
    scene = Scene(make_mapper)
    scene.render()
    scene.window.SetSize(SIZE[0] + 17, SIZE[1] + 9)
    scene.render()
    scene.window.SetSize(*SIZE)
    return Scene(make_mapper).render(), scene.render()


def two_viewports(make_mapper):
    scene = Scene(make_mapper)
    second = make_renderer(make_volume(make_mapper()))
    scene.renderer.SetViewport(0, 0, 0.5, 1)
    second.SetViewport(0.5, 0, 1, 1)
    scene.window.AddRenderer(second)
    both = scene.render()
    half = SIZE[0] // 2
    return both[:, :half], both[:, half:], 0


def one_mapper_in_two_viewports(make_mapper):
    scene = Scene(make_mapper)
    second = make_renderer(scene.volume)
    scene.renderer.SetViewport(0, 0, 0.5, 1)
    second.SetViewport(0.5, 0, 1, 1)
    scene.window.AddRenderer(second)
    both = scene.render()
    half = SIZE[0] // 2
    assert both.max() > 50
    return both[:, :half], both[:, half:], 0


def layers(make_mapper):
    """An empty layer in front changes nothing."""
    scene = Scene(make_mapper)
    front = vtkRenderer()
    front.SetLayer(1)
    scene.window.SetNumberOfLayers(2)
    scene.window.AddRenderer(front)
    return Scene(make_mapper).render(), scene.render()


def windows_by_turns(make_mapper):
    first = Scene(make_mapper)
    second = Scene(make_mapper, mapper=first.mapper)
    expected = first.render()
    for scene in (second, first, second):
        expect_same(scene.render(), expected)
    first.end()
    return expected, second.render()


def windows_of_both_kinds(first_kind, second_kind):
    def use(make_mapper):
        first = Scene(make_mapper, first_kind)
        second = Scene(make_mapper, second_kind, mapper=first.mapper)
        expected = first.render()
        expect_same(second.render(), expected)
        expect_same(first.render(), expected)
        first.end()
        return expected, second.render()

    return use


def eye(make_mapper, right, samples=0):
    scene = Scene(make_mapper, samples=samples)
    scene.window.SetStereoTypeToRight() if right else scene.window.SetStereoTypeToLeft()
    scene.window.StereoRenderOn()
    return scene.render()


def stereo(kind, combine):
    def use(make_mapper):
        scene = Scene(make_mapper)
        getattr(scene.window, "SetStereoTypeTo" + kind)()
        scene.window.StereoRenderOn()
        left, right = eye(make_mapper, False), eye(make_mapper, True)
        assert numpy.abs(left - right).max() > TOLERANCE
        return combine(left, right), scene.render()

    return use


def interlace(left, right):
    result = left.copy()
    result[1::2] = right[1::2]
    return result


def checker(left, right):
    rows, columns = numpy.indices(left.shape[:2])
    return numpy.where(((rows + columns) % 2 == 0)[..., None], left, right)


def red_blue(left, right):
    result = numpy.zeros_like(left)
    result[..., 0] = left.mean(axis=2)
    result[..., 2] = right.mean(axis=2)
    return result


def by_ray_caster(left, right):
    """Mixed by VTK from both eyes' pictures: as that of vtkTetrahedraRayCastMapper."""
    return None


USES = {
    "`MultiSamples` 4": of_samples(4),
    "`MultiSamples` 8": of_samples(8),
    "`MultiSamples` that changes": samples_change,
    "size that changes": size_changes,
    "two renderers side by side": two_viewports,
    "one mapper in two renderers": one_mapper_in_two_viewports,
    "layers": layers,
    "one mapper in two windows": windows_by_turns,
    "one mapper, headless then display": windows_of_both_kinds(make_headless, make_hidden),
    "one mapper, display then headless": windows_of_both_kinds(make_hidden, make_headless),
    "stereo: left": stereo("Left", lambda left, right: left),
    "stereo: right": stereo("Right", lambda left, right: right),
    "stereo: interlaced": stereo("Interlaced", interlace),
    "stereo: checkerboard": stereo("Checkerboard", checker),
    "stereo: red and blue": stereo("RedBlue", red_blue),
    "stereo: Dresden": stereo("Dresden", by_ray_caster),
    "stereo: anaglyph": stereo("Anaglyph", by_ray_caster),
    "stereo: split": stereo("SplitViewportHorizontal", by_ray_caster),
}


VOLUME_MAPPERS = MAPPERS[:3]  # whose pictures are the same
BRIEFLY = ("window before mapper", "volume removed, and back", "`Finalize`, and again")


def run():
    by_rays = {}
    failures = []

    def attempt(label, make_mapper, function):
        try:
            function()
        except AssertionError as error:
            failures.append(f"{label}, {make_mapper.__name__}: {error}")

    for make_mapper in MAPPERS:
        expected = Scene(make_mapper).render()
        assert expected.max() > 50
        for kind, make_window in CONTEXTS.items():
            for end, function in ENDS.items():
                if make_window in (make_shown, make_off_screen) and end not in BRIEFLY:
                    continue  # the same context as make_hidden

                def end_scene(make_window=make_window, function=function):
                    scene = Scene(make_mapper, make_window)
                    expect_same(scene.render(), expected)
                    function(scene, expected)
                    scene.end()

                attempt(f"{kind}, {end}", make_mapper, end_scene)
        for use, function in USES.items():

            def use_window(use=use, function=function):
                picture, found, *tolerance = function(make_mapper)
                if picture is not None:
                    expect_same(found, picture, *tolerance)
                if make_mapper in VOLUME_MAPPERS:
                    expect_same(found, by_rays.setdefault(use, found), EDGE_TOLERANCE)

            attempt(use, make_mapper, use_window)
    assert not failures, "\n".join(failures)


run()
