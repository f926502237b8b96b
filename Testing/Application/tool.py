# SPDX-License-Identifier: BSD-3-Clause
"""Runs the tool in a folder of its own, for the tests of the command line."""

import glob
import os
import subprocess
import sys
import tempfile
import time
import unittest

TOOL = os.path.abspath(sys.argv[1])


class ToolTest(unittest.TestCase):
    """A test with an empty folder to work in."""

    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.folder = self.scratch.name
        self.addCleanup(self.scratch.cleanup)

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, text):
        with open(self.path(name), "w", encoding="utf-8") as file:
            file.write(text)
        return self.path(name)

    def files(self):
        return set(os.listdir(self.folder))

    def run_tool(self, *arguments):
        return subprocess.run(
            [TOOL, *map(str, arguments)],
            cwd=self.folder,
            capture_output=True,
            text=True,
            timeout=300,
            check=False,
        )

    def succeed(self, *arguments):
        """Runs the tool, which must succeed without a word on standard error."""
        result = self.run_tool(*arguments)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(result.stderr, "")
        return result.stdout

    def expect_failure(self, status, *arguments, says):
        """Runs the tool, which must fail with a status and one line that has all words, and leave
        every file as it is."""
        before = self.files()
        result = self.run_tool(*arguments)
        where = " ".join(map(str, arguments)) + ": " + result.stderr
        self.assertEqual(result.returncode, status, where)
        lines = result.stderr.splitlines()
        self.assertEqual(len(lines), 1, where)
        self.assertTrue(lines[0].startswith("tetralux: "), where)
        for word in [says] if isinstance(says, str) else says:
            self.assertIn(word, lines[0])
        self.assertEqual(result.stdout, "", where)
        self.assertEqual(self.files(), before, where)

    def interrupt(self, number, *arguments, until):
        """Starts the tool, sends it a signal when until(process) is true, and expects it to end as
        shells report it, with every file as it was."""
        before = self.files()
        with subprocess.Popen(
            [TOOL, *map(str, arguments)], cwd=self.folder, stdout=subprocess.PIPE, text=True
        ) as process:
            deadline = time.monotonic() + 60
            while not until(process) and process.poll() is None and time.monotonic() < deadline:
                time.sleep(0.01)
            time.sleep(0.2)  # into the work, past the making of the outputs
            self.assertIsNone(process.poll(), "the tool ended before the signal")
            process.send_signal(number)
            process.communicate(timeout=60)
            self.assertEqual(process.returncode, 128 + number)
        self.assertEqual(self.files(), before)

    def count_unnamed(self, process):
        """The files without a name in the folder that the tool's worker has open."""
        count = 0
        try:
            with open(f"/proc/{process.pid}/task/{process.pid}/children", encoding="ascii") as file:
                for child in file.read().split():
                    links = glob.glob(f"/proc/{child}/fd/*")
                    names = [os.readlink(link) for link in links]
                    count += sum(
                        name.startswith(os.path.realpath(self.folder)) and "(deleted)" in name
                        for name in names
                    )
        except FileNotFoundError:  # closed meanwhile
            pass
        return count


def main():
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]])
