# SPDX-License-Identifier: BSD-3-Clause
"""vtkPreIntegrationTableSource from Python: build, save, read again, compare."""

import math
import os
import tempfile

from vtkmodules.vtkIOXML import vtkXMLImageDataReader, vtkXMLImageDataWriter

import tetralux
from mapper_scene import make_property


def make_table():
    table = tetralux.vtkPreIntegrationTableSource()
    colors = [(0, 1, 0, 0), (1, 0, 0, 1)]
    table.SetVolumeProperty(make_property(colors, opacities=[(0, 0.5), (1, 0.5)]))
    table.SetScalarSize(17)
    table.SetLengthSize(9)
    table.SetLongestSegment(4)
    return table


def test_values():
    table = make_table()
    table.Update()
    image = table.GetOutput()
    assert image.GetDimensions() == (17, 17, 9)
    assert image.GetBounds() == (0, 1, 0, 1, 0, 4)
    # Constant opacity: 1 - exp(-length / 2), and all of it red where both scalars are 0.
    for k in range(9):
        opacity = 1 - math.exp(-0.25 * k)
        assert abs(image.GetScalarComponentAsDouble(3, 11, k, 3) - opacity) < 1e-6
        assert abs(image.GetScalarComponentAsDouble(0, 0, k, 0) - opacity) < 1e-6
        assert image.GetScalarComponentAsDouble(0, 0, k, 2) == 0


def test_errors_are_stated():
    table = make_table()
    table.Update()
    fields = table.GetOutput().GetFieldData()
    bound = fields.GetArray("ErrorBound")
    estimate = fields.GetArray("ErrorEstimate")
    assert 0 < estimate.GetValue(0) <= bound.GetValue(0) < 1
    # Halved steps along the length: a quarter of the error.
    table.SetLengthSize(17)
    table.Update()
    finer = table.GetOutput().GetFieldData().GetArray("ErrorEstimate")
    assert finer.GetValue(0) < 0.4 * estimate.GetValue(0)


def test_saved_and_read_again():
    table = make_table()
    table.SetFormatToUNorm16()
    with tempfile.TemporaryDirectory() as folder:
        name = os.path.join(folder, "table.vti")
        writer = vtkXMLImageDataWriter()
        writer.SetInputConnection(table.GetOutputPort())
        writer.SetFileName(name)
        assert writer.Write() == 1
        reader = vtkXMLImageDataReader()
        reader.SetFileName(name)
        reader.Update()
        read = reader.GetOutput()
    table.Update()
    image = table.GetOutput()
    assert read.GetDimensions() == image.GetDimensions()
    assert read.GetScalarTypeAsString() == "unsigned short"
    for point in range(0, image.GetNumberOfPoints(), 7):
        a = image.GetPointData().GetScalars().GetTuple(point)
        assert read.GetPointData().GetScalars().GetTuple(point) == a
    assert read.GetFieldData().GetArray("ScalarTexels").GetNumberOfTuples() == 17


def test_follows_the_property():
    table = make_table()
    table.Update()
    before = table.GetMTime()
    table.GetVolumeProperty().GetScalarOpacity(0).AddPoint(0.5, 1)
    assert table.GetMTime() > before


if __name__ == "__main__":
    test_values()
    test_errors_are_stated()
    test_saved_and_read_again()
    test_follows_the_property()
