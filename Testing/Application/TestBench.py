# SPDX-License-Identifier: BSD-3-Clause
"""The benchmark as a command: what it writes, and that its numbers are those of the pictures it
writes. Its times mean nothing here."""

import base64
import csv
import json
import os
import re
import signal
import subprocess
import xml.etree.ElementTree

from vtkmodules.vtkIOImage import vtkPNGReader
from vtkmodules.util.numpy_support import vtk_to_numpy

import tool
from tool import ToolTest

PEERS = [
    "vtk-projected-tetrahedra", "vtk-bunyk", "vtk-bunyk-preintegration", "vtk-bunyk-closed-form",
]
NUMBERS = [
    "largest_error", "rms_error", "error_99.9", "share_above_1/255", "best_ms", "median_ms",
    "frames",
    "prepare_ms",
]


class Bench(ToolTest):
    def read_results(self, folder):
        path = os.path.join(self.path(folder), "results.csv")
        with open(path, newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        for row in rows:
            self.assertNotIn(None, row, "more fields than names")
            self.assertNotIn(None, row.values(), "fewer fields than names")
            self.assertEqual(row["failure"], "")
            for name in NUMBERS:
                row[name] = float(row[name])
        return rows

    def read_page(self, folder):
        with open(os.path.join(self.path(folder), "index.html"), encoding="utf-8") as file:
            return file.read()

    def read_png(self, *parts):
        reader = vtkPNGReader()
        reader.SetFileName(os.path.join(self.folder, *parts))
        reader.Update()
        image = reader.GetOutput()
        width, height, _ = image.GetDimensions()
        return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, -1) / 255

    def list_files(self, folder):
        return {
            os.path.relpath(os.path.join(base, name), self.path(folder))
            for base, _, names in os.walk(self.path(folder))
            for name in names
        }

    def check_page(self, folder, rows):
        """Every picture and chart is named, every row is in it, nothing outside of it is needed."""
        page = self.read_page(folder)
        files = self.list_files(folder)
        self.assertLessEqual({"index.html", "results.csv"}, files)
        pictures = {name for name in files if name.endswith(".png")}
        self.assertEqual(len(files), len(pictures) + 2)
        for name in pictures:
            self.assertTrue(name in page, name)
        for row in rows:
            stem = f"pictures/{row['scene']}-{row['setting']}"
            self.assertIn(stem + ".png", pictures)
            self.assertEqual(row["setting"] != "reference", stem + "-difference.png" in pictures)
            self.assertIn(f"charts/{row['scene']}.png", pictures)
        for source in re.findall(r'(?:src|href)="([^"]*)"', page):
            self.assertRegex(source, r"^(data:image/png;base64,|#)")
            if source.startswith("data:"):
                image = base64.b64decode(source.split(",")[1], validate=True)
                self.assertTrue(image.startswith(b"\x89PNG\r\n"))
                self.assertTrue(image.rstrip().endswith(b"\x82"))
        words = re.sub(r'"data:[^"]*"', '""', page)
        for word in ("http", self.folder, os.path.expanduser("~")):
            self.assertNotIn(word, words)
        self.assertNotRegex(words, rf"\b{re.escape(os.uname().nodename)}\b")
        # It is balanced: an XML parser takes it but for what HTML leaves open.
        text = re.sub(r"<!DOCTYPE html>|<meta [^>]*>|<br>", "", words)
        text = re.sub(r"(<img [^>]*)>", r"\1/>", text)
        text = re.sub(r"&(ndash|times);", "", text)
        xml.etree.ElementTree.fromstring(text)

    def test_a_quick_run(self):
        self.succeed("bench", "--quick", "--scene", "ball-smooth", "--output", "out")
        rows = self.read_results("out")
        self.assertEqual({row["scene"] for row in rows}, {"ball-smooth"})
        settings = {row["setting"]: row for row in rows}
        self.assertEqual(len(settings), len(rows), "no setting comes twice")
        self.assertEqual(rows[0]["setting"], "reference")
        self.assertEqual([row["setting"] for row in rows[-len(PEERS):]], PEERS)
        for name in (
            "default", "error-1e-2", "error-1e-6", "single", "double", "sample-distance-2"
        ):
            self.assertIn(name, settings)
        self.check_page("out", rows)

        reference = settings["reference"]
        self.assertEqual(reference["largest_error"], 0)
        self.assertEqual(reference["pareto"], "0")
        for row in rows:
            where = row["setting"]
            self.assertLessEqual(row["rms_error"], row["largest_error"], where)
            self.assertLessEqual(row["error_99.9"], row["largest_error"], where)
            self.assertEqual(row["share_above_1/255"] > 0, row["largest_error"] > 1 / 255, where)
            self.assertLessEqual(row["best_ms"], row["median_ms"], where)
            self.assertGreater(row["best_ms"], 0, where)
            self.assertEqual(row["frames"], 2, where)
            asked = re.search(r"MaximumError=(\S+)", row["properties"])
            if row["method"] == "ray-cast" and row["bits"] == "32" and where.startswith("error-"):
                # The single precision of the picture is the limit below 1e-6.
                self.assertLessEqual(row["largest_error"], float(asked[1]), where)
                self.assertLess(float(row["error_estimate"]), 3 * float(asked[1]), where)
        self.assertLessEqual(settings["default"]["largest_error"], 1e-4)
        for worse, better in (
            ("kraus-8-bit", "kraus"), ("kraus-linear", "kraus"), ("weiler", "weiler-float"),
            ("table-32x16", "table-64x16"), ("table-128x8", "table-128x32"),
        ):
            self.assertGreater(
                settings[worse]["rms_error"], 1.2 * settings[better]["rms_error"], (worse, better)
            )
        self.assertGreater(
            int(settings["table-128x32"]["bytes"]), int(settings["table-32x16"]["bytes"])
        )
        for peer in PEERS:
            self.assertEqual(settings[peer]["bits"], "8")
            self.assertEqual(settings[peer]["bytes"], "")
            self.assertGreater(settings[peer]["largest_error"], 1 / 255)
        self.assertGreater(int(settings["default"]["bytes"]), 1000)

        # No row of the front is worse than another in both, and every other row is.
        ranked = [row for row in rows if row is not reference]
        for row in ranked:
            worse = any(
                other["largest_error"] <= row["largest_error"] and other["best_ms"] < row["best_ms"]
                or other["largest_error"] < row["largest_error"]
                and other["best_ms"] <= row["best_ms"]
                for other in ranked
            )
            self.assertEqual(row["pareto"], "0" if worse else "1", row["setting"])

        # The numbers are those of the pictures: as far as 8 bit tell.
        expected = self.read_png("out", "pictures", "ball-smooth-reference.png")
        self.assertGreater(expected.max(), 0.3)
        for name in PEERS + ["sample-distance-2", "default"]:
            picture = self.read_png("out", "pictures", f"ball-smooth-{name}.png")
            error = abs(picture - expected).max(axis=2)
            # Opacity is not in the picture, and may be more wrong than its colours.
            self.assertLessEqual(error.max(), settings[name]["largest_error"] + 1.01 / 255, name)
            difference = self.read_png("out", "pictures", f"ball-smooth-{name}-difference.png")
            self.assertEqual(difference.shape[2], 1)
            if settings[name]["largest_error"] > 0.1:  # not amplified
                self.assertLess((error - difference[:, :, 0]).max(), 1.01 / 255, name)

    def test_a_file_and_settings_of_the_user(self):
        self.succeed(
            "generate", "gear", "--teeth", 4, "--across", 2, "--along", 2, "--output", "m.vtu"
        )
        self.write("steps.json", json.dumps({
            "RGBPoints": [-1, 1, 0, 0, 1, 1, 0.5, 0], "Points": [-1, 0.2, 0.5, 0, 1, 0.8, 0.5, 0],
        }))
        arguments = [
            "bench", "m.vtu", "--array", "Field", "--transfer", "steps.json", "--camera-position",
            "0,0,4", "--camera-parallel-scale", 1.2, "--size", "30,20", "--frames", 1,
            "--threads", 1,
            "--setting", "Precision=1 MaximumError=1e-2", "--setting", "Precision=2",
            "--output", "out",
        ]
        self.succeed(*arguments)
        rows = self.read_results("out")
        self.assertEqual(
            [row["setting"] for row in rows],
            ["reference", "default", "Precision-1-MaximumError-1e-2", "Precision-2", *PEERS],
        )
        self.assertEqual({row["scene"] for row in rows}, {"m"})
        self.assertEqual({row["frames"] for row in rows}, {1})
        self.assertEqual(rows[2]["properties"], "Precision=1 MaximumError=1e-2")
        self.assertLessEqual(rows[2]["largest_error"], 1e-2)
        self.check_page("out", rows)
        picture = self.read_png("out", "pictures", "m-reference.png")
        self.assertEqual(picture.shape, (20, 30, 3))
        self.assertEqual(picture[:, :, 2].max(), 0, "there is no blue in the transfer function")
        self.assertGreater(picture[:, :, 0].max(), 0.1)

        # The same once more replaces it; a folder with anything else is left alone.
        self.write("out/old.txt", "old")
        self.succeed(*arguments)
        self.assertNotIn("old.txt", os.listdir(self.path("out")))
        self.assertEqual([row["setting"] for row in rows],
                         [row["setting"] for row in self.read_results("out")])

    def test_features(self):
        self.succeed("bench", "--quick", "--features", "--scene", "ball-cells", "--setting",
                     "Precision=2", "--output", "out")
        page = self.read_page("out")
        table = page[page.index('id="features"'):]
        for feature in (
            "colour variation", "opacity variation", "3-D table", "shading", "clipping", "cropping",
            "opaque geometry", "non-convexity", "cell data", "maximum intensity",
        ):
            self.assertIn(f"<td>{feature}</td>", table)
        # What is forced changes nothing that the eye could see.
        for row in re.findall(r"<tr><td>.*?</tr>", table):
            cells = re.findall(r"<td[^>]*>(.*?)</td>", row)
            self.assertGreater(float(cells[8]), 0, cells)
            if cells[3] != "cannot be had":
                self.assertLess(float(cells[6]), 1e-4, cells)
                self.assertGreater(float(cells[4]), 0, cells)

    def test_wrong_usage(self):
        self.succeed("generate", "ball", "--cells", 4, "--output", "ball.vtu")
        for arguments, says in [
            ([], ["--output", "required"]),
            (["--output", "out", "--scene", "boll"], ["--scene", "'boll'", "ball-smooth"]),
            (["--output", "out", "--setting", "Foo=1"], ["'Foo'", "MaximumError"]),
            (["--output", "out", "--setting", " "], ["--setting", "Property=Value"]),
            (["--output", "out", "--setting", "MaximumError=2"], ["MaximumError", "from 0 to 1"]),
            (["--output", "out", "--frames", "0"], ["--frames", "from 1"]),
            (["--output", "out", "--size", "0,1"], ["--size", "W,H"]),
            (["--output", "out", "--array", "Field"], ["FILE"]),
            (["--output", "out", "--camera-position", "0,0,1"], ["FILE"]),
            (["ball.vtu", "--output", "out", "--data", "."], ["--data", "FILE"]),
            (["--output", "out", "--frobnicate"], ["--frobnicate"]),
        ]:
            with self.subTest(arguments=arguments):
                self.expect_failure(2, "bench", "--quick", *arguments, says=says)

    def test_failed_work(self):
        self.succeed("generate", "ball", "--cells", 4, "--output", "ball.vtu")
        os.mkdir(self.path("other"))
        self.write("other/letter.txt", "")
        for arguments, says in [
            (["--output", "other"], ["'other'", "something else"]),
            (["--output", "ball.vtu"], ["'ball.vtu'", "file"]),
            (["--output", "missing/out"], ["'missing/out'", "No such file"]),
            (["missing.vtu", "--output", "out"], ["'missing.vtu'"]),
            (["ball.vtu", "--array", "Temp", "--output", "out"], ["'Temp'", "Field"]),
        ]:
            with self.subTest(arguments=arguments):
                self.expect_failure(1, "bench", "--quick", *arguments, says=says)
        self.expect_failure(
            1, "bench", "--scene", "blunt-fin-smooth", "--data", ".", "--output", "out",
            says="bluntfinxyz.bin",
        )

    def test_an_interrupt_leaves_nothing(self):
        before = self.files()
        with subprocess.Popen(
            [tool.TOOL, "bench", "--quick", "--frames", "2", "--output", "out"],
            cwd=self.folder, stdout=subprocess.PIPE,
        ) as process:
            process.stdout.readline()  # the first scene is being measured
            self.assertNotEqual(self.files(), before)
            process.send_signal(signal.SIGTERM)
            process.stdout.read()
            self.assertEqual(process.wait(60), 128 + signal.SIGTERM)
        self.assertEqual(self.files(), before)


if __name__ == "__main__":
    tool.main()
