# SPDX-License-Identifier: BSD-3-Clause
"""Every way in which a command line can be wrong: status 2 where the command line is, 1 where the
work fails; one line that says so; no file left."""

import os
import signal

from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkPoints
from vtkmodules.vtkCommonDataModel import VTK_LAGRANGE_HEXAHEDRON, VTK_TRIANGLE, vtkUnstructuredGrid
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter

import tool
from tool import ToolTest


class WrongUsage(ToolTest):
    def setUp(self):
        super().setUp()
        self.succeed("generate", "ball", "--cells", 4, "--output", "ball.vtu")

    def render_fails(self, *arguments, says):
        self.expect_failure(2, "render", "ball.vtu", "--output", "out.png", *arguments, says=says)

    def test_commands(self):
        self.expect_failure(2, says="--help")
        self.expect_failure(2, "rendr", says="--help")
        self.expect_failure(2, "render", says=["IN", "required", "tetralux render --help"])
        self.expect_failure(2, "render", "ball.vtu", says=["--output", "required"])
        self.expect_failure(2, "info", says=["IN", "required"])
        self.expect_failure(2, "info", "ball.vtu", "--frobnicate", says="--frobnicate")

    def test_unknown_options(self):
        self.render_fails("--frobnicate", says=["--frobnicate", "tetralux render --help"])
        self.render_fails("more.vtu", says="more.vtu")

    def test_methods(self):
        for method in ("bunyk", "isosurfaces", "gpu", ""):
            self.render_fails(
                "--method", method,
                says=[
                    "--method",
                    "auto, ray-cast, gpu-ray-cast, projection, isosurface and triangle-caster",
                ],
            )

    def test_isosurfaces(self):
        self.render_fails("--method", "isosurface", says="--isovalues")
        self.render_fails("--color-array", "Field", says=["--color-array", "--isovalues"])
        self.render_fails(
            "--method", "ray-cast", "--isovalues", "0.5", "--color-array", "Field",
            says=["--color-array", "--method isosurface"],
        )
        self.render_fails(
            "--method", "isosurface", "--isovalues", "0.5", "--set", "BlendMode=isosurface",
            says="vtkTetrahedraIsosurfaceMapper has no property 'BlendMode'",
        )
        self.render_fails(
            "--method", "ray-cast", "--isovalues", "0.5", "--set", "Shadows=on",
            says="has no property 'Shadows'",
        )

    def test_properties_of_other_methods(self):
        self.render_fails(
            "--method", "projection", "--set", "Precision=2",
            says=["vtkTetrahedraProjectionMapper has no property 'Precision'", "ColorBuffer"],
        )
        self.render_fails(
            "--method", "gpu-ray-cast", "--threads", 2, says=["--threads", "gpu-ray-cast"]
        )

    def test_numbers(self):
        for option, text, right in [
            ("--size", "512", "W,H"),
            ("--size", "512,", "W,H"),
            ("--size", "0,5", "W,H"),
            ("--size", "5,1e9", "W,H"),
            ("--size", "5,5,5", "W,H"),
            ("--background", "0,0", "R,G,B"),
            ("--background", "0,0,2", "from 0 to 1"),
            ("--background", "a,b,c", "R,G,B"),
            ("--camera-position", "1,2", "X,Y,Z"),
            ("--camera-position", "1,2,nan", "X,Y,Z"),
            ("--camera-focal-point", "1,2,3,4", "X,Y,Z"),
            ("--camera-view-up", "up", "X,Y,Z"),
            ("--camera-view-up", "0,0,0", "0,0,0"),
            ("--camera-view-angle", "180", "below 180"),
            ("--camera-view-angle", "-3", "above 0"),
            ("--camera-parallel-scale", "0", "above 0"),
            ("--camera-parallel-scale", "inf", "above 0"),
            ("--opacity-unit-distance", "0", "above 0"),
            ("--opacity-unit-distance", "1x", "above 0"),
            ("--max-error", "2", "from 0 to 1"),
            ("--max-error", "-1e-9", "from 0 to 1"),
            ("--max-error", "", "not a number"),
            ("--threads", "-1", "integer from 0"),
            ("--threads", "2.5", "integer from 0"),
            ("--component", "x", "magnitude"),
            ("--component", "-1", "magnitude"),
        ]:
            with self.subTest(option=option, text=text):
                self.render_fails(option, text, says=[option, text, right])

    def test_camera(self):
        self.render_fails(
            "--camera-view-angle", 30, "--camera-parallel-scale", 1, says="--camera-parallel-scale"
        )
        self.render_fails(
            "--camera-position", "1,2,3", "--camera-focal-point", "1,2,3", says="--camera-position"
        )

    def test_properties(self):
        self.render_fails("--set", "Foo=1", says=["'Foo'", "MaximumError", "NumberOfThreads"])
        self.render_fails("--set", "Foo", says="Property=Value")
        self.render_fails("--set", "=3", says="Property=Value")
        self.render_fails("--set", "MaximumError=x", says=["--set MaximumError", "'x'"])
        self.render_fails("--set", "MaximumError=2", says="from 0 to 1")
        self.render_fails("--set", "BlendMode=loud", says=["'loud'", "absorption (16)"])
        self.render_fails("--set", "BlendMode=isosurface", says="--isovalues")
        self.render_fails("--isovalues", "1,x", says="list of numbers")
        self.render_fails("--set", "BlendMode=2", says=["'2'", "maximum-intensity (1)"])
        self.render_fails("--set", "Precision=half", says="automatic (0), single (1) or double (2)")
        self.render_fails("--set", "VectorMode=component", says="has no property 'VectorMode'")
        self.render_fails("--set", "Cropping=2", says="on or off")
        self.render_fails("--set", "CroppingRegionFlags=0x8000000", says="from 0 to 134217727")
        self.render_fails("--set", "CroppingRegionFlags=0x", says="'0x'")
        self.render_fails("--set", "CroppingRegionFlags=0x1.8p3", says="'0x1.8p3'")
        self.render_fails(
            "--set", "TableScalarSize=1", says="an integer from 2 to 4096, or automatic (0)"
        )
        self.render_fails("--set", "TableScalarSize=2.5", says="an integer from 2 to 4096")
        self.render_fails(
            "--method", "ray-cast", "--set", "Reentry=boundary-layers",
            says="not automatic (0), boundary-hierarchy (1) or imaginary-cells (2)",
        )
        self.render_fails(
            "--method", "projection", "--set", "Reentry=automatic", says="has no property 'Reentry'"
        )
        self.render_fails("--set", "ImageSampleDistance=0", says="from 0.1 to 100")
        self.render_fails("--set", "CroppingRegionPlanes=1,2", says="XMIN,XMAX")

    def test_output_names(self):
        self.expect_failure(2, "render", "ball.vtu", "--output", "out.jpg", says=[".png", ".vti"])
        self.expect_failure(2, "render", "ball.vtu", "--output", "out", says=[".png", ".vti"])
        self.render_fails("--stats", "out.txt", says=["--stats", ".json"])

    def test_generate(self):
        self.expect_failure(2, "generate", says="--list")
        self.expect_failure(2, "generate", "ball", says="--output")
        self.expect_failure(2, "generate", "ball", "--output", "x.vtk", says=".vtu")
        self.expect_failure(2, "generate", "bal", "--output", "x.vtu", says=["'bal'", "ball"])
        for arguments, says in [
            (("--cels", 3), ["'cels'", "cells"]),
            (("--cells", "many"), ["--cells", "'many'"]),
            (("--cells", -5), "cells"),
            (("--cells",), "--cells"),
            (("7",), "'7'"),
        ]:
            with self.subTest(arguments=arguments):
                self.expect_failure(
                    2, "generate", "ball", "--output", "x.vtu", *arguments, says=says
                )
        self.expect_failure(
            2, "generate", "ball", "--steps", 3, "--output", "x.pvd", says=["'ball'", "ring"]
        )
        self.expect_failure(2, "generate", "ring", "--steps", 3, "--output", "x.vtu", says=".pvd")
        self.expect_failure(
            2, "generate", "ring", "--steps", 0, "--output", "x.pvd", says="--steps"
        )
        self.expect_failure(
            2, "generate", "ring", "--steps", 2, "--time", 0, "--output", "x.pvd", says="--time"
        )
        self.assertFalse([name for name in self.files() if name.startswith("x")])


class FailedWork(ToolTest):
    def setUp(self):
        super().setUp()
        self.succeed("generate", "ball", "--cells", 4, "--output", "ball.vtu")

    def render_fails(self, *arguments, says):
        self.expect_failure(1, "render", "ball.vtu", "--output", "out.png", *arguments, says=says)

    def test_inputs(self):
        os.mkdir(self.path("folder.vtu"))
        self.write("mesh.abc", "")
        self.write("broken.vtu", "<VTKFile type='UnstructuredGrid'><Unstr")
        self.write("broken.vtk", "no header")
        self.write("broken.ex2", "no netcdf")
        self.write("broken.nhdr", "no nrrd")
        self.write("broken.slc", "no slc")
        self.write("broken.bin", "no plot3d")
        self.write("empty.vtu", "")
        with open(self.path("ball.vtu"), "rb") as file:
            half = file.read()[:2000]
        with open(self.path("half.vtu"), "wb") as file:
            file.write(half)
        for name, says in [
            ("missing.vtu", "No such file"),
            ("folder.vtu", "folder"),
            ("mesh.abc", ".vtu"),
            ("broken.vtu", ""),
            ("broken.vtk", ""),
            ("broken.ex2", ""),
            ("broken.nhdr", ""),
            ("broken.slc", ""),
            ("broken.bin", ""),
            ("empty.vtu", ""),
            ("half.vtu", ""),
        ]:
            for command in (("info", name), ("render", name, "--output", "out.vti")):
                with self.subTest(command=command):
                    self.expect_failure(1, *command, says=[f"'{name}'", says])
        self.expect_failure(1, "info", "missing.bin,q.bin", says="'missing.bin'")
        self.expect_failure(1, "info", "broken.bin,missing.bin", says="'missing.bin'")
        self.expect_failure(
            1, "info", "broken.bin", "--plot3d-q", "missing.bin", says="'missing.bin'"
        )

    def test_arrays(self):
        self.render_fails("--array", "Temp", says=["'Temp'", "Field"])
        self.render_fails("--component", 1, says=["--component", "no component 1"])
        self.render_fails(
            "--isovalues", "0.5", "--color-array", "Temp", says=["'Temp'", "Field"]
        )

    def write_grid(self, name, cell_type, count, with_scalars=True, value=1.0):
        points = vtkPoints()
        scalars = vtkDoubleArray()
        scalars.SetName("Field")
        for i in range(count):
            points.InsertNextPoint(i & 1, i >> 1 & 1, i >> 2)
            scalars.InsertNextValue(value * i)
        grid = vtkUnstructuredGrid()
        grid.SetPoints(points)
        if count:
            grid.InsertNextCell(cell_type, count, list(range(count)))
        if with_scalars:
            grid.GetPointData().AddArray(scalars)
        writer = vtkXMLUnstructuredGridWriter()
        writer.SetFileName(self.path(name))
        writer.SetInputData(grid)
        writer.Write()

    def test_meshes_without_anything_to_render(self):
        self.write_grid("noarrays.vtu", VTK_TRIANGLE, 3, with_scalars=False)
        self.write_grid("nothing.vtu", VTK_TRIANGLE, 0)
        self.write_grid("nan.vtu", VTK_TRIANGLE, 3, value=float("nan"))
        self.write_grid("flat.vtu", VTK_TRIANGLE, 3)
        self.write_grid("lagrange.vtu", VTK_LAGRANGE_HEXAHEDRON, 27)
        for name, says in [
            ("noarrays.vtu", "no arrays"),
            ("nothing.vtu", "no finite values"),
            ("nan.vtu", "no finite values"),
            ("flat.vtu", "none of its 1 cells"),
            ("lagrange.vtu", "1 vtkLagrangeHexahedron"),
        ]:
            with self.subTest(name=name):
                self.expect_failure(1, "render", name, "--output", "out.png", says=says)

    def test_image_methods_and_cells(self):
        self.render_fails(
            "--method", "triangle-caster", says=["triangle-caster", "vtkUnstructuredGrid"]
        )
        self.expect_failure(
            2, "render", "ball.vtu", "--output", "out.png", "--set", "SliceShape=shells",
            says="no property 'SliceShape'",
        )
        for arguments, says in [
            (["--set", "BlendMode=absorption"], "not composite (0)"),
            (["--set", "BlendMode=isosurface"], "--isovalues"),
            (["--isovalues", "0.5", "--color-array", "Field"], "--method isosurface"),
            (["--isovalues", "0.5", "--set", "BlendMode=additive"], "belong together"),
            (["--set", "BlendMode=slice"], "--slice-plane X,Y,Z,NX,NY,NZ"),
            (["--slice-plane", "0,0,0,0,0,1"], "BlendMode=slice"),
            (["--slice-plane", "0,0,0"], "X,Y,Z,NX,NY,NZ"),
        ]:
            with self.subTest(arguments=arguments):
                self.expect_failure(
                    2, "render", "ball.vtu", "--output", "out.png", "--method", "triangle-caster",
                    *arguments, says=says,
                )

    def test_transfer_functions(self):
        self.render_fails("--transfer", "missing.json", says="'missing.json'")
        for text, says in [
            ("", "not JSON"),
            ("{", "not JSON"),
            ("3", "preset"),
            ("[]", "empty"),
            ("{}", "neither"),
            ('{"RGBPoints": [0, 0, 0]}', "RGBPoints"),
            ('{"RGBPoints": [0, 0, 0, "red"]}', "RGBPoints"),
            ('{"RGBPoints": [0, 0, 0, 2]}', "0 to 1"),
            ('{"RGBPoints": [1, 0, 0, 0, 0, 1, 1, 1]}', "ascending"),
            ('{"Points": []}', "Points"),
            ('{"RGBPoints": [0, 0, 0, 0], "ColorSpace": "Mauve"}', "Mauve"),
            ('{"RGBPoints": [1, 0, 0, 0, 2, 1, 1, 1], "UseLogScale": 1}', "UseLogScale"),
        ]:
            with self.subTest(text=text):
                self.write("preset.json", text)
                self.render_fails("--transfer", "preset.json", says=["preset.json", says])

    def test_outputs(self):
        os.mkdir(self.path("folder.png"))
        for output, says in [
            ("missing/out.png", "No such file"),
            ("folder.png", "folder"),
            ("ball.vtu/out.png", "Not a directory"),
        ]:
            with self.subTest(output=output):
                self.expect_failure(
                    1, "render", "ball.vtu", "--output", output, says=[output, says]
                )
        self.render_fails("--stats", "missing/stats.json", says="missing/stats.json")
        self.expect_failure(
            1, "generate", "ball", "--output", "missing/x.vtu", says="missing/x.vtu"
        )

    def test_a_failure_keeps_an_older_output(self):
        self.write("out.png", "older")
        self.render_fails("--array", "Temp", says="Temp")
        with open(self.path("out.png"), encoding="utf-8") as file:
            self.assertEqual(file.read(), "older")

    def test_camera_that_depends_on_the_data(self):
        self.render_fails("--camera-position", "0,0,0", says="--camera-position")
        self.render_fails(
            "--camera-position", "0,9,0", "--camera-view-up", "0,1,0", says="--camera-view-up"
        )

    def test_an_interrupt_leaves_nothing(self):
        self.write("out.png", "older")
        render = (
            "render", "ball.vtu", "--method", "ray-cast", "--size", "8000,8000",
            "--max-error", "1e-9", "--set", "Precision=2", "--stats", "stats.json",
            "--output", "out.png",
        )
        generate = ("generate", "ball", "--cells", 150, "--output", "large.vtu")
        for arguments, outputs in ((render, 2), (generate, 1)):
            for number in (signal.SIGINT, signal.SIGTERM):
                with self.subTest(command=arguments[0], signal=number):
                    self.interrupt(
                        number, *arguments,
                        until=lambda process: self.count_unnamed(process) == outputs,
                    )
        with open(self.path("out.png"), encoding="utf-8") as file:
            self.assertEqual(file.read(), "older")


if __name__ == "__main__":
    tool.main()
