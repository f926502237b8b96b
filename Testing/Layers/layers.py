# SPDX-License-Identifier: BSD-3-Clause
"""Checks who includes whom against the table in Documentation/Architecture.md.

layers.py [TREE]         check; one line for each fault, exit status 1 if there is any
layers.py --draw [TREE]  print the table as a graph for Graphviz, without arrows that others imply:
                         layers.py --draw | dot -Tsvg > Documentation/rooms.svg
"""

import pathlib
import re
import sys

ARCHITECTURE = pathlib.Path("Documentation/Architecture.md")
DRAWING = pathlib.Path("Documentation/rooms.svg")
TOPS = ("Module", "Filters", "Rendering", "Evaluation", "Application", "ParaView")
PRIVATE_TREES = ("Testing/Reference",)
SUFFIXES = (".h", ".cxx", ".inl", ".glsl")
INCLUDE = re.compile(r'^\s*#\s*include\s+"([^"]+)"', re.MULTILINE)


def read_table(tree):
    """Room -> the rooms that it may include, from the page's table."""
    table = {}
    for line in (tree / ARCHITECTURE).read_text().splitlines():
        cells = [cell.strip() for cell in line.split("|")]
        if len(cells) < 4 or not cells[1].startswith("`"):
            continue
        room = cells[1].strip("`")
        allowed = re.findall(r"`([^`]+)`", cells[2])
        if room in table:
            raise SystemExit(f"{ARCHITECTURE}: {room} has two rows")
        table[room] = allowed
    for room, allowed in table.items():
        for other in allowed:
            if other not in table:
                raise SystemExit(f"{ARCHITECTURE}: {room} may include {other}, which has no row")
    return table


def collect_sources(tree):
    """What the table rules: not a module's own tests, which may include what they test."""
    for top in TOPS + PRIVATE_TREES:
        for path in sorted((tree / top).rglob("*")):
            own_tests = "Testing" in path.relative_to(tree / top).parts
            if path.suffix in SUFFIXES and not own_tests:
                yield path.relative_to(tree)


class IncludeGraph:
    """The files of a tree, their rooms and their includes."""

    def __init__(self, tree):
        self.files = list(collect_sources(tree))
        roots = [pathlib.Path(top) for top in TOPS + PRIVATE_TREES]
        self.by_name = {}
        for file in self.files:
            for root in roots:
                if root in file.parents:
                    self.by_name.setdefault(str(file.relative_to(root)), []).append(file)
            if file.suffix == ".glsl":  # a shader is encoded into a header of its name
                self.by_name.setdefault(file.stem + ".h", []).append(file)
        self.includes = {}
        self.ambiguous = []
        for file in self.files:
            targets = set()
            if file.suffix != ".glsl":
                for name in INCLUDE.findall((tree / file).read_text()):
                    found = self.by_name.get(name, [])
                    if len(found) > 1:
                        found = [f for f in found if f.parts[0] == file.parts[0]] or found
                    if len(found) > 1:
                        self.ambiguous.append(f"{file}: {name} is {found[0]} and {found[1]}")
                    targets.update(found[:1])
            self.includes[file] = targets

    def find_cycles(self):
        """Sets of files that include each other in a ring; a source and its header are one."""
        unit = {f: f if f.suffix == ".inl" else f.with_suffix("") for f in self.files}
        graph = {}
        for file, targets in self.includes.items():
            edges = graph.setdefault(unit[file], set())
            edges.update(unit[target] for target in targets if unit[target] != unit[file])
        return find_strong_components(graph)


def find_strong_components(graph):
    """Components of more than one node (Tarjan, without recursion)."""
    index, low, on_stack, stack, components = {}, {}, set(), [], []
    for root in graph:
        if root in index:
            continue
        work = [(root, iter(graph.get(root, ())))]
        index[root] = low[root] = len(index)
        stack.append(root)
        on_stack.add(root)
        while work:
            node, edges = work[-1]
            for target in edges:
                if target not in index:
                    index[target] = low[target] = len(index)
                    stack.append(target)
                    on_stack.add(target)
                    work.append((target, iter(graph.get(target, ()))))
                    break
                if target in on_stack:
                    low[node] = min(low[node], index[target])
            else:
                work.pop()
                if work:
                    low[work[-1][0]] = min(low[work[-1][0]], low[node])
                if low[node] == index[node]:
                    component = []
                    while True:
                        member = stack.pop()
                        on_stack.remove(member)
                        component.append(member)
                        if member == node:
                            break
                    if len(component) > 1:
                        components.append(sorted(component))
    return components


def reduce_arrows(table):
    """The table's arrows without those that a longer way implies."""

    def reach(start, skip):
        seen, todo = set(), [other for other in table[start] if other != skip]
        while todo:
            room = todo.pop()
            if room not in seen:
                seen.add(room)
                todo.extend(table[room])
        return seen

    return {(a, b) for a in table for b in table[a] if b not in reach(a, b)}


def check(tree):
    table = read_table(tree)
    faults = []
    for ring in find_strong_components({room: set(allowed) for room, allowed in table.items()}):
        faults.append(f"{ARCHITECTURE}: the table goes round in a circle: {', '.join(ring)}")
    graph = IncludeGraph(tree)
    faults += graph.ambiguous
    used = set()
    for file, targets in graph.includes.items():
        room = str(file.parent)
        if room not in table:
            faults.append(f"{file}: its room {room} has no row in {ARCHITECTURE}")
            continue
        for target in sorted(targets):
            other = str(target.parent)
            used.add((room, other))
            if other != room and other not in table[room]:
                faults.append(f"{file}: includes {target}, but {room} may not include {other}")
    for ring in graph.find_cycles():
        faults.append("files include each other: " + ", ".join(str(file) for file in ring))
    for room, allowed in table.items():
        for other in allowed:
            if (room, other) not in used:
                faults.append(f"{ARCHITECTURE}: {room} may include {other}, but does not")
    drawn = set(re.findall(r"<title>([^<]+)&#45;&gt;([^<]+)</title>", read_drawing(tree)))
    if not faults and drawn != reduce_arrows(table):
        faults.append(f"{DRAWING}: is not that of the table; layers.py --draw makes it anew")
    return faults


def read_drawing(tree):
    path = tree / DRAWING
    return path.read_text() if path.exists() else ""


def draw(tree):
    table = read_table(tree)
    print("digraph rooms {\n  rankdir=TB; ranksep=0.45; nodesep=0.12;")
    print('  node [shape=box, style="rounded,filled", fontname=Helvetica, fontsize=10,')
    print("    height=0.25, margin=0.06, color=gray40];")
    print("  edge [color=gray50, arrowsize=0.5];")
    colors = ["#d8e8f4", "#dcefd8", "#f6ead0", "#eadff0", "#f4dcd8", "#d8efec", "#e8e8e8"]
    for room in table:
        top = room.split("/")[0]
        color = colors[TOPS.index(top)] if top in TOPS else colors[-1]
        print(f'  "{room}" [fillcolor="{color}"];')
    for a, b in sorted(reduce_arrows(table)):
        print(f'  "{a}" -> "{b}";')
    print("}")


def main():
    arguments = sys.argv[1:]
    drawing = "--draw" in arguments
    places = [argument for argument in arguments if argument != "--draw"]
    default = pathlib.Path(__file__).resolve().parents[2]
    tree = pathlib.Path(places[0]) if places else default
    if drawing:
        draw(tree)
        return
    faults = check(tree)
    for fault in faults:
        print(fault)
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
