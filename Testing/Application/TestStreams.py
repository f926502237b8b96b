# SPDX-License-Identifier: BSD-3-Clause
"""Standard streams, pipes and devices in place of files; disks that are full; names with line
breaks, and without letters."""

import os
import resource
import signal
import stat
import subprocess

import tool
from tool import TOOL, ToolTest

PNG = b"\x89PNG"


class Streams(ToolTest):
    def setUp(self):
        super().setUp()
        self.succeed("generate", "ball", "--cells", 4, "--output", "ball.vtu")
        with open(self.path("ball.vtu"), "rb") as file:
            self.ball = file.read()

    def run_bytes(self, *arguments, **options):
        return subprocess.run(
            [TOOL, *map(str, arguments)],
            cwd=self.folder, stderr=subprocess.PIPE, timeout=60, check=False, **options,
        )

    def expect_line(self, result, status, *words):
        line = result.stderr.decode()
        self.assertEqual(result.returncode, status, line)
        self.assertEqual(line.count("\n"), 1, line)
        for word in ("tetralux: ", *words):
            self.assertIn(word, line)

    def test_standard_output_that_takes_nothing(self):
        commands = (
            ("info", "ball.vtu"), ("generate", "--list"), ("--version",), ("render", "--help"),
            ("render", "ball.vtu", "--size", "4,4", "--output", "-"),
        )
        for command in commands:
            with self.subTest(command=command):
                with open("/dev/full", "wb") as full:
                    result = self.run_bytes(*command, stdout=full)
                self.expect_line(result, 1, "standard output", "No space left on device")
                close = subprocess.run(
                    ["sh", "-c", 'exec "$0" "$@" >&-', TOOL, *command],
                    cwd=self.folder, stderr=subprocess.PIPE, timeout=60, check=False,
                )
                self.expect_line(close, 1, "standard output", "Bad file descriptor")
                reading, writing = os.pipe()
                os.close(reading)
                result = self.run_bytes(*command, stdout=writing)
                os.close(writing)
                self.expect_line(result, 1, "standard output", "Broken pipe")

    def test_closed_streams_do_not_get_into_files(self):
        result = subprocess.run(
            ["sh", "-c", 'exec "$0" "$@" <&- >&- 2>&-', TOOL, "render", "ball.vtu", "--size", "4,4",
             "--output", "out.png"],
            cwd=self.folder, timeout=60, check=False,
        )
        self.assertEqual(result.returncode, 0)
        with open(self.path("out.png"), "rb") as file:
            self.assertEqual(file.read(4), PNG)

    def test_outputs_to_streams(self):
        render = ("render", "ball.vtu", "--size", "4,4", "--output")
        self.succeed(*render, "out.png")
        with open(self.path("out.png"), "rb") as file:
            picture = file.read()
        result = self.run_bytes(*render, "-", stdout=subprocess.PIPE)
        self.assertEqual((result.stdout, result.stderr), (picture, b""))
        os.mkfifo(self.path("pipe"))
        with subprocess.Popen(["cat", self.path("pipe")], stdout=subprocess.PIPE) as reader:
            self.succeed(*render, "pipe")
            self.assertEqual(reader.communicate()[0], picture)
        self.assertTrue(stat.S_ISFIFO(os.stat(self.path("pipe")).st_mode))
        self.succeed(*render, "/dev/null")
        result = self.run_bytes("generate", "ball", "--cells", 4, "--output", "-",
                                stdout=subprocess.PIPE)
        self.assertEqual((result.stdout, result.stderr), (self.ball, b""))
        self.assertEqual(self.files(), {"ball.vtu", "out.png", "pipe"})
        for arguments in (("--stats", "--output", "-"), ("--output", "-", "--stats", "-")):
            self.expect_failure(2, "render", "ball.vtu", *arguments, says=["--stats", "--output"])

    def test_inputs_from_streams(self):
        expected = self.succeed("info", "ball.vtu").splitlines()[1:4]
        for name, source in (("-", None), ("/dev/stdin", None), ("pipe", "pipe")):
            with self.subTest(name=name):
                if source:
                    os.mkfifo(self.path(source))
                    with subprocess.Popen(
                        ["sh", "-c", "cat ball.vtu > pipe"], cwd=self.folder
                    ):
                        result = self.run_bytes("info", name, stdout=subprocess.PIPE)
                else:
                    result = self.run_bytes(
                        "info", name, input=self.ball, stdout=subprocess.PIPE
                    )
                self.assertEqual(result.stderr, b"")
                self.assertEqual(result.stdout.decode().splitlines()[1:4], expected)
        for content in (b"", b"no such format", self.ball[:500]):
            result = self.run_bytes("info", "-", input=content, stdout=subprocess.PIPE)
            self.expect_line(result, 1, "'standard input'")
            self.assertNotIn(b"/proc", result.stderr)

    def test_full_disks(self):
        # A limit of the size of files, which each writer meets as it meets a full disk.
        def limit():
            resource.setrlimit(resource.RLIMIT_FSIZE, (256, 256))

        before = self.files()
        render = ("render", "ball.vtu", "--size", "64,64")
        for arguments, name in (
            ((*render, "--output", "out.png"), "out.png"),
            ((*render, "--output", "out.vti"), "out.vti"),
            (("render", "ball.vtu", "--size", "4,4", "--output", "/dev/null", "--stats",
              "out.json"), "out.json"),
            (("generate", "ball", "--cells", 4, "--output", "out.vtu"), "out.vtu"),
            (("generate", "ring", "--steps", 2, "--output", "out.pvd"), "out_0000"),
            (("bench", "--quick", "--scene", "ball-smooth", "--setting", "Precision=double",
              "--output", "out"), "png"),
        ):
            with self.subTest(name=name):
                result = self.run_bytes(*arguments, stdout=subprocess.PIPE, preexec_fn=limit)
                self.expect_line(result, 1, name, "File too large")
                self.assertEqual(self.files(), before)

    def test_line_breaks_in_names(self):
        self.expect_failure(1, "info", "a\nb\x1b.vtu", says="'a\\nb\\033.vtu'")
        os.rename(self.path("ball.vtu"), self.path("b\nall.vtu"))
        self.assertIn("b\\nall.vtu\n", self.succeed("info", "b\nall.vtu"))
        self.expect_failure(
            1, "render", "b\nall.vtu", "--array", "a\nb", "--output", "out.png",
            says="'a\\nb'",
        )

    def test_empty_names(self):
        for option in ("--array", "--color-array", "--transfer", "--plot3d-q", "--output"):
            arguments = [] if option == "--output" else ["--output", "out.png"]
            self.expect_failure(
                2, "render", "ball.vtu", *arguments, option, "", says=[option, "is empty"]
            )
        self.expect_failure(2, "info", "", says=["IN", "is empty"])

    def test_an_ignored_signal_does_not_end_the_tool(self):
        def ignore():
            signal.signal(signal.SIGHUP, signal.SIG_IGN)  # as nohup does

        os.mkfifo(self.path("pipe"))
        with subprocess.Popen(
            [TOOL, "info", "pipe"], cwd=self.folder, stdout=subprocess.PIPE, preexec_fn=ignore
        ) as process:
            with open(self.path("pipe"), "wb") as pipe:
                process.send_signal(signal.SIGHUP)
                pipe.write(self.ball)
            self.assertIn(b"tetrahedra", process.communicate(timeout=60)[0])
            self.assertEqual(process.returncode, 0)


if __name__ == "__main__":
    tool.main()
