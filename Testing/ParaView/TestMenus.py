# SPDX-License-Identifier: BSD-3-Clause
"""Filters and sources of the plugin do their work and have help texts. For pvbatch."""

from paraview import servermanager

import pictures

pictures.load_plugin()


def get_help(source):
    documentation = source.SMProxy.GetDocumentation()
    assert len(documentation.GetShortHelp()) > 20, source
    assert len(documentation.GetDescription()) > 100, source


disk = pictures.read("disk")
tetrahedra = pictures.TetraluxTetrahedra(Input=disk)
tetrahedra.UpdatePipeline()
count = tetrahedra.GetDataInformation().GetNumberOfCells()
assert count == pictures.COUNTS["disk"]["tetrahedra"], count
get_help(tetrahedra)

convex = pictures.TetraluxConvexify(Input=tetrahedra)
convex.UpdatePipeline()
assert convex.GetDataInformation().GetNumberOfCells() > count
imaginary = convex.CellData.GetArray("Imaginary")
assert imaginary.GetRange() == (0, 1), imaginary.GetRange()
get_help(convex)

neighbors = pictures.TetraluxNeighbors(Input=tetrahedra)
neighbors.UpdatePipeline()
assert neighbors.GetDataInformation().GetNumberOfCells() == count
assert neighbors.CellData.GetArray("Neighbors").GetNumberOfComponents() == 4
boundary = servermanager.Fetch(neighbors, idx=1)
# Each tetrahedron has four faces, of which two cells share each inside.
assert 0 < boundary.GetNumberOfCells() < count
get_help(neighbors)

table = pictures.TetraluxPreIntegrationTable(ScalarSize=8, LengthSize=4)
table.Function.OpacityFunction.Opacities = [0, 0, 1, 0.5]
table.UpdatePipeline()
image = servermanager.Fetch(table)
assert image.GetDimensions() == (8, 8, 4), image.GetDimensions()
texels = image.GetPointData().GetArray("RGBA")
assert texels.GetNumberOfComponents() == 4
# No segment is opaque, and the longest one at the largest scalar is the most opaque one.
opacities = texels.GetRange(3)
assert 0 <= opacities[0] < 1e-6 and abs(opacities[1] - 0.3935) < 1e-3, opacities
get_help(table)
print("menus: all filters and sources")
