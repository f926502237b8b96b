# SPDX-License-Identifier: BSD-3-Clause
"""Line charts as SVG, for benchmarks."""

import math
from xml.etree import ElementTree

# Colours that people who see colours differently tell apart as far as possible (Okabe and Ito), as
# the page of `tetralux bench` has them.
BLACK, BLUE, RED, GREEN = "#000000", "#0072b2", "#d55e00", "#009e73"
INK, SOFT, GRID = "#1f2328", "#57606a", "#e4e7eb"

FONT = 13  # pixels, as all lengths here
TITLE_FONT = 16
MARK = 3  # radius of a point
PANEL_WIDTH, PANEL_HEIGHT = 250, 170
GAP = 34  # between panels, for the title above each
MARGIN_LEFT, MARGIN_RIGHT, MARGIN_TOP, MARGIN_BOTTOM = 88, 64, 76, 60


class Axis:
    """Places of values from low to high, 0 to 1, and round values between them.

    base: 0 for equal steps, else that of a logarithm.
    """

    def __init__(self, title, low, high, base=0, color=INK):
        self.title, self.color, self.base = title, color, base
        if base:
            self.low = base ** math.floor(math.log(low, base) + 1e-9)
            self.high = base ** math.ceil(math.log(high, base) - 1e-9)
        else:
            step = self._find_step(low, high)
            self.low, self.high = step * math.floor(low / step), step * math.ceil(high / step)

    @staticmethod
    def _find_step(low, high):
        """1, 2 or 5 times a power of ten, some four of them from low to high."""
        rough = (high - low) / 4
        power = 10 ** math.floor(math.log10(rough))
        return power * next(factor for factor in (1, 2, 5, 10) if factor * power >= rough)

    def place(self, value):
        if self.base:
            return math.log(value / self.low) / math.log(self.high / self.low)
        return (value - self.low) / (self.high - self.low)

    def list_ticks(self):
        if self.base:
            count = round(math.log(self.high / self.low, self.base))
            return [self.low * self.base**k for k in range(count + 1)]
        step = self._find_step(self.low, self.high)
        return [self.low + step * k for k in range(round((self.high - self.low) / step) + 1)]


class Panel:
    """Lines over a common x axis; y axes on the left, and perhaps on the right."""

    def __init__(self, title, x, left, right=None):
        self.title, self.x, self.left, self.right = title, x, left, right
        self.lines = []

    def add_line(self, points, color, dashed=False, right=False):
        self.lines.append((points, color, dashed, self.right if right else self.left))


class Drawing:
    """The elements of an SVG."""

    def __init__(self, width, height):
        self.root = ElementTree.Element(
            "svg",
            {
                "xmlns": "http://www.w3.org/2000/svg",
                "viewBox": f"0 0 {width} {height}",
                "role": "img",
                "font-family": "system-ui, sans-serif",
                "font-size": str(FONT),
                "fill": INK,
            },
        )
        self.add("rect", width=width, height=height, fill="#fff")

    def add(self, tag, text=None, **attributes):
        names = {name.replace("_", "-"): str(value) for name, value in attributes.items()}
        element = ElementTree.SubElement(self.root, tag, names)
        element.text = text

    def write_text(self, x, y, text, anchor="middle", **more):
        self.add("text", text, x=round(x, 1), y=round(y, 1), text_anchor=anchor, **more)

    def write_upwards(self, x, y, text, color):
        self.add(
            "text", text, text_anchor="middle", fill=color,
            transform=f"translate({x},{y}) rotate(-90)",
        )

    def draw_line(self, x1, y1, x2, y2, stroke):
        self.add(
            "line", x1=round(x1, 1), y1=round(y1, 1), x2=round(x2, 1), y2=round(y2, 1),
            stroke=stroke,
        )

    def draw_points(self, points, color, dashed):
        text = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
        dash = {"stroke_dasharray": "5 4"} if dashed else {}
        self.add("polyline", points=text, fill="none", stroke=color, stroke_width=1.8, **dash)
        for x, y in points:
            self.add("circle", cx=round(x, 1), cy=round(y, 1), r=MARK, fill=color)

    def write(self, path):
        ElementTree.indent(self.root, "")
        ElementTree.ElementTree(self.root).write(path, encoding="unicode")


def format_tick(value):
    return f"{value:,.10g}"


def draw_panel(drawing, panel, left, top, width, edges):
    """edges: whether the panel's left axis and its x axis are the outer ones, which have names."""
    right, bottom = left + width, top + PANEL_HEIGHT
    has_left, has_bottom = edges
    for tick in panel.x.list_ticks():
        x = left + width * panel.x.place(tick)
        drawing.draw_line(x, top, x, bottom, GRID)
        if has_bottom:
            drawing.write_text(x, bottom + FONT + 5, format_tick(tick))
    for tick in panel.left.list_ticks():
        y = bottom - PANEL_HEIGHT * panel.left.place(tick)
        drawing.draw_line(left, y, right, y, GRID)
        if has_left:
            drawing.write_text(
                left - 8, y + 0.35 * FONT, format_tick(tick), "end", fill=panel.left.color
            )
    if panel.right:
        for tick in panel.right.list_ticks():
            y = bottom - PANEL_HEIGHT * panel.right.place(tick)
            drawing.write_text(
                right + 8, y + 0.35 * FONT, format_tick(tick), "start", fill=panel.right.color
            )
        drawing.write_upwards(
            right + 0.8 * MARGIN_RIGHT, top + PANEL_HEIGHT / 2, panel.right.title,
            panel.right.color,
        )
    drawing.draw_line(left, bottom, right, bottom, SOFT)
    drawing.draw_line(left, top, left, bottom, SOFT)
    drawing.write_text(left, top - 8, panel.title, "start")
    for points, color, dashed, axis in panel.lines:
        places = [
            (left + width * panel.x.place(x), bottom - PANEL_HEIGHT * axis.place(y))
            for x, y in points
        ]
        drawing.draw_points(places, color, dashed)


def draw_legend(drawing, legend, x, y):
    """legend: name, colour, whether dashed."""
    letter = 0.56 * FONT  # mean width
    for name, color, dashed in legend:
        dash = {"stroke_dasharray": "5 4"} if dashed else {}
        drawing.add(
            "line", x1=x, y1=y - 4, x2=x + 22, y2=y - 4, stroke=color, stroke_width=1.8, **dash
        )
        drawing.write_text(x + 28, y, name, "start")
        x += 28 + letter * len(name) + 24


def write_chart(path, title, rows, legend, panel_width=PANEL_WIDTH):
    """rows: of panels, none longer than the first one."""
    width = MARGIN_LEFT + len(rows[0]) * (panel_width + GAP) - GAP + MARGIN_RIGHT
    height = MARGIN_TOP + len(rows) * (PANEL_HEIGHT + GAP) - GAP + MARGIN_BOTTOM
    drawing = Drawing(width, height)
    drawing.write_text(MARGIN_LEFT, 24, title, "start", font_size=TITLE_FONT, font_weight=600)
    draw_legend(drawing, legend, MARGIN_LEFT, 46)
    for r, panels in enumerate(rows):
        for c, panel in enumerate(panels):
            left = MARGIN_LEFT + c * (panel_width + GAP)
            top = MARGIN_TOP + r * (PANEL_HEIGHT + GAP)
            is_last = all(len(below) <= c for below in rows[r + 1 :])
            draw_panel(drawing, panel, left, top, panel_width, (c == 0, is_last))
    x_title, y_axis = rows[0][0].x.title, rows[0][0].left
    drawing.write_text((MARGIN_LEFT + width - MARGIN_RIGHT) / 2, height - 14, x_title)
    middle = (MARGIN_TOP + height - MARGIN_BOTTOM) / 2
    drawing.write_upwards(20, middle, y_axis.title, y_axis.color)
    drawing.write(path)
