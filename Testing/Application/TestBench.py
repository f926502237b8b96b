# SPDX-License-Identifier: BSD-3-Clause
"""The benchmark as a command: what it writes, and that its numbers are those of the pictures it
writes. Its times mean nothing here."""

import base64
import csv
import json
import os
import re
import shutil
import signal
import subprocess
import unittest

import numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOImage import vtkPNGReader
from vtkmodules.vtkIOXML import vtkXMLImageDataWriter
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy

import tool
from tool import ToolTest

PEERS = [
    "vtk-projected-tetrahedra", "vtk-bunyk", "vtk-bunyk-preintegration", "vtk-bunyk-closed-form",
]
IMAGE_PEERS = [
    "vtk-fixed-point-0.5", "vtk-fixed-point-0.125", "vtk-gpu-0.5", "vtk-gpu-0.125",
]
COLUMNS = [
    "method", "setting", "properties", "largest_error", "rms_error", "error_99.9",
    "share_above_1/255", "error_estimate", "best_ms", "median_ms", "frames", "prepare_ms", "bytes",
    "bits", "pareto", "failure",
]
BROWSER = shutil.which("chromium")  # runs the script of the page, where there is one
RESULTS = re.compile(r'(<script id="results" type="application/json">)(.*?)(</script>)', re.DOTALL)


class Bench(ToolTest):
    def read(self, *parts):
        with open(os.path.join(self.folder, *parts), newline="", encoding="utf-8") as file:
            return file.read()

    def read_rows(self, folder):
        """The settings of all scenes, each with its scene's name."""
        results = json.loads(self.read(folder, "results.json"))
        rows = [
            {"scene": scene["name"], **row}
            for scene in results["scenes"]
            for row in scene["settings"]
        ]
        for row in rows:
            self.assertNotIn("failure", row)
        self.check_table(folder, rows)
        return rows

    def check_table(self, folder, rows):
        """The CSV has the numbers of the JSON, to six digits."""
        table = list(csv.DictReader(self.read(folder, "results.csv").splitlines()))
        self.assertEqual(list(table[0]), ["scene", *COLUMNS])
        self.assertEqual(len(table), len(rows))
        for line, row in zip(table, rows):
            self.assertEqual(line["scene"], row["scene"])
            for name in COLUMNS:
                value = row.get(name)
                if value is None:
                    self.assertEqual(line[name], "", name)
                elif isinstance(value, str):
                    self.assertEqual(line[name], value)
                else:
                    self.assertAlmostEqual(float(line[name]), value, delta=1e-5 * abs(value))

    def read_page(self, folder):
        """The page without its results, and the results."""
        page = self.read(folder, "index.html")
        match = RESULTS.search(page)
        return page[: match.start(2)] + page[match.end(2):], json.loads(match[2])

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
        """The page has the results and the small pictures, names every picture, and needs nothing
        else."""
        files = self.list_files(folder)
        pictures = {name for name in files if name.endswith(".png")}
        self.assertEqual(files - pictures, {"index.html", "results.csv", "results.json"})
        kinds = ("picture", "difference")
        self.assertEqual(pictures, {row[kind] for row in rows for kind in kinds if kind in row})
        for row in rows:
            stem = f"pictures/{row['scene']}-{row['setting']}"
            self.assertEqual(row["picture"], stem + ".png")
            if row["setting"] == "reference":
                self.assertNotIn("difference", row)
            else:
                self.assertEqual(row["difference"], stem + "-difference.png")

        template, shown = self.read_page(folder)
        images = shown.pop("images")
        self.assertEqual(shown, json.loads(self.read(folder, "results.json")))
        self.assertEqual(
            set(images),
            {row["difference"] for row in rows if "difference" in row}
            | {
                row["picture"] for row in rows
                if row["setting"] in ("reference", *PEERS, *IMAGE_PEERS)
            },
        )
        for image in images.values():
            start = "data:image/png;base64,"
            self.assertTrue(image.startswith(start))
            data = base64.b64decode(image[len(start):], validate=True)
            self.assertTrue(data.startswith(b"\x89PNG\r\n") and data.rstrip().endswith(b"\x82"))
        for word in (self.folder, os.path.expanduser("~")):
            self.assertNotIn(word, template + json.dumps(shown))
        self.assertNotRegex(json.dumps(shown), rf"\b{re.escape(os.uname().nodename)}\b")
        self.assertEqual(
            set(re.findall(r"https?://[^\"]*", template)), {"http://www.w3.org/2000/svg"}
        )
        self.assertEqual(re.findall(r"<(?:link|script)[^>]*(?:src|href)=", template), [])

    def show_page(self, folder):
        """What a browser makes of the page: its document after the script ran, without the script
        and the results."""
        result = subprocess.run(
            [
                BROWSER, "--headless", "--no-sandbox", "--disable-gpu",
                "--disable-background-networking", "--user-data-dir=" + self.path("browser"),
                "--dump-dom", "file://" + os.path.join(self.path(folder), "index.html"),
            ],
            capture_output=True, text=True, timeout=120, check=True,
        )
        return re.sub(r"<(script|template|style)\b.*?</\1>", "", result.stdout, flags=re.DOTALL)

    def check_shown_page(self, folder, rows):
        """A browser shows every setting, picture and mark of the chart of one scene."""
        shown = self.show_page(folder)
        scene = rows[0]["scene"]
        self.assertIn("<h1>Error against run time</h1>", shown)
        self.assertIn(f'<h2 id="{scene}">', shown)
        for row in rows:
            self.assertIn(f"<b>{row['setting']}</b>", shown)
        self.assertEqual(shown.count("<tr class=\"front\">"), sum(row["pareto"] for row in rows))
        peers = [row for row in rows if row["method"].startswith("vtk-")]
        self.assertEqual(shown.count('<img src="data:image/png'), len(rows) - 1 + 1 + len(peers))
        # The chart: every setting but the reference, and each group once more in the legend.
        groups = {row["group"] for row in rows if row["setting"] != "reference"}
        self.assertEqual(shown.count("<svg"), 1)
        self.assertEqual(shown.count('class="mark"'), len(rows) - 1 + len(groups))
        self.assertNotRegex(re.sub('"data:[^"]*"', "", shown), "NaN|undefined|null|Infinity")

    def test_a_quick_run(self):
        self.succeed("bench", "--quick", "--scene", "ball-smooth", "--output", "out")
        rows = self.read_rows("out")
        self.assertEqual({row["scene"] for row in rows}, {"ball-smooth"})
        settings = {row["setting"]: row for row in rows}
        self.assertEqual(len(settings), len(rows), "no setting comes twice")
        self.assertEqual(rows[0]["setting"], "reference")
        self.assertEqual([row["setting"] for row in rows[-len(PEERS):]], PEERS)
        self.assertLessEqual(
            {"default", "error-1e-2", "error-1e-6", "single", "double", "sample-distance-2"},
            set(settings),
        )
        self.check_page("out", rows)
        if BROWSER:
            self.check_shown_page("out", rows)

        reference = settings["reference"]
        self.assertEqual(reference["largest_error"], 0)
        self.assertEqual(reference["method"], "integral")
        self.assertLess(reference["error_estimate"], 1e-8)
        self.assertFalse(reference["pareto"])
        for row in rows:
            where = row["setting"]
            self.assertLessEqual(row["rms_error"], row["largest_error"], where)
            self.assertLessEqual(row["error_99.9"], row["largest_error"], where)
            self.assertEqual(row["share_above_1/255"] > 0, row["largest_error"] > 1 / 255, where)
            self.assertGreater(row["best_ms"], 0, where)
            self.assertEqual(row["frames"], 1 if row is reference else 2, where)
            asked = re.search(r"MaximumError=(\S+)", row["properties"])
            if where.startswith("error-"):
                self.assertEqual((row["method"], row["bits"]), ("ray-cast", 32))
                # The single precision of the picture is the limit below 1e-6.
                self.assertLessEqual(row["largest_error"], float(asked[1]), where)
                self.assertLess(row["error_estimate"], 3 * float(asked[1]), where)
        self.assertLessEqual(settings["default"]["largest_error"], 1e-4)
        for worse, better in (
            ("kraus-8-bit", "kraus"), ("kraus-linear", "kraus"), ("weiler", "weiler-float"),
            ("table-32x16", "table-64x16"), ("table-128x8", "table-128x32"),
        ):
            self.assertGreater(
                settings[worse]["rms_error"], 1.2 * settings[better]["rms_error"], (worse, better)
            )
        self.assertGreater(settings["table-128x32"]["bytes"], settings["table-32x16"]["bytes"])
        for peer in PEERS:
            self.assertEqual(settings[peer]["bits"], 8)
            self.assertIsNone(settings[peer]["bytes"])
            self.assertGreater(settings[peer]["largest_error"], 1 / 255)
        self.assertGreater(settings["default"]["bytes"], 1000)

        # Of the front, a slower row has a smaller error. No row lies below its ends.
        front = sorted((row for row in rows if row["pareto"]), key=lambda row: row["best_ms"])
        for faster, slower in zip(front, front[1:]):
            self.assertGreater(faster["largest_error"], slower["largest_error"])
        ranked = [row for row in rows if row is not reference]
        self.assertEqual(front[0]["best_ms"], min(row["best_ms"] for row in ranked))
        self.assertEqual(
            front[-1]["largest_error"], min(row["largest_error"] for row in ranked)
        )

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

    def test_image_data(self):
        self.succeed("bench", "--quick", "--scene", "signal-smooth", "--output", "out")
        rows = self.read_rows("out")
        settings = {row["setting"]: row for row in rows}
        self.assertEqual(len(settings), len(rows), "no setting comes twice")
        self.assertEqual([row["setting"] for row in rows[:2]], ["reference", "default"])
        self.assertEqual([row["setting"] for row in rows[-len(IMAGE_PEERS):]], IMAGE_PEERS)
        self.assertEqual(settings["reference"]["method"], "integral")
        self.assertEqual({row["method"] for row in rows[1:-len(IMAGE_PEERS)]}, {"triangle-caster"})
        self.check_page("out", rows)
        if BROWSER:
            self.check_shown_page("out", rows)
        # The caster's pictures approach the integral as slices come closer.
        errors = [settings[f"slices-{d}"]["largest_error"] for d in (2, 1, 0.5, 0.25, 0.125)]
        self.assertEqual(errors, sorted(errors, reverse=True))
        self.assertLess(20 * errors[-1], errors[0])
        for row in rows:
            asked = re.search(r"MaximumError=(\S+)", row["properties"])
            if row["setting"].startswith("error-"):
                self.assertLessEqual(row["largest_error"], float(asked[1]), row["setting"])
        # VTK's mappers show the same, in 8 bits and less exactly.
        for peer in IMAGE_PEERS:
            self.assertEqual(settings[peer]["bits"], 8)
            self.assertLess(settings[peer]["rms_error"], 0.06, peer)

    def test_image_data_of_the_user(self):
        axis = numpy.arange(9) - 4.0
        z, y, x = numpy.meshgrid(axis, axis, axis, indexing="ij")
        image = vtkImageData()
        image.SetDimensions(9, 9, 9)
        image.SetSpacing(0.5, 1, 1)
        array = numpy_to_vtk(numpy.sqrt(x * x + y * y + z * z).ravel(), deep=True)
        array.SetName("radius")
        image.GetPointData().AddArray(array)
        writer = vtkXMLImageDataWriter()
        writer.SetInputData(image)
        writer.SetFileName(self.path("ball.vti"))
        writer.Write()
        arguments = ["bench", "ball.vti", "--quick", "--output", "out", "--setting"]
        self.succeed(*arguments, "triangle-caster SampleDistance=0.01")
        rows = self.read_rows("out")
        self.assertEqual(
            [row["setting"] for row in rows],
            ["reference", "default", "triangle-caster-SampleDistance-0.01", *IMAGE_PEERS],
        )
        self.assertLess(rows[2]["largest_error"], rows[1]["largest_error"])
        # Settings of cells split the voxels into tetrahedra.
        self.succeed(*arguments, "MaximumError=1e-3")
        rows = self.read_rows("out")
        self.assertEqual(rows[1]["method"], "ray-cast")
        self.assertEqual([row["setting"] for row in rows[-len(PEERS):]], PEERS)

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
            "--threads", 1, "--setting", "Precision=Single MaximumError=1e-2",
            "--setting", "Precision=double", "--output", "out",
        ]
        self.succeed(*arguments)
        rows = self.read_rows("out")
        self.assertEqual(
            [row["setting"] for row in rows],
            [
                "reference", "default", "Precision-Single-MaximumError-1e-2", "Precision-double",
                *PEERS,
            ],
        )
        self.assertEqual({row["scene"] for row in rows}, {"m"})
        self.assertEqual({row["frames"] for row in rows}, {1})
        self.assertEqual(rows[2]["properties"], "Precision=Single MaximumError=1e-2")
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
                         [row["setting"] for row in self.read_rows("out")])

    def test_features(self):
        self.succeed("bench", "--quick", "--features", "--scene", "ball-cells", "--setting",
                     "Precision=2", "--output", "out")
        features = {
            feature["feature"]: feature for feature in self.read_page("out")[1]["features"]
        }
        self.assertLessEqual(
            {
                "colour variation", "opacity variation", "3-D table", "shading", "clipping",
                "cropping", "opaque geometry", "non-convexity", "cell data", "maximum intensity",
                "isosurfaces traced", "shadows of traced isosurfaces",
            },
            set(features),
        )
        self.assertIsNone(features["cell data"]["forced"])
        self.assertIsNotNone(features["clipping"]["forced"])
        self.assertIsNone(features["isosurfaces traced"]["forced"])
        self.assertIsNone(features["shadows of traced isosurfaces"]["forced"])
        for name, feature in features.items():
            for case in ("plain", "forced", "used"):
                if feature[case]:
                    self.assertGreater(feature[case]["best_ms"], 0, (name, case))
            # What is forced changes nothing that the eye could see.
            if feature["forced"]:
                self.assertLess(feature["forced"]["difference"], 1e-4, name)
        if BROWSER:
            shown = self.show_page("out")
            for name in features:
                self.assertIn(f"<td>{name}</td>", shown)
            self.assertIn("not possible", shown)

    @unittest.skipUnless(BROWSER, "there is no Chromium")
    def test_what_a_browser_shows_of_hard_results(self):
        self.succeed("bench", "--quick", "--scene", "ball-smooth", "--setting", "Precision=2",
                     "--output", "out")
        page = self.read("out", "index.html")
        results = self.read_page("out")[1]
        scene = results["scenes"][0]
        failed = next(row for row in scene["settings"] if row["setting"] == "Precision-2")
        failed["failure"] = "</script><b>no & memory</b>"
        default = next(row for row in scene["settings"] if row["setting"] == "default")
        default["largest_error"] = 0
        text = json.dumps(results).replace("<", "\\u003c")
        with open(os.path.join(self.path("out"), "index.html"), "w", encoding="utf-8") as file:
            file.write(RESULTS.sub(lambda match: match[1] + text + match[3], page))
        shown = self.show_page("out")
        self.assertIn("failed: &lt;/script&gt;&lt;b&gt;no &amp; memory&lt;/b&gt;", shown)
        self.assertIn("exact", shown)
        self.assertNotRegex(re.sub('"data:[^"]*"', "", shown), "NaN|undefined|null|Infinity")

    def test_wrong_usage(self):
        self.succeed("generate", "ball", "--cells", 4, "--output", "ball.vtu")
        for arguments, says in [
            ([], ["--output", "required"]),
            (["--output", "out", "--scene", "boll"], ["--scene", "'boll'", "ball-smooth"]),
            (["--output", "out", "--setting", "Foo=1"], ["'Foo'", "MaximumError"]),
            (["--output", "out", "--setting", " "], ["--setting", "Property=Value"]),
            (["--output", "out", "--setting", "triangle-caster", "--setting", "ray-cast"],
             ["--setting", "'triangle-caster'", "'ray-cast'", "one kind"]),
            (["--output", "out", "--setting", "triangle-caster", "--scene", "ball-smooth"],
             ["'ball-smooth'", "signal-smooth"]),
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
            (["ball.vtu", "--setting", "triangle-caster TileSize=8", "--output", "out"],
             ["'ball.vtu'", "vtkImageData", "vtkUnstructuredGrid"]),
        ]:
            with self.subTest(arguments=arguments):
                self.expect_failure(1, "bench", "--quick", *arguments, says=says)
        self.expect_failure(
            1, "bench", "--scene", "blunt-fin-smooth", "--data", ".", "--output", "out",
            says="bluntfinxyz.bin",
        )

    def test_an_interrupt_leaves_nothing(self):
        def has_pictures(process):
            process.stdout.readline()
            return any("difference" in name for name in self.list_files("."))

        for number in (signal.SIGINT, signal.SIGTERM):
            with self.subTest(signal=number):
                self.interrupt(number, "bench", "--quick", "--output", "out", until=has_pictures)


if __name__ == "__main__":
    tool.main()
