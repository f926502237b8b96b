# SPDX-License-Identifier: BSD-3-Clause
"""A page of tables and pictures, from the template of `tetralux bench`."""

import json
import os

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOImage import vtkPNGWriter

TEMPLATE = os.path.join(os.path.dirname(__file__), "../../Application/Bench/page.html")


class Page:
    """The page of the benchmark tool, with sections of our own, and the pictures beside it."""

    def __init__(self, folder, title, *paragraphs):
        self.folder = folder
        self.results = {"title": title, "text": paragraphs, "sections": []}

    def add_section(self, title, *paragraphs, level=2, figures=(), columns=(), rows=(), notes=()):
        """figures: file names of pictures, with a caption. rows: texts for a table's columns."""
        section = {"title": title, "text": paragraphs, "level": level, "notes": notes}
        if figures:
            section["figures"] = [{"images": images, "caption": text} for images, text in figures]
        if columns:
            section["table"] = {"columns": columns, "rows": rows, "words": True}
        self.results["sections"].append(section)

    def write_picture(self, name, rgb):
        pixels = numpy.ascontiguousarray(numpy.clip(rgb * 255 + 0.5, 0, 255).astype(numpy.uint8))
        image = vtkImageData()
        image.SetDimensions(pixels.shape[1], pixels.shape[0], 1)
        image.GetPointData().SetScalars(numpy_to_vtk(pixels.reshape(-1, 3), deep=True))
        writer = vtkPNGWriter()
        writer.SetCompressionLevel(9)
        writer.SetFileName(os.path.join(self.folder, name))
        writer.SetInputData(image)
        writer.Write()

    def write(self):
        with open(TEMPLATE, encoding="utf-8") as file:
            template = file.read()
        text = json.dumps(self.results).replace("<", "\\u003c")  # no end of the script it is in
        with open(os.path.join(self.folder, "index.html"), "w", encoding="utf-8") as file:
            file.write(template.replace("@RESULTS@", text))
