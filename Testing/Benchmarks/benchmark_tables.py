# SPDX-License-Identifier: BSD-3-Clause
"""Tables of benchmarks: as .csv, as Markdown, and in a page."""

import csv


def write_csv(path, rows):
    """rows: values by column, the same columns in all."""
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, rows[0].keys(), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def make_table(titles, rows):
    lines = ["| " + " | ".join(titles) + " |", "|" + " --- |" * len(titles)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows]) + "\n"


def replace_table(page, marker, table):
    """Puts a table into a page of Markdown, in place of the first one after a line's marker."""
    with open(page, encoding="utf-8") as file:
        lines = file.read().splitlines(keepends=True)
    try:
        start = next(i for i, line in enumerate(lines) if marker in line)
        first = next(i for i in range(start, len(lines)) if lines[i].startswith("|"))
    except StopIteration:
        raise SystemExit(f"{page}: no table after '{marker}'") from None
    last = next((i for i in range(first, len(lines)) if not lines[i].startswith("|")), len(lines))
    lines[first:last] = table.splitlines(keepends=True)
    with open(page, "w", encoding="utf-8") as file:
        file.writelines(lines)
