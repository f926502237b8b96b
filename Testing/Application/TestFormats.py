# SPDX-License-Identifier: BSD-3-Clause
"""Every format that the tool reads, as a cube of volume 1 whose field is 4 x + 2 y + z; time steps,
pieces and series; what damaged files and files of other formats get."""

import os

from vtkmodules.vtkCommonDataModel import VTK_TETRA

import tool
from formats import FormatFiles, make_cube
from tool import ToolTest


class Formats(FormatFiles, ToolTest):
    def info(self, *arguments):
        """The rows that info prints, by label."""
        rows = {}
        for line in self.succeed("info", *arguments).splitlines():
            label, _, value = line.partition("  ")
            rows[label.strip()] = value.strip()
        return rows

    def expect_cube(self, *arguments, volume="1", field="0 .. 7"):
        rows = self.info(*arguments)
        self.assertEqual(rows["volume"], volume, rows)
        self.assertTrue(rows["point array Field"].endswith(field), rows)
        return rows

    def test_exodus(self):
        for name in ("a.e", "a.g", "a.gen", "a.exo", "a.exo2", "a.ex2", "a.exii", "a.e-s002"):
            with self.subTest(name=name):
                self.write_cube(name)
                self.expect_cube(name)

    def test_pieces_of_exodus(self):
        for i in range(3):
            self.write_cube(f"a.e.3.{i}", make_cube(i, i + 1))
            if i < 2:
                self.expect_failure(1, "info", "a.e.3.0", says=f"a.e.3.{i + 1}")
        for name in ("a.e.3.0", "a.e.3.2"):
            self.expect_cube(name, volume="3", field="0 .. 21")
        # A series may name one piece of a step, or each.
        for names in (["a.e.3.1"], ["a.e.3.0", "a.e.3.1", "a.e.3.2"]):
            files = "".join(f'<DataSet file="{name}"/>' for name in names)
            self.write(
                "a.pvd",
                f'<VTKFile type="Collection"><Collection>{files}</Collection></VTKFile>',
            )
            self.expect_cube("a.pvd", volume="3", field="0 .. 21")

    def test_text_formats(self):
        self.write_text_formats()
        for name in ("a.inp", "a.tec", "a.dat", "a.plt", "a.case"):
            with self.subTest(name=name):
                self.expect_cube(name)

    def test_fluent(self):
        self.write_fluent()
        self.assertEqual(self.info("a.cas")["volume"], "1")
        os.remove(self.path("a.dat"))
        self.expect_failure(1, "info", "a.cas", says="a.dat")

    def test_vtkhdf(self):
        self.write_vtkhdf()
        self.expect_cube(self.path("cube.vtkhdf"))

    def test_cgns(self):
        self.write_cgns()
        self.expect_cube(self.path("cube.cgns"))

    def test_open_foam(self):
        self.write_open_foam()
        rows = self.info("a.foam", "--time-step", 1)
        self.assertEqual(rows["volume"], "1", rows)
        self.assertEqual(rows["time steps"], "2: 0, 1", rows)
        self.assertTrue(rows["cell array T"].endswith("6 .. 6"), rows)

    def test_series(self):
        self.write_series()
        for name, last in (("a.pvd", "2"), ("a.vtu.series", "1")):
            with self.subTest(name=name):
                rows = self.expect_cube(name)
                self.assertEqual(rows["time steps"], "3: 0, 0.5, 2")
                self.assertEqual(rows["time step read"], "0, time 0")
                for arguments in (("--time", 0.6), ("--time", 0.5), ("--time-step", 1)):
                    rows = self.expect_cube(name, *arguments, field="0 .. 14")
                    self.assertEqual(rows["time step read"], "1, time 0.5")
                self.expect_cube(name, "--time", 2, volume=last, field="0 .. 21")
                for time in (-0.1, 2.1):
                    self.expect_failure(
                        1, "info", name, "--time", time, says=["--time", "3 time steps, 0 .. 2"]
                    )
                self.expect_failure(
                    1, "info", name, "--time-step", 3, says=["--time-step", name, "0 .. 2"]
                )

    def test_series_that_are_wrong(self):
        self.write_series()
        for time in ("nan", "inf", "noon"):
            self.write(
                "b.pvd",
                '<VTKFile type="Collection"><Collection>'
                f'<DataSet timestep="{time}" file="a0.vtu"/></Collection></VTKFile>',
            )
            self.expect_failure(1, "info", "b.pvd", says=["b.pvd", f"'{time}'", "is no time"])
        self.expect_failure(1, "info", "a.pvd", "--plot3d-q", "a.q", says=["a.pvd", "PLOT3D"])

    def test_render_says_that_there_are_more_time_steps(self):
        self.write_series()
        render = ("render", "a.pvd", "--size", "4,4", "--output", "out.png")
        result = self.run_tool(*render)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(len(result.stderr.splitlines()), 1)
        for word in ("a.pvd", "3 time steps, 0 .. 2", "--time-step"):
            self.assertIn(word, result.stderr)
        self.succeed(*render, "--time-step", 0)
        self.succeed(*render, "--time", 0)

    def test_wrong_time_options(self):
        self.write_series()
        self.expect_failure(
            2, "info", "a.pvd", "--time", 0, "--time-step", 0, says=["--time", "--time-step"]
        )
        self.expect_failure(2, "info", "a.pvd", "--time", "now", says=["--time", "'now'"])
        self.expect_failure(2, "info", "a.pvd", "--time-step", -1, says="--time-step")
        for option in ("--time", "--time-step"):
            self.expect_failure(
                1, "info", "a0.vtu", option, 0, says=[option, "a0.vtu", "no time steps"]
            )

    def test_formats_without_a_reader(self):
        for extension, converter in (
            ("msh", "meshio convert"), ("xdmf", "meshio convert"), ("med", "meshio convert"),
            ("unv", "gmsh"),
        ):
            self.write("a." + extension, "anything")
            self.expect_failure(1, "info", "a." + extension, says=["a." + extension, converter])
        self.write("abaqus.inp", "*HEADING\ncube\n*NODE\n1, 0, 0, 0\n")
        self.expect_failure(1, "info", "abaqus.inp", says=["Abaqus", "meshio convert"])

    def test_damaged_files(self):
        self.write_text_formats()
        extensions = (
            "vtkhdf", "cgns", "case", "foam", "cas", "tec", "dat", "plt", "inp", "pvd", "series",
            "e-s001",
        )
        for extension in extensions:
            for text in ("", "no such thing\n1 2 3\n"):
                with self.subTest(extension=extension, text=text):
                    name = "broken." + extension
                    self.write(name, text)
                    self.expect_failure(1, "info", name, says=f"'{name}'")
        for extension in ("vtkhdf", "cgns"):
            name = "half." + extension
            with open(self.path(name), "wb") as file:
                file.write(b"\x89HDF\r\n\x1a\n" + bytes(2000))
            self.expect_failure(1, "info", name, says=f"'{name}'")
        self.write("half.cas", '(0 "cube")\n(2 3)\n(10 (0 1 8 0 3))\n(10 (1 1 8 1 3)(\n0 0 0\n')
        self.expect_failure(1, "info", "half.cas", says="'half.cas'")
        self.write("empty.pvd", '<VTKFile type="Collection"><Collection/></VTKFile>')
        self.expect_failure(1, "info", "empty.pvd", says=["'empty.pvd'", "no files"])

    def test_refined_grids_that_would_crash_their_reader(self):
        for kind in ("vtkHierarchicalBoxDataSet", "vtkOverlappingAMR", "vtkNonOverlappingAMR"):
            for content in (
                "",
                '<DataSet index="0" file="a.vti"/>',
                '<Block><DataSet file="a.vti"/></Block>',
                '<Block level="-1"><DataSet index="-1" file="a.vti"/></Block>',
                '<Block level="5"><DataSet index="7" file="a.vti"/></Block>',
            ):
                with self.subTest(kind=kind, content=content):
                    element = f"<{kind}>{content}</{kind}>"
                    self.write("a.vtm", f'<VTKFile type="{kind}" version="0.1">{element}</VTKFile>')
                    for command in (("info",), ("render", "--output", "out.png")):
                        self.expect_failure(1, *command, "a.vtm", says=["'a.vtm'", "level"])

    def test_damaged_grids(self):
        plane = "0 1 2 3 4 5 6 7 8\n"
        self.write(
            "a.vtk",
            "# vtk DataFile Version 3.0\ncube\nASCII\nDATASET RECTILINEAR_GRID\n"
            "DIMENSIONS 9 9 90000\nX_COORDINATES 9 double\n" + plane + "Y_COORDINATES 9 double\n"
            + plane,
        )
        axis = '<DataArray type="Float64" Name="x" format="ascii">0 1 2 3 4 5</DataArray>'
        self.write(
            "a.vtr",
            '<VTKFile type="RectilinearGrid" version="0.1" byte_order="LittleEndian">'
            '<RectilinearGrid WholeExtent="2147483647 5 0 5 0 5"><Piece Extent="0 5 0 5 0 5">'
            '<PointData><DataArray type="Float64" Name="s" format="ascii">'
            + " ".join(map(str, range(216)))
            + f"</DataArray></PointData><Coordinates>{3 * axis}</Coordinates>"
            "</Piece></RectilinearGrid></VTKFile>",
        )
        for name in ("a.vtk", "a.vtr"):
            for command in (("info",), ("render", "--size", "8,8", "--output", "out.png")):
                with self.subTest(name=name, command=command):
                    result = self.run_tool(*command, name)
                    self.assertEqual(result.returncode, 1, result.stderr)
                    self.assertIn(f"'{name}'", result.stderr)
                    self.assertNotIn("out.png", self.files())

    def test_cells_that_are_left_out_are_said_once(self):
        grid = make_cube()
        grid.InsertNextCell(VTK_TETRA, 4, [0, 1, 2, 3000])
        grid.InsertNextCell(VTK_TETRA, 4, [0, 1, 1, 2])
        grid.GetPoints().InsertNextPoint(float("nan"), 0, 0)
        grid.GetPointData().GetScalars().InsertNextValue(1)
        grid.InsertNextCell(VTK_TETRA, 4, [0, 1, 2, 8])
        self.write_cube("a.vtu", grid)
        reasons = (
            ("cells with missing or unusable points", "1"),
            ("tetrahedra with coordinates that are not finite", "1"),
            ("tetrahedra with a repeated point", "1"),
        )
        output = self.run_tool("render", "a.vtu", "--size", "4,4", "--output", "out.png")
        self.assertEqual(output.returncode, 0, output.stderr)
        warnings = [line for line in output.stderr.splitlines() if "left out" in line]
        self.assertEqual(len(warnings), 1, output.stderr)
        info = self.succeed("info", "a.vtu")
        for reason, count in reasons:
            self.assertIn(f"{reason}: {count}", warnings[0])
            self.assertIn(f"left out: {reason} {count}", " ".join(info.split()))


if __name__ == "__main__":
    tool.main()
