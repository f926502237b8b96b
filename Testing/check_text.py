# SPDX-License-Identifier: BSD-3-Clause
"""Checks the text of sources and pages: check_text.py [TREE]

Sources: no line is longer than 100 columns, comments included. Pages (Markdown): headings have a
blank behind their #, which clang-format takes away; no line ends with blanks; fenced blocks are
closed; relative links lead somewhere; no list names a thing twice. Prints one line for each fault.
The exit status is 1 if there is any.
"""

import pathlib
import re
import sys

LARGEST_WIDTH = 100  # as in .clang-format
SOURCES = {".h", ".cxx", ".inl", ".in", ".glsl", ".cmake", ".py", ".sh"}
SKIPPED = re.compile(r"(\..*|build.*|__pycache__)")

FENCE = re.compile(r"\s*(```+|~~~+)")
HEADING = re.compile(r"#+[^#\s]|#{7,}")
LINK = re.compile(r"\]\(([^()\s]+)\)")
ITEM = re.compile(r"(\s*)[-*+] (.*)")
CODE = re.compile(r"`([^`]+)`")


def collect_files(tree):
    """The files of a tree without hidden folders, caches and builds."""
    for path in sorted(tree.iterdir()):
        if SKIPPED.fullmatch(path.name):
            continue
        if path.is_dir():
            yield from collect_files(path)
        else:
            yield path


def check_source(text):
    for number, line in enumerate(text.splitlines(), 1):
        if len(line) > LARGEST_WIDTH:
            yield number, f"{len(line)} columns; at most {LARGEST_WIDTH} are allowed"


def check_items(items):
    """Items of one list, each with its number; an item's name is what it shows as code first."""
    seen = {}
    for number, item in items:
        code = CODE.match(item)
        if code and seen.setdefault(code[1], number) != number:
            yield number, f"the list has {code[1]} in line {seen[code[1]]} already"


def check_page(text, folder):
    fence = None
    items = []
    for number, line in enumerate(text.splitlines(), 1):
        if line != line.rstrip():
            yield number, "blanks at the end of the line"
        mark = FENCE.match(line)
        if mark and (fence is None or mark[1].startswith(fence[1])):
            fence = None if fence else (number, mark[1])
            continue
        if fence:
            continue
        if HEADING.match(line):
            yield number, "a heading needs one to six # and a blank behind them"
        for target in LINK.findall(re.sub(CODE, "", line)):
            path = target.split("#")[0]
            if path and "://" not in path and not (folder / path).exists():
                yield number, f"there is no {path}"
        item = ITEM.fullmatch(line)
        if item and not item[1]:
            items.append((number, item[2]))
        elif line and not line.startswith(" "):
            yield from check_items(items)
            items = []
    yield from check_items(items)
    if fence:
        yield fence[0], "the block that begins here is not closed"


def check(tree):
    """One line for each fault of a tree."""
    for path in collect_files(tree):
        if path.suffix == ".md":
            faults = check_page(path.read_text(), path.parent)
        elif path.suffix in SOURCES or path.name == "CMakeLists.txt":
            faults = check_source(path.read_text())
        else:
            continue
        for number, fault in faults:
            yield f"{path.relative_to(tree)}:{number}: {fault}"


def main():
    default = pathlib.Path(__file__).resolve().parents[1]
    tree = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else default
    faults = list(check(tree))
    for fault in faults:
        print(fault)
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
