# SPDX-License-Identifier: BSD-3-Clause
"""tetralux bench --traffic: the tables that it prints, and its options."""

import os
import re

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOXML import vtkXMLImageDataWriter

import tool
from tool import ToolTest

ROW = re.compile(r"^(\S.*?\S|) +(paper|here|OP) +([\d,]+(?: +[\d,]+)*)$")
COLUMNS = {
    "2": ("p_triangles", "s_triangles", "raypoints", "hits", "misses", "texture", "read", "written",
          "bandwidth"),
    "3": ("raypoints", "hits", "misses", "texture", "read", "written", "bandwidth"),
}


def read_tables(text):
    """{table: {(label, who): {column: count}}}, of tables 2 and 3"""
    tables = {}
    table = None
    for line in text.splitlines():
        if line.startswith("Table "):
            table = line[6]
        elif not line:
            table = None
        match = ROW.match(line)
        if table in COLUMNS and match:
            label = match[1] or label
            counts = [int(count.replace(",", "")) for count in match[3].split()]
            rows = tables.setdefault(table, {})
            rows[label, match[2]] = dict(zip(COLUMNS[table], counts, strict=True))
    return tables


class Traffic(ToolTest):
    def write_ball(self, name, size, values=np.uint8):
        """A ball in noise."""
        axis = np.arange(size) - 0.5 * (size - 1)
        z, y, x = np.meshgrid(axis, axis, axis, indexing="ij")
        ball = 200 - 200 / (0.3 * size) * np.maximum(np.sqrt(x * x + y * y + z * z) - 0.2 * size, 0)
        noise = np.random.default_rng(1).integers(0, 8, ball.shape)
        image = vtkImageData()
        image.SetDimensions(size, size, size)
        array = numpy_to_vtk((np.maximum(ball, 0) + noise).astype(values).ravel(), deep=True)
        image.GetPointData().SetScalars(array)
        writer = vtkXMLImageDataWriter()
        writer.SetInputData(image)
        writer.SetFileName(self.path(name))
        writer.Write()

    def check_identities(self, tables):
        for table, rows in tables.items():
            for where, row in rows.items():
                self.assertEqual(8 * row["raypoints"], row["hits"] + row["misses"], where)
                if where[1] == "OP":
                    self.assertLessEqual(row["texture"], 16 * row["misses"], where)
                else:
                    self.assertEqual(row["texture"], 16 * row["misses"], where)
                self.assertEqual(row["read"] == 0, table == "2", where)
                bandwidth = 30e-6 * (row["texture"] + row["read"] + row["written"])
                # One bandwidth of the paper is not what its bytes yield.
                self.assertAlmostEqual(row["bandwidth"], bandwidth, delta=1, msg=where)

    def test_file(self):
        self.write_ball("ball.vti", 24)
        text = self.succeed("bench", "ball.vti", "--traffic")
        self.assertNotIn("paper", text.split("Pictures of 256 x 256")[1])
        tables = read_tables(text)
        self.check_identities(tables)
        of_triangles, of_planes = tables["2"], tables["3"]
        self.assertEqual(len(of_triangles), 6 + 4)
        self.assertEqual(len(of_planes), 2)
        for cache in ("1 KB", "8 KB"):
            every = of_triangles[f"ball 256, {cache}", "here"]
            planes = of_planes[f"ball 256, {cache}", "here"]
            self.assertEqual(every["raypoints"], planes["raypoints"])
            self.assertGreaterEqual(planes["written"], 3 * planes["raypoints"])
            self.assertGreaterEqual(planes["read"], planes["written"])
            self.assertLess(every["written"], planes["written"] / 10)
            ended = of_triangles[f"ball opaque 256, {cache}, TT", "here"]
            self.assertLess(ended["p_triangles"], every["p_triangles"])
            self.assertEqual(ended["s_triangles"], every["s_triangles"])
        self.assertRegex(text, r"depths read back: 131,072 by pixels, 4,096 by S-triangles")
        self.assertEqual(text.count("48 KB, 12 ways"), 2)

    def test_data(self):
        os.mkdir(self.path("data"))
        for name in ("brain", "engine"):
            self.write_ball(f"data/{name}.vti", 12)
        text = self.succeed("bench", "--traffic", "--data", "data")
        tables = read_tables(text)
        self.check_identities(tables)
        self.assertEqual(len(tables["2"]), 14 * 2 + 10)
        self.assertEqual(len(tables["3"]), 6 * 2)
        self.assertEqual(tables["2"]["brain 256, 1 KB", "paper"]["hits"], 49129695)
        self.assertEqual(tables["3"]["engine 256, 8 KB", "paper"]["read"], 11772768)
        self.assertRegex(text, r"brain: planes \d+ \(paper 253\)")
        self.assertRegex(text, r"1024 +paper +20 +80 +320\n +here +21\.0 +83\.9 +335\.5\n")

    def test_wrong_input(self):
        self.expect_failure(2, "bench", "a.vti", "--traffic", "--output", "page",
                            says=["--traffic", "--output"])
        self.expect_failure(1, "bench", "a.vti", "--traffic", says="a.vti")
        self.write_ball("floats.vti", 8, np.float32)
        self.expect_failure(1, "bench", "floats.vti", "--traffic", says=["floats.vti", "8-bit"])
        self.succeed("generate", "ball", "--cells", 4, "--output", "ball.vtu")
        self.expect_failure(1, "bench", "ball.vtu", "--traffic", says=["ball.vtu", "image"])

    def test_no_data(self):
        data = os.environ.pop("TETRALUX_DATA", None)
        try:
            self.expect_failure(2, "bench", "--traffic", says=["FILE", "--data"])
        finally:
            if data is not None:
                os.environ["TETRALUX_DATA"] = data


if __name__ == "__main__":
    tool.main()
