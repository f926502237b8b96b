# SPDX-License-Identifier: BSD-3-Clause
"""The check of layers finds what is planted in a small tree."""

import pathlib
import tempfile
import unittest

import layers

TABLE = """| room | may include | what it holds |
| --- | --- | --- |
| `Module/Low` | - | the ground |
| `Module/High` | `Module/Low` | the roof |
"""

DRAWING = "<title>Module/High&#45;&gt;Module/Low</title>"


class Tree(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.tree = pathlib.Path(folder.name)
        self.write("Documentation/Architecture.md", TABLE)
        self.write("Documentation/rooms.svg", DRAWING)
        self.write("Module/Low/Ground.h", "#include <vector>\n")
        self.write("Module/High/Roof.cxx", '#include "Low/Ground.h"\n')

    def write(self, name, text):
        path = self.tree / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)

    def expect(self, *texts):
        faults = layers.check(self.tree)
        self.assertEqual(len(faults), len(texts), faults)
        for fault, text in zip(faults, texts):
            self.assertIn(text, fault)

    def test_a_clean_tree_has_no_faults(self):
        self.expect()

    def test_what_tests_of_a_module_include_is_not_ruled(self):
        self.write("Module/High/Beam.h", "")
        self.write("Module/Low/Testing/Cxx/TestGround.cxx", '#include "High/Beam.h"\n')
        self.expect()

    def test_an_upward_include(self):
        self.write("Module/High/Beam.h", "")
        self.write("Module/Low/Ground.cxx", '#include "High/Beam.h"\n')
        self.expect("Module/Low may not include Module/High")

    def test_an_indented_include_within_a_condition(self):
        self.write("Module/High/Beam.h", "")
        self.write("Module/Low/Ground.cxx", '#ifdef X\n#  include "High/Beam.h"\n#endif\n')
        self.expect("Module/Low may not include Module/High")

    def test_a_shader_of_another_room(self):
        self.write("Module/High/Picture.glsl", "")
        self.write("Module/Low/Ground.cxx", '#include "Picture.h"\n')
        self.expect("Module/Low may not include Module/High")

    def test_a_room_without_a_row(self):
        self.write("Module/New/Thing.h", "")
        self.expect("its room Module/New has no row")

    def test_an_arrow_that_nobody_uses(self):
        self.write("Module/High/Roof.cxx", "")
        self.expect("Module/High may include Module/Low, but does not")

    def test_files_that_include_each_other(self):
        self.write("Module/Low/A.h", '#include "Low/B.h"\n')
        self.write("Module/Low/B.h", '#include "Low/A.h"\n')
        self.expect("Module/Low/A, Module/Low/B")

    def test_a_table_with_a_circle(self):
        self.write("Documentation/Architecture.md", TABLE.replace("| - |", "| `Module/High` |"))
        self.write("Module/High/Beam.h", "")
        self.write("Module/Low/Ground.cxx", '#include "High/Beam.h"\n')
        self.expect("goes round in a circle")

    def test_a_drawing_of_another_table(self):
        self.write("Documentation/rooms.svg", "")
        self.expect("is not that of the table")


if __name__ == "__main__":
    unittest.main()
