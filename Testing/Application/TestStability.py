# SPDX-License-Identifier: BSD-3-Clause
"""tetralux bench --stability: the table that it prints, and its options."""

import re

import tool
from tool import ToolTest

FORMS = ["double", "double, emission only", "single, generic", "ray caster, single",
         "ray caster, double"]
ROW = re.compile(r"^  (\S.*?) {2,}(\d+) +(\S+) +(\S+) +(\S+) +(\d+)$")


def read_table(text):
    """{form: {group: (cases, relative, absolute, promise, bad)}}"""
    table = {}
    for line in text.splitlines():
        if ": promises " in line:
            rows = table.setdefault(line.split(": promises ")[0], {})
        match = ROW.match(line)
        if match:
            rows[match[1]] = [float(column) for column in match.groups()[1:]]
    return table


class Stability(ToolTest):
    def test_table(self):
        text = self.succeed("bench", "--stability", "--seed", 7, "--cases", 500)
        self.assertIn("Seed of the random combinations: 7", text)
        self.assertIn("Not finite: 0, negative: 0, opacity above 1: 0", text)
        table = read_table(text)
        self.assertLessEqual(set(FORMS), set(table))
        for form, rows in table.items():
            self.assertEqual(len(rows), 10, form)
            self.assertEqual(rows["random combinations"][0], 500)
            for group, (_, relative, _, promise, bad) in rows.items():
                where = f"{form}, {group}"
                self.assertLessEqual(promise, 1, where)
                self.assertEqual(bad, 0, where)
                if form.startswith("double"):
                    self.assertLessEqual(relative, 1e-12, where)
                if form.startswith("single"):
                    self.assertLessEqual(relative, 1e-6, where)

    def test_seed(self):
        first, again, other = (
            self.succeed("bench", "--stability", "--seed", seed, "--cases", 50)
            for seed in (1, 1, 2))
        self.assertEqual(first, again)
        self.assertNotEqual(read_table(first), read_table(other))

    def test_wrong_usage(self):
        self.expect_failure(2, "bench", "--seed", 1, says=["--seed", "--stability"])
        self.expect_failure(2, "bench", "--cases", 1, says=["--cases", "--stability"])
        self.expect_failure(2, "bench", "--stability", "--cases", -1, says="--cases")
        self.expect_failure(
            2, "bench", "--stability", "--output", "page", says=["--stability", "--output"])


if __name__ == "__main__":
    tool.main()
