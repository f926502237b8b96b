# SPDX-License-Identifier: BSD-3-Clause
"""Every format that the tool reads, as a cube of volume 1 whose field is 4 x + 2 y + z; time steps,
pieces and series; what damaged files and files of other formats get."""

import os

import h5py
import numpy
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkPoints
from vtkmodules.vtkCommonDataModel import VTK_HEXAHEDRON, VTK_TETRA, vtkUnstructuredGrid
from vtkmodules.vtkIOExodus import vtkExodusIIWriter
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter

import tool
from tool import ToolTest

# The corners of the cube in x first, and a hexahedron of them.
CORNERS = [(i & 1, i >> 1 & 1, i >> 2) for i in range(8)]
HEXAHEDRON = [0, 1, 3, 2, 4, 5, 7, 6]
FIELD = [4 * x + 2 * y + z for x, y, z in CORNERS]


def lines(rows):
    return "".join(" ".join(map(str, row)) + "\n" for row in rows)


def one_based(ids):
    return [i + 1 for i in ids]


def make_cube(shift=0, factor=1):
    points = vtkPoints()
    field = vtkDoubleArray()
    field.SetName("Field")
    for (x, y, z), value in zip(CORNERS, FIELD):
        points.InsertNextPoint(x + shift, y, z)
        field.InsertNextValue(factor * value)
    grid = vtkUnstructuredGrid()
    grid.SetPoints(points)
    grid.InsertNextCell(VTK_HEXAHEDRON, 8, HEXAHEDRON)
    grid.GetPointData().SetScalars(field)
    return grid


class Formats(ToolTest):
    def write_cube(self, name, grid=None):
        writer = vtkXMLUnstructuredGridWriter() if name.endswith(".vtu") else vtkExodusIIWriter()
        writer.SetFileName(self.path(name))
        writer.SetInputData(grid or make_cube())
        writer.Write()

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

    def write_text_formats(self):
        self.write(
            "a.inp",
            "# a comment\n8 1 1 0 0\n"
            + lines([i + 1, *x] for i, x in enumerate(CORNERS))
            # The top comes first in this format.
            + lines([[1, 1, "hex", *one_based(HEXAHEDRON[4:] + HEXAHEDRON[:4])]])
            + "1 1\nField, none\n"
            + lines(enumerate(FIELD, 1)),
        )
        tecplot = (
            'TITLE = "cube"\nVARIABLES = "X", "Y", "Z", "Field"\n'
            "ZONE N=8, E=1, F=FEPOINT, ET=BRICK\n"
            + lines([*x, value] for x, value in zip(CORNERS, FIELD))
            + lines([one_based(HEXAHEDRON)])
        )
        for name in ("a.tec", "a.dat", "a.plt"):
            self.write(name, tecplot)
        self.write(
            "a.case",
            "FORMAT\ntype: ensight gold\nGEOMETRY\nmodel: a.geo\n"
            "VARIABLE\nscalar per node: Field a.Field\n",
        )
        self.write(
            "a.geo",
            "cube\ncube\nnode id assign\nelement id assign\npart\n1\ncube\ncoordinates\n8\n"
            + lines([x[axis]] for axis in range(3) for x in CORNERS)
            + "hexa8\n1\n"
            + lines([one_based(HEXAHEDRON)]),
        )
        self.write("a.Field", "Field\npart\n1\ncoordinates\n" + lines([v] for v in FIELD))

    def test_text_formats(self):
        self.write_text_formats()
        for name in ("a.inp", "a.tec", "a.dat", "a.plt", "a.case"):
            with self.subTest(name=name):
                self.expect_cube(name)

    def test_fluent(self):
        quads = ["1 3 4 2", "5 6 8 7", "1 2 6 5", "3 7 8 4", "1 5 7 3", "2 4 8 6"]
        self.write(
            "a.cas",
            '(0 "cube")\n(2 3)\n(10 (0 1 8 0 3))\n(10 (1 1 8 1 3)(\n'
            + lines(CORNERS)
            + "))\n(12 (0 1 1 0))\n(12 (2 1 1 1 4))\n(13 (0 1 6 0))\n(13 (3 1 6 3 4)(\n"
            + "".join(f"{quad} 1 0\n" for quad in quads)
            + "))\n(45 (2 fluid fluid)())\n",
        )
        self.expect_failure(1, "info", "a.cas", says="a.dat")
        self.write("a.dat", '(0 "nothing")\n')
        self.assertEqual(self.info("a.cas")["volume"], "1")

    def test_vtkhdf(self):
        with h5py.File(self.path("cube.vtkhdf"), "w") as file:
            root = file.create_group("VTKHDF")
            root.attrs["Version"] = numpy.array([1, 0], "i8")
            root.attrs["Type"] = numpy.bytes_("UnstructuredGrid")
            for name, count in (
                ("NumberOfPoints", 8), ("NumberOfCells", 1), ("NumberOfConnectivityIds", 8)
            ):
                root[name] = numpy.array([count], "i8")
            root["Points"] = numpy.array(CORNERS, "f8")
            root["Types"] = numpy.array([VTK_HEXAHEDRON], "u1")
            root["Connectivity"] = numpy.array(HEXAHEDRON, "i8")
            root["Offsets"] = numpy.array([0, 8], "i8")
            root.create_group("PointData")["Field"] = numpy.array(FIELD, "f8")
            root.create_group("CellData")
        self.expect_cube(self.path("cube.vtkhdf"))

    def add_cgns_node(self, parent, name, label, kind="MT", data=None):
        """A node of CGNS in HDF5; children are found by the order in which they were made."""
        node = parent if name == "/" else parent.create_group(name, track_order=True)
        texts = (("name", 33, name), ("label", 33, label), ("type", 3, kind))
        for attribute, size, text in texts:
            node.attrs.create(attribute, text, dtype=h5py.string_dtype("ascii", size))
        if data is not None:
            node[" data"] = data
        return node

    def test_cgns(self):
        integer, text = "i4", lambda value: numpy.frombuffer(value, "i1")
        with h5py.File(self.path("cube.cgns"), "w", track_order=True) as file:
            add = self.add_cgns_node
            add(file, "/", "Root Node of HDF5 File")
            file[" format"] = text(b"IEEE_LITTLE_32\0")
            version = numpy.array([3.4], "f4")
            add(file, "CGNSLibraryVersion", "CGNSLibraryVersion_t", "R4", version)
            base = add(file, "Base", "CGNSBase_t", "I4", numpy.array([3, 3], integer))
            sizes = numpy.array([[8], [1], [0]], integer)
            zone = add(base, "Zone", "Zone_t", "I4", sizes)
            add(zone, "ZoneType", "ZoneType_t", "C1", text(b"Unstructured"))
            coordinates = add(zone, "GridCoordinates", "GridCoordinates_t")
            for axis in range(3):
                values = numpy.array([corner[axis] for corner in CORNERS], "f8")
                add(coordinates, "Coordinate" + "XYZ"[axis], "DataArray_t", "R8", values)
            hexahedra = numpy.array([17, 0], integer)  # HEXA_8
            cells = add(zone, "Cells", "Elements_t", "I4", hexahedra)
            only = numpy.array([1, 1], integer)
            add(cells, "ElementRange", "IndexRange_t", "I4", only)
            ids = numpy.array(one_based(HEXAHEDRON), integer)
            add(cells, "ElementConnectivity", "DataArray_t", "I4", ids)
            solution = add(zone, "Solution", "FlowSolution_t")
            add(solution, "GridLocation", "GridLocation_t", "C1", text(b"Vertex"))
            add(solution, "Field", "DataArray_t", "R8", numpy.array(FIELD, "f8"))
        self.expect_cube(self.path("cube.cgns"))

    def write_foam(self, name, kind, text):
        path = self.path(name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        self.write(
            name,
            f"FoamFile {{ version 2.0; format ascii; class {kind}; "
            f"object {os.path.basename(name)}; }}\n{text}\n",
        )

    def test_open_foam(self):
        self.write("a.foam", "")
        self.write_foam("system/controlDict", "dictionary", "startFrom startTime; startTime 0; "
                        "endTime 1; deltaT 1; writeControl timeStep; writeInterval 1;")
        mesh = "constant/polyMesh/"
        corners = "".join(f"({x} {y} {z})\n" for x, y, z in CORNERS)
        self.write_foam(mesh + "points", "vectorField", f"8\n(\n{corners})")
        quads = ["0 2 3 1", "4 5 7 6", "0 1 5 4", "2 6 7 3", "0 4 6 2", "1 3 7 5"]
        faces = "".join(f"4({quad})\n" for quad in quads)
        self.write_foam(mesh + "faces", "faceList", f"6\n(\n{faces})")
        self.write_foam(mesh + "owner", "labelList", "6\n(\n0\n0\n0\n0\n0\n0\n)")
        self.write_foam(mesh + "neighbour", "labelList", "0\n(\n)")
        self.write_foam(mesh + "boundary", "polyBoundaryMesh",
                        "1\n(\nwall { type wall; nFaces 6; startFace 0; }\n)")
        for time, value in ((0, 5), (1, 6)):
            self.write_foam(f"{time}/T", "volScalarField",
                            "dimensions [0 0 0 1 0 0 0];\n"
                            f"internalField uniform {value};\n"
                            "boundaryField { wall { type zeroGradient; } }")
        rows = self.info("a.foam", "--time-step", 1)
        self.assertEqual(rows["volume"], "1", rows)
        self.assertEqual(rows["time steps"], "2: 0, 1", rows)
        self.assertTrue(rows["cell array T"].endswith("6 .. 6"), rows)

    def write_series(self):
        for i in range(3):
            self.write_cube(f"a{i}.vtu", make_cube(i, i + 1))
        self.write(
            "a.pvd",
            '<VTKFile type="Collection" version="0.1"><Collection>'
            '<DataSet timestep="0.5" file="a1.vtu"/><DataSet timestep="0" file="a0.vtu"/>'
            '<DataSet timestep="2" part="0" file="a0.vtu"/>'
            '<DataSet timestep="2" part="1" file="a2.vtu"/></Collection></VTKFile>',
        )
        self.write(
            "a.vtu.series",
            '{"file-series-version": "1.0", "files": [{"name": "a1.vtu", "time": 0.5},'
            ' {"name": "a0.vtu", "time": 0}, {"name": "a2.vtu", "time": 2}]}',
        )

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
