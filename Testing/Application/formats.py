# SPDX-License-Identifier: BSD-3-Clause
"""Writes a cube of volume 1 whose field is 4 x + 2 y + z in every format that the tool reads."""

import os

import h5py
import numpy
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkPoints
from vtkmodules.vtkCommonDataModel import VTK_HEXAHEDRON, vtkUnstructuredGrid
from vtkmodules.vtkIOExodus import vtkExodusIIWriter
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter

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


class FormatFiles:
    """Part of a test that has a folder."""

    def write_cube(self, name, grid=None):
        writer = vtkXMLUnstructuredGridWriter() if name.endswith(".vtu") else vtkExodusIIWriter()
        writer.SetFileName(self.path(name))
        writer.SetInputData(grid or make_cube())
        writer.Write()

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

    def write_fluent(self):
        quads = ["1 3 4 2", "5 6 8 7", "1 2 6 5", "3 7 8 4", "1 5 7 3", "2 4 8 6"]
        self.write(
            "a.cas",
            '(0 "cube")\n(2 3)\n(10 (0 1 8 0 3))\n(10 (1 1 8 1 3)(\n'
            + lines(CORNERS)
            + "))\n(12 (0 1 1 0))\n(12 (2 1 1 1 4))\n(13 (0 1 6 0))\n(13 (3 1 6 3 4)(\n"
            + "".join(f"{quad} 1 0\n" for quad in quads)
            + "))\n(45 (2 fluid fluid)())\n",
        )
        self.write("a.dat", '(0 "nothing")\n')

    def write_vtkhdf(self):
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


    def add_cgns_node(self, parent, name, label, kind="MT", data=None):
        """A node of CGNS in HDF5; children are found by the order in which they were made."""
        node = parent if name == "/" else parent.create_group(name, track_order=True)
        texts = (("name", 33, name), ("label", 33, label), ("type", 3, kind))
        for attribute, size, text in texts:
            node.attrs.create(attribute, text, dtype=h5py.string_dtype("ascii", size))
        if data is not None:
            node[" data"] = data
        return node

    def write_cgns(self):
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


    def write_foam(self, name, kind, text):
        path = self.path(name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        self.write(
            name,
            f"FoamFile {{ version 2.0; format ascii; class {kind}; "
            f"object {os.path.basename(name)}; }}\n{text}\n",
        )

    def write_open_foam(self):
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
