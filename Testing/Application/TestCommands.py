# SPDX-License-Identifier: BSD-3-Clause
"""What the commands do when all is right; with real data where TETRALUX_DATA names its folder."""

import json
import os
import pty
import re
import threading
import time
import unittest

from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOImage import vtkPNGReader
from vtkmodules.vtkIOXML import (
    vtkXMLImageDataReader, vtkXMLImageDataWriter, vtkXMLUnstructuredGridReader,
    vtkXMLUnstructuredGridWriter,
)
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy

import numpy

import tool
from tool import ToolTest

PRESET = {
    "Name": "steps",
    "ColorSpace": "RGB",
    "RGBPoints": [0, 1, 0, 0, 0.5, 1, 0, 0, 0.5, 0, 0, 1, 1, 0, 0, 1],
    "Points": [0, 0.2, 0.5, 0, 1, 0.8, 0.5, 0],
}

GENERATORS = [
    "ring", "ball", "swinging-ball", "cylinder-with-hole", "boundary-layer", "gear",
    "helical-gear", "heat-sink", "schoenhardt", "cubes", "cavity", "shared-edge", "checkerboard",
    "cycle", "random",
]


class Commands(ToolTest):
    def read_png(self, name):
        """Rows from the bottom, 0..1."""
        reader = vtkPNGReader()
        reader.SetFileName(self.path(name))
        reader.Update()
        image = reader.GetOutput()
        width, height, _ = image.GetDimensions()
        return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, 3) / 255

    def read_vti(self, name):
        reader = vtkXMLImageDataReader()
        reader.SetFileName(self.path(name))
        reader.Update()
        image = reader.GetOutput()
        width, height, _ = image.GetDimensions()
        points = image.GetPointData()
        colors = vtk_to_numpy(points.GetArray("RGBA")).reshape(height, width, 4)
        depth = vtk_to_numpy(points.GetArray("Depth")).reshape(height, width)
        return colors, depth

    def test_help(self):
        text = self.succeed("--help")
        for word in ("render", "info", "generate", "bench", "Exit status"):
            self.assertIn(word, text)
        text = self.succeed("render", "--help")
        for option in (
            "--array --component --method --transfer --opacity-unit-distance --camera-position "
            "--camera-focal-point --camera-view-up --camera-view-angle --camera-parallel-scale "
            "--size --background --shade --max-error --set --list-properties --threads --stats "
            "--output --plot3d-q --isovalues --color-array"
        ).split():
            self.assertIn(option, text)
        self.assertIn("--plot3d-q", self.succeed("info", "--help"))
        self.assertIn("--list", self.succeed("generate", "--help"))
        self.assertRegex(self.succeed("--version"), r"^\d+\.\d+\.\d+\n$")

    def write_image(self, name, values, spacing=(1, 1, 1), of_cells=False):
        """values: along z, y and x, of points or cells."""
        image = vtkImageData()
        size = [count + of_cells for count in values.shape[::-1]]
        image.SetExtent(2, 1 + size[0], -3, size[1] - 4, 0, size[2] - 1)
        image.SetSpacing(spacing)
        array = numpy_to_vtk(values.ravel(), deep=True)
        array.SetName("Field")
        (image.GetCellData() if of_cells else image.GetPointData()).AddArray(array)
        writer = vtkXMLImageDataWriter()
        writer.SetFileName(self.path(name))
        writer.SetInputData(image)
        writer.Write()

    def render_image(self, *arguments):
        """The picture of an image and its method."""
        self.succeed(
            "render", "image.vti", "--size", "60,50", *arguments,
            "--stats", "s.json", "--output", "out.vti",
        )
        with open(self.path("s.json"), encoding="utf-8") as file:
            return self.read_vti("out.vti")[0], json.load(file)

    def test_image_data(self):
        z, y, x = numpy.mgrid[0:9, 0:11, 0:14]
        field = 50 + 16 * (numpy.sin(0.5 * x) + numpy.sin(0.6 * y + 1) + numpy.cos(0.7 * z))
        self.write_image("image.vti", field.astype(numpy.uint8), spacing=(0.5, 0.6, 0.7))
        picture, statistics = self.render_image()
        self.assertEqual(statistics["method"], "triangle-caster")
        self.assertIn("image data", statistics["method_reason"])
        self.assertEqual(statistics["input"]["dimensions"], [14, 11, 9])
        self.assertEqual(statistics["input"]["copied_bytes"], 0)
        self.assertGreater(picture[:, :, 3].max(), 0.5)
        self.assertGreater((picture[:, :, 3] > 0).mean(), 0.1)
        named, statistics = self.render_image("--method", "triangle-caster")
        self.assertTrue((named == picture).all())
        self.assertNotIn("method_reason", statistics)
        # As cells, which by the same optical model are nearly the same picture.
        model = ["--set", "OpacityModel=attenuation"]
        picture, statistics = self.render_image(*model, "--set", "SampleDistance=0.1")
        self.assertEqual(statistics["slices"]["distance"], 0.1)
        cells, statistics = self.render_image("--method", "ray-cast")
        self.assertEqual(statistics["tables"]["tetrahedra"], 5 * 13 * 10 * 8)
        self.assertLess(abs(picture - cells).max(), 0.06)
        lit, statistics = self.render_image(*model, "--shade")
        self.assertEqual(statistics["method"], "triangle-caster")
        self.assertNotIn("shading", statistics["left_out"])
        self.assertGreater(abs(picture - lit).max(), 0.1)
        self.succeed("render", "image.vti", "--size", "40,30", "--output", "out.png")
        self.assertEqual(self.read_png("out.png").shape, (30, 40, 3))
        self.assertGreater(self.read_png("out.png").max(), 0.2)

        rows = {}
        for line in self.succeed("info", "image.vti").splitlines():
            rows[line[:28].strip()] = line[28:].strip()
        self.assertEqual(rows["type"], "vtkImageData")
        self.assertEqual(rows["points"], "1386: 14 x 11 x 9")
        self.assertEqual(rows["spacing"], "0.5, 0.6, 0.7")
        self.assertEqual(rows["extent from"], "2, -3, 0")
        self.assertIn("x 1 .. 7.5", rows["bounds"])
        self.assertIn("unsigned char", rows["point array Field"])

    def test_blend_modes_of_image_data(self):
        z, y, x = numpy.mgrid[0:9, 0:11, 0:14]
        self.write_image("image.vti", (7.0 * x + y + z).astype(numpy.float32))
        named = ["--method", "triangle-caster"]
        pictures = [self.render_image(*named)[0]]
        for blend in (
            ["BlendMode=maximum-intensity"], ["BlendMode=minimum-intensity"],
            ["BlendMode=average-intensity"], ["BlendMode=additive"],
            ["BlendMode=average-intensity", "--set", "AverageIPScalarRange=20,50"],
            ["BlendMode=isosurface", "--isovalues", "30,70"],
            ["BlendMode=slice", "--slice-plane", "4,4,4,0,0.2,1"],
        ):
            with self.subTest(blend=blend):
                picture, statistics = self.render_image(*named, "--set", *blend)
                self.assertEqual(statistics["slices"]["blend_mode"], blend[0].split("=")[1])
                self.assertTrue(all(abs(picture - other).max() > 0.05 for other in pictures))
                pictures.append(picture)
        # Isovalues mean isosurfaces, by cells and lit if no method is named.
        surfaces, statistics = self.render_image(*named, "--isovalues", "30,70")
        self.assertTrue((surfaces == pictures[-2]).all())
        _, statistics = self.render_image("--isovalues", "30,70")
        self.assertEqual(statistics["method"], "isosurface")
        _, statistics = self.render_image("--set", "BlendMode=average-intensity")
        self.assertEqual(statistics["method"], "triangle-caster")

    def test_image_data_by_cells_where_the_caster_lacks_something(self):
        values = numpy.arange(60, dtype=numpy.float32).reshape(3, 4, 5)
        self.write_image("image.vti", values)
        self.assertEqual(self.render_image()[1]["method"], "triangle-caster")
        for arguments in (
            ["--isovalues", "20"], ["--set", "BlendMode=absorption"], ["--set", "MergePoints=off"],
        ):
            with self.subTest(arguments=arguments):
                _, statistics = self.render_image(*arguments)
                self.assertNotEqual(statistics["method"], "triangle-caster")
        self.write_image("image.vti", values, of_cells=True)
        self.assertNotEqual(self.render_image()[1]["method"], "triangle-caster")
        self.assertIn("time to prepare", self.succeed("info", "image.vti"))

    def test_every_generator_with_its_defaults_has_a_field(self):
        text = self.succeed("generate", "--list")
        names = [line.split(":")[0] for line in text.splitlines() if not line.startswith(" ")]
        self.assertEqual(names, GENERATORS)
        for name in names:
            with self.subTest(name=name):
                self.succeed("generate", name, "--output", "mesh.vtu")
                reader = vtkXMLUnstructuredGridReader()
                reader.SetFileName(self.path("mesh.vtu"))
                reader.Update()
                grid = reader.GetOutput()
                self.assertGreater(grid.GetNumberOfCells(), 0)
                field = vtk_to_numpy(grid.GetPointData().GetScalars())
                self.assertEqual(len(field), grid.GetNumberOfPoints())
                self.assertLess(field.min(), field.max())
        self.assertEqual(self.files(), {"mesh.vtu"})

    def test_generator_parameters(self):
        sizes = {}
        for cells in (4, 8):
            for form in (["--cells", str(cells)], [f"--cells={cells}"]):
                self.succeed("generate", "ball", *form, "--output", "ball.vtu")
                text = self.succeed("info", "ball.vtu")
                sizes.setdefault(cells, set()).add(
                    next(line for line in text.splitlines() if line.startswith("tetrahedra "))
                )
        self.assertEqual(len(sizes[4]), 1)
        self.assertEqual(len(sizes[8]), 1)
        self.assertNotEqual(sizes[4], sizes[8])

    def test_time_steps(self):
        os.mkdir(self.path("steps"))
        for name, moves in (("ring", "field"), ("swinging-ball", "points")):
            with self.subTest(name=name):
                arguments = ("--around", 24, "--across", 3) if name == "ring" else ("--cells", 6)
                self.succeed(
                    "generate", name, *arguments, "--steps", 3, "--output", f"steps/{name}.pvd"
                )
                text = self.succeed("info", f"steps/{name}.pvd")
                self.assertRegex(text, r"time steps +3: 0, 0\.333333, 0\.666667")
                grids = []
                for step in range(3):
                    reader = vtkXMLUnstructuredGridReader()
                    reader.SetFileName(self.path(f"steps/{name}_{step:04}.vtu"))
                    reader.Update()
                    grids.append(reader.GetOutput())
                points = [vtk_to_numpy(grid.GetPoints().GetData()) for grid in grids]
                fields = [vtk_to_numpy(grid.GetPointData().GetScalars()) for grid in grids]
                self.assertEqual((points[0] != points[1]).any(), moves == "points")
                self.assertEqual((fields[0] != fields[1]).any(), moves == "field")
                pictures = []
                for step in range(2):
                    self.succeed(
                        "render", f"steps/{name}.pvd", "--time-step", step, "--size", "60,60",
                        "--output", "m.vti",
                    )
                    pictures.append(self.read_vti("m.vti")[0])
                self.assertGreater(abs(pictures[0] - pictures[1]).max(), 0.02)

    def test_info(self):
        self.succeed("generate", "ball", "--cells", 6, "--output", "ball.vtu")
        rows = {}
        for line in self.succeed("info", "ball.vtu").splitlines():
            rows[line[:28].strip()] = line[28:].strip()
        self.assertEqual(rows["file"], "ball.vtu")
        self.assertEqual(rows["type"], "vtkUnstructuredGrid")
        self.assertEqual(rows["cells"], rows["vtkTetra"])
        self.assertEqual(rows["tetrahedra"], rows["cells"])
        self.assertEqual(rows["components"], "1")
        self.assertIn("..", rows["point array Field"])
        self.assertIn("microseconds a tetrahedron", rows["time to prepare"])
        self.assertRegex(rows["memory of the tables"], r"MB$")
        self.assertGreater(int(rows["boundary faces"]), 0)

    def test_all_methods_make_the_same_picture(self):
        # A wall, so that rays leave and enter again.
        self.succeed("generate", "ring", "--around", 24, "--across", 3, "--output", "m.vtu")
        for further in (
            [], ["--shade"], ["--isovalues", "0.3,0.6"], ["--set", "BlendMode=additive"],
        ):
            with self.subTest(further=further):
                pictures = {}
                # Isosurfaces are traced unless a method is named.
                automatic = {"ray-cast", "gpu-ray-cast", "projection"}
                methods = ["auto", "ray-cast", "gpu-ray-cast", "projection"]
                if "--isovalues" in further:
                    automatic = {"isosurface"}
                    methods.append("isosurface")
                for method in methods:
                    self.succeed(
                        "render", "m.vtu", "--size", "80,60", "--method", method, *further,
                        "--stats", "s.json", "--output", "m.vti",
                    )
                    pictures[method], _ = self.read_vti("m.vti")
                    with open(self.path("s.json"), encoding="utf-8") as file:
                        statistics = json.load(file)
                    if method == "auto":
                        # With OpenGL in software, as in most tests, or on a graphics card.
                        self.assertIn(statistics["method"], automatic)
                        self.assertGreater(len(statistics["method_reason"]), 10)
                    else:
                        self.assertEqual(statistics["method"], method)
                        self.assertNotIn("method_reason", statistics)
                self.assertGreater(pictures["ray-cast"].max(), 0.3)
                for method in methods:
                    error = abs(pictures[method] - pictures["ray-cast"]).max(axis=2)
                    # Silhouette pixels may differ by what the ray grazes.
                    self.assertLess(numpy.quantile(error, 0.99), 1e-4, method)
                    self.assertLess(error.max(), 1 / 255, method)

    def test_isosurfaces_coloured_by_another_array(self):
        self.succeed("generate", "ball", "--cells", 8, "--output", "ball.vtu")
        reader = vtkXMLUnstructuredGridReader()
        reader.SetFileName(self.path("ball.vtu"))
        reader.Update()
        grid = reader.GetOutput()
        places = vtk_to_numpy(grid.GetPoints().GetData()).astype(float)
        array = numpy_to_vtk(places, deep=True)
        array.SetName("Place")
        grid.GetPointData().AddArray(array)
        radius = numpy_to_vtk(numpy.linalg.norm(places, axis=1), deep=True)
        radius.SetName("Radius")
        grid.GetPointData().AddArray(radius)
        writer = vtkXMLUnstructuredGridWriter()
        writer.SetInputData(grid)
        writer.SetFileName(self.path("places.vtu"))
        writer.Write()
        # Red grows with the component, from the left to the right of the picture, and is constant
        # for the magnitude, which is that of the surface.
        self.write("red.json", json.dumps({
            "RGBPoints": [-1, 0, 0, 1, 1, 1, 0, 0], "Points": [-1, 1, 0.5, 0, 1, 1, 0.5, 0],
        }))
        shares = {}
        for settings in ((), ("--set", "ColorArrayComponent=0")):
            self.succeed(
                "render", "places.vtu", "--array", "Radius", "--isovalues", "0.7",
                "--color-array", "Place", *settings, "--transfer", "red.json",
                "--camera-position", "0,0,5", "--camera-parallel-scale", 1, "--size", "40,40",
                "--stats", "s.json", "--output", "c.vti",
            )
            with open(self.path("s.json"), encoding="utf-8") as file:
                self.assertEqual(json.load(file)["method"], "isosurface")
            colors, _ = self.read_vti("c.vti")
            row = colors[20, 8:32]
            self.assertTrue((row[:, 3] == 1).all())
            # Green is what shines.
            red, blue = row[:, 0] - row[:, 1], row[:, 2] - row[:, 1]
            shares[settings] = red / (red + blue)
        magnitude, component = shares.values()
        self.assertLess(abs(magnitude - 0.85).max(), 0.02)
        x = (numpy.arange(8, 32) + 0.5 - 20) / 20
        self.assertLess(abs(component - (1 + x) / 2).max(), 0.02)

    def test_auto_takes_the_method_that_has_the_property(self):
        self.succeed("generate", "ball", "--cells", 4, "--output", "ball.vtu")
        self.succeed(
            "render", "ball.vtu", "--set", "Precision=2", "--stats", "s.json", "--output", "b.png"
        )
        with open(self.path("s.json"), encoding="utf-8") as file:
            statistics = json.load(file)
        self.assertEqual(statistics["method"], "ray-cast")
        self.assertIn("Precision", statistics["method_reason"])

    def test_the_two_outputs_are_one_picture(self):
        self.succeed("generate", "ball", "--cells", 10, "--output", "ball.vtu")
        view = ["--size", "60,40", "--background", "0.2,0.4,0.6"]
        self.succeed("render", "ball.vtu", *view, "--output", "ball.png")
        self.succeed("render", "ball.vtu", *view, "--output", "ball.vti")
        self.assertEqual(self.files(), {"ball.vtu", "ball.png", "ball.vti"})
        colors, depth = self.read_vti("ball.vti")
        self.assertEqual(colors.shape, (40, 60, 4))
        self.assertEqual(colors.dtype, numpy.float32)
        self.assertEqual(depth.dtype, numpy.float32)
        opacity = colors[:, :, 3]
        self.assertTrue(((opacity > 0) == (depth >= 0)).all())
        self.assertTrue((depth[opacity == 0] == -1).all())
        self.assertGreater((opacity > 0.01).mean(), 0.1)
        over = colors[:, :, :3] + (1 - opacity[:, :, None]) * numpy.array([0.2, 0.4, 0.6])
        self.assertLess(abs(over - self.read_png("ball.png")).max(), 0.5001 / 255)

    def test_camera_options(self):
        self.succeed("generate", "ball", "--cells", 10, "--output", "ball.vtu")
        view = ["--size", "41,41", "--output", "out.vti"]
        # Parallel projection: half a picture is 2 units, so that the unit ball covers pi / 16.
        self.succeed(
            "render", "ball.vtu", "--camera-position", "0,0,5", "--camera-parallel-scale", 2, *view
        )
        colors, depth = self.read_vti("out.vti")
        self.assertAlmostEqual((colors[:, :, 3] > 0).mean(), numpy.pi / 16, delta=0.03)
        self.assertAlmostEqual(depth[20, 20], 4, delta=0.1)
        # Looking away shows nothing. The picture is right, so that the status is 0, with a warning.
        result = self.run_tool(
            "render", "ball.vtu", "--camera-position", "0,0,5", "--camera-focal-point", "0,0,9",
            *view,
        )
        self.assertEqual(result.returncode, 0)
        self.assertIn("warning: the picture is empty", result.stderr)
        # From the middle everything is in the picture; the position may start with a minus.
        self.succeed(
            "render", "ball.vtu", "--camera-position", "-0.1,0,0", "--camera-view-angle", 90, *view
        )
        colors, depth = self.read_vti("out.vti")
        self.assertTrue((colors[:, :, 3] > 0).all())
        # A camera turned by its up direction sees the picture turned.
        self.succeed("render", "ball.vtu", "--camera-position", "3,0,4", *view)
        upright, _ = self.read_vti("out.vti")
        self.succeed(
            "render", "ball.vtu", "--camera-position", "3,0,4", "--camera-view-up", "0,-1,0", *view
        )
        turned, _ = self.read_vti("out.vti")
        self.assertLess(abs(turned[::-1, ::-1] - upright).max(), 1e-3)

    def write_scaled(self, name, scale):
        """The ball in another unit of length, as scaled.vtu."""
        reader = vtkXMLUnstructuredGridReader()
        reader.SetFileName(self.path(name))
        reader.Update()
        grid = reader.GetOutput()
        coordinates = vtk_to_numpy(grid.GetPoints().GetData()).astype(float) * scale
        points = vtkPoints()
        points.SetData(numpy_to_vtk(coordinates, deep=True))
        grid.SetPoints(points)
        writer = vtkXMLUnstructuredGridWriter()
        writer.SetInputData(grid)
        writer.SetFileName(self.path("scaled.vtu"))
        writer.Write()

    def test_any_unit_of_length(self):
        self.succeed("generate", "ball", "--cells", 10, "--output", "ball.vtu")
        view = ["--size", "40,30", "--output", "out.vti"]
        for method in ("ray-cast", "gpu-ray-cast", "projection"):
            self.succeed("render", "ball.vtu", "--method", method, *view)
            expected, _ = self.read_vti("out.vti")
            for scale in (1e-30, 1e-20, 1e-12, 1e12, 1e15, 3.1e21, 1e30):
                self.write_scaled("ball.vtu", scale)
                self.succeed("render", "scaled.vtu", "--method", method, *view)
                colors, _ = self.read_vti("out.vti")
                self.assertLess(abs(colors - expected).max(), 2e-4, f"{method} {scale}")
                os.remove(self.path("out.vti"))
            # Beyond single precision there is an error instead of an empty picture.
            self.write_scaled("ball.vtu", 1e33)
            self.expect_failure(
                1, "render", "scaled.vtu", "--method", method, *view, says="too large"
            )

    def run_on_a_terminal(self, *arguments):
        """What the tool says on a terminal."""
        process, terminal = pty.fork()
        if process == 0:
            os.chdir(self.folder)
            os.execv(tool.TOOL, [tool.TOOL, *map(str, arguments)])
        said = b""
        while True:
            try:
                part = os.read(terminal, 4096)
            except OSError:  # the tool has closed the terminal
                break
            if not part:
                break
            said += part
        self.assertEqual(os.waitstatus_to_exitcode(os.waitpid(process, 0)[1]), 0)
        os.close(terminal)
        return said

    def test_progress_on_a_terminal_only(self):
        self.succeed("generate", "ball", "--cells", 4, "--output", "ball.vtu")
        with open(self.path("ball.vtu"), "rb") as file:
            ball = file.read()
        os.mkfifo(self.path("pipe"))

        def write_slowly():
            with open(self.path("pipe"), "wb") as pipe:
                pipe.write(ball[:100])
                pipe.flush()
                time.sleep(0.8)
                pipe.write(ball[100:])

        writer = threading.Thread(target=write_slowly)
        writer.start()
        said = self.run_on_a_terminal("render", "pipe", "--size", "4,4", "--output", "out.png")
        writer.join()
        self.assertIn(b"reading pipe ..., 0 s", said)
        self.assertTrue(said.endswith(b"\r\x1b[K"), "the line is gone at the end")
        self.assertIn("out.png", self.files())
        large = ("generate", "ball", "--cells", 150, "--output", "large.vtu")
        self.assertIn(b"generating ball ...", self.run_on_a_terminal(*large))
        self.succeed(*large)

    def test_threads_do_not_change_a_bit(self):
        self.succeed("generate", "ball", "--cells", 10, "--output", "ball.vtu")
        for threads in (1, 2, 5):
            self.succeed(
                "render", "ball.vtu", "--threads", threads, "--output", f"{threads}.vti"
            )
        first = self.read_vti("1.vti")
        for threads in (2, 5):
            other = self.read_vti(f"{threads}.vti")
            self.assertTrue((first[0] == other[0]).all())
            self.assertTrue((first[1] == other[1]).all())

    def test_transfer_function(self):
        self.succeed("generate", "ball", "--cells", 10, "--output", "ball.vtu")
        view = ["--size", "40,40", "--output"]
        self.write("one.json", json.dumps(PRESET))
        self.write("list.json", json.dumps([PRESET, {"RGBPoints": [0, 0, 0, 0, 1, 0, 0, 0]}]))
        self.succeed("render", "ball.vtu", "--transfer", "one.json", *view, "one.vti")
        self.succeed("render", "ball.vtu", "--transfer", "list.json", *view, "list.vti")
        self.succeed("render", "ball.vtu", *view, "default.vti")
        one, _ = self.read_vti("one.vti")
        self.assertTrue((one == self.read_vti("list.vti")[0]).all())
        self.assertGreater(abs(one - self.read_vti("default.vti")[0]).max(), 0.1)
        self.assertEqual(abs(one[:, :, 1]).max(), 0, "there is no green in the preset")
        # Twice the unit distance is half of the optical depth.
        alphas = []
        for distance in (1, 2):
            self.succeed(
                "render", "ball.vtu", "--opacity-unit-distance", distance, *view, "d.vti"
            )
            alphas.append(self.read_vti("d.vti")[0][:, :, 3].astype(float))
        self.assertLess(abs((1 - alphas[1]) ** 2 - (1 - alphas[0])).max(), 1e-3)

    def test_statistics(self):
        self.succeed("generate", "ball", "--cells", 6, "--output", "ball.vtu")
        self.succeed("render", "ball.vtu", "--stats", "stats.json", "--output", "out.png")
        with open(self.path("stats.json"), encoding="utf-8") as file:
            statistics = json.load(file)
        memory = statistics["memory"]
        peaks = list(statistics["process_peaks"].values())
        self.assertEqual(len(peaks), 6)
        self.assertEqual(peaks, sorted(peaks))
        self.assertEqual(set(statistics["memory_peaks"]), set(memory))
        for name, held in memory.items():
            self.assertGreaterEqual(statistics["memory_peaks"][name], held, name)
        cells = statistics["tables"]["tetrahedra"]
        self.assertGreaterEqual(memory["mesh"], 16 * cells)
        self.assertGreaterEqual(memory["walk_tables"], 32 * cells)
        text = self.succeed("render", "ball.vtu", "--output", "out.png", "--stats")
        for name in statistics:
            self.assertIn(name, text)

    def test_properties(self):
        self.succeed("generate", "ball", "--cells", 6, "--output", "ball.vtu")
        view = ["--camera-position", "0,0,5", "--camera-parallel-scale", 1.2, "--size", "40,40"]
        self.succeed(
            "render", "ball.vtu", *view, "--set", "Cropping=1", "--set",
            "CroppingRegionPlanes=0,2,-2,2,-2,2", "--output", "half.vti",
        )
        colors, _ = self.read_vti("half.vti")
        self.assertEqual(colors[:, :19, 3].max(), 0)
        self.assertGreater(colors[:, 21:, 3].max(), 0)
        self.succeed(
            "render", "ball.vtu", *view, "--set", "ImageSampleDistance=2", "--output", "coarse.png"
        )
        self.assertEqual(self.read_png("coarse.png").shape, (40, 40, 3))

    def test_values_of_properties_have_names(self):
        self.succeed("generate", "ball", "--cells", 6, "--output", "ball.vtu")

        def render(method, *settings):
            options = [text for setting in settings for text in ("--set", setting)]
            self.succeed(
                "render", "ball.vtu", "--size", "20,20", "--method", method, *options,
                "--max-error", 1, "--stats", "s.json", "--output", "out.png",
            )
            with open(self.path("s.json"), encoding="utf-8") as file:
                return json.load(file)

        for text in ("centroid", "CENTROID", "4"):
            statistics = render("projection", f"Order={text}")
            self.assertEqual(statistics["projection"]["order"], "distance of centroids")
        for text in ("non-convex", "Non_Convex", "NonConvex"):
            statistics = render("projection", f"Order={text}")
            self.assertEqual(statistics["projection"]["order"], "meshed polyhedra, not convex")
        statistics = render("ray-cast", "Precision=double", "NumberOfThreads=1", "Cropping=on")
        self.assertEqual(statistics["rays"]["precision"], "double")
        self.assertEqual(statistics["rays"]["threads"], 1)
        self.assertNotIn("cropping", statistics["left_out"])
        self.assertIn("cropping", render("ray-cast", "Cropping=False")["left_out"])
        statistics = render("ray-cast", "Cropping=on", "CroppingRegionFlags=0x2000")
        self.assertNotIn("cropping", statistics["left_out"])
        self.succeed(
            "render", "ball.vtu", "--size", "20,20", "--max-error", 0, "--stats", "s.json",
            "--output", "out.png",
        )
        with open(self.path("s.json"), encoding="utf-8") as file:
            self.assertEqual(json.load(file)["error"]["maximum"], 0)
        statistics = render(
            "ray-cast", "Integration=table", "TableFormat=half", "TableScalarSize=64"
        )
        self.assertEqual(statistics["segments"]["integration"], "table")
        self.assertIn("half", json.dumps(statistics["segments"]))

    def test_properties_are_listed(self):
        text = self.succeed("render", "--list-properties")
        for words in (
            "triangle-caster:\n", "  SliceShape=planes\n", "  SampleDistance=automatic\n",
            "  MaximumError=0.0001\n", "a number from 0 to 1", "closed-form (1)", "projection:\n",
            "isosurface:\n", "  Shadows=Off\n", "  ColorArrayComponent=magnitude\n",
            "boundary-layers (3): depth-peeled boundary faces; gpu-ray-cast only",
            "CroppingRegionPlanes=0,1,0,1,0,1\n", "NumberOfThreads=automatic\n",
        ):
            self.assertIn(words, text)
        self.assertNotIn("VectorMode", text)
        # What it says is a default can be set.
        self.succeed("generate", "ball", "--cells", 4, "--output", "ball.vtu")
        groups = re.split(r"\n\n", text)[1:]
        self.assertEqual(len(groups), 11)
        self.write_image("image.vti", numpy.arange(27, dtype=numpy.float32).reshape(3, 3, 3))
        for group in groups:
            method = re.split(r",|:| and ", group)[0]
            defaults = re.findall(r"^  (\w+=\S+)$", group, re.MULTILINE)
            self.assertGreater(len(defaults), 0)
            options = [word for default in defaults for word in ("--set", default)]
            options += ["--isovalues", "0.5"] if method == "isosurface" else []
            data = "image.vti" if method == "triangle-caster" else "ball.vtu"
            self.succeed(
                "render", data, "--size", "8,8", "--method", method, *options,
                "--output", "out.png",
            )


@unittest.skipUnless(os.environ.get("TETRALUX_DATA"), "TETRALUX_DATA is not set")
class RealData(ToolTest):
    def setUp(self):
        super().setUp()
        self.data = os.path.abspath(os.environ["TETRALUX_DATA"])

    def test_every_format(self):
        fin = os.path.join(self.data, "bluntfin{}.bin")
        for arguments, words in [
            ([fin.format("xyz") + "," + fin.format("q")], ["187395", "Density", "zero volume"]),
            ([fin.format("xyz"), "--plot3d-q", fin.format("q")], ["187395", "Density", "Pressure"]),
            ([os.path.join(self.data, "disk_out_ref.ex2")], ["7472", "Temp", "AsH3"]),
            ([os.path.join(self.data, "can.vtu")], ["cell array EQPS", "vtkHexahedron"]),
            ([os.path.join(self.data, "neghip.slc")], [str(5 * 65**3)]),
            ([os.path.join(self.data, "headsq", "quarter.nhdr")], [str(5 * 63 * 63 * 92)]),
        ]:
            with self.subTest(arguments=arguments):
                text = self.succeed("info", *arguments)
                for word in words:
                    self.assertIn(word, text)

    def test_pictures(self):
        fin = os.path.join(self.data, "bluntfin{}.bin")
        for arguments in [
            [fin.format("xyz") + "," + fin.format("q"), "--array", "Density"],
            [os.path.join(self.data, "disk_out_ref.ex2"), "--array", "V", "--component", "2"],
            [os.path.join(self.data, "can.vtu"), "--array", "EQPS"],
            [os.path.join(self.data, "neghip.slc")],
        ]:
            with self.subTest(arguments=arguments):
                self.succeed("render", *arguments, "--size", "64,64", "--output", "out.png")


if __name__ == "__main__":
    tool.main()
