"""Figures as gnuplot draws them: within a pixel of the tables. figures_test.py PROGRAM CASE

Curves, ticks and labels are read from the SVG files. The labelled ticks of an axis give its scale,
so that every row of a table has a place in the figure: that place must lie within a pixel of the
curve, and the curve's highest and lowest points within a pixel of the largest and smallest values.
"""

import math
import re
import shutil
import sys
import unittest
import xml.etree.ElementTree as ElementTree

import browser

program_path, case_path = sys.argv[1:3]
SVG = "{http://www.w3.org/2000/svg}"
BLUE, VERMILION, GREEN, PURPLE, ORANGE = "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00"


def colour_of(text):
    """A colour as three numbers; none for others than "#0072b2" and "rgb(0, 114, 178)"."""
    if text.startswith("#"):
        return tuple(int(text[i:i + 2], 16) for i in (1, 3, 5))
    numbers = re.findall(r"\d+", text)
    return tuple(map(int, numbers)) if text.startswith("rgb") and len(numbers) == 3 else None


def lines_of(path):
    """The lines of a path, absolute (M, L) or relative (l), each a list of points."""
    lines, x, y = [], 0.0, 0.0
    for command, numbers in re.findall(r"([MLl])([-\d.,\s]*)", path):
        values = [float(n) for n in re.findall(r"-?[\d.]+", numbers)]
        if command == "M":
            lines.append([])
        for dx, dy in zip(values[::2], values[1::2]):
            x, y = (x + dx, y + dy) if command == "l" else (dx, dy)
            lines[-1].append((x, y))
    return lines


class Scale:
    """Pixels over values, from labelled ticks (value, pixel)."""

    def __init__(self, ticks):
        ticks = sorted(set(ticks))
        assert len(ticks) >= 2, f"labelled ticks: {ticks}"
        (v0, p0), (v1, p1) = ticks[0], ticks[-1]
        self.slope = (p1 - p0) / (v1 - v0)
        self.offset = p0 - self.slope * v0
        for value, pixel in ticks:
            assert abs(self(value) - pixel) < 0.6, f"ticks of several scales: {ticks}"

    def __call__(self, value):
        return self.offset + self.slope * value


class Figure:
    def __init__(self, path):
        self.curves = []  # (colour, points)
        self.ticks = {"x": [], "y": []}  # (value, x, y) of the tick's end at the axis
        self.grid = []  # (x, top, bottom) of upright grid lines: they cross a panel
        self._recent = []
        self._walk(ElementTree.parse(path).getroot(), "none", (0.0, 0.0))

    def _walk(self, element, colour, shift):
        colour = element.get("color", colour)
        moved = re.match(r"translate\(([-\d.]+),([-\d.]+)\)", element.get("transform", ""))
        if moved:
            shift = tuple(float(n) for n in moved.groups())
        if element.tag == SVG + "defs":
            return
        if element.tag == SVG + "path":
            stroke = element.get("stroke", colour)
            for points in lines_of(element.get("d", "")):
                self.curves.append((colour_of(colour if stroke == "currentColor" else stroke), points))
                self._recent = [*self._recent[-3:], points]
                if len(points) == 2 and points[0][0] == points[1][0] and abs(points[0][1] - points[1][1]) > 60:
                    self.grid.append((points[0][0], *sorted(p[1] for p in points)))
        if element.tag == SVG + "text":
            self._label("".join(element.itertext()).strip().replace("−", "-"), shift)
        for child in element:
            self._walk(child, colour, shift)

    def _label(self, text, place):
        """A number beside the tick that was drawn just before it."""
        try:
            value = float(text)
        except ValueError:
            return
        for points in reversed(self._recent):
            if len(points) != 2:
                continue
            (x, y), (x1, y1) = points
            if y == y1 and abs(x - x1) < 15 and abs(place[1] - y) < 8 and place[0] < x:
                self.ticks["y"].append((value, x, y))
                return
            if x == x1 and abs(place[0] - x) < 2 and place[1] > max(y, y1):
                self.ticks["x"].append((value, x, max(y, y1)))
                return

    def panels(self):
        """(left, right, top, bottom) of the panels, from above and from the left."""
        boxes = {}
        for x, top, bottom in self.grid:
            box = boxes.setdefault((round(top), round(bottom)), [x, x, top, bottom])
            box[0], box[1] = min(box[0], x), max(box[1], x)
        return sorted(boxes.values(), key=lambda box: box[2])

    def panel(self, index):
        return Panel(self, self.panels()[index])


class Panel:
    """A panel: scales of its axes and segments of its curves."""

    def __init__(self, figure, box):
        self.figure = figure
        self.left, self.right, self.top, self.bottom = box
        self.y = Scale([(v, y) for v, _, y in figure.ticks["y"] if self.top - 1 <= y <= self.bottom + 1])
        below = [(v, x) for v, x, y in figure.ticks["x"]]
        self.x = Scale(below)  # panels above each other share it

    def segments(self, colour):
        found = []
        for stroke, points in self.figure.curves:
            is_sample = len(points) == 2 and points[0][1] == points[1][1]  # in a legend
            if stroke != colour_of(colour) or is_sample:
                continue
            inside = [p for p in points if self.top - 2 <= p[1] <= self.bottom + 2]
            if len(inside) == len(points):
                found += list(zip(points, points[1:]))
        return found


def distance(p, a, b):
    dx, dy = b[0] - a[0], b[1] - a[1]
    squared = dx * dx + dy * dy
    share = min(1.0, max(0.0, ((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / squared)) if squared else 0.0
    return math.hypot(p[0] - a[0] - share * dx, p[1] - a[1] - share * dy)


class Extremes(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.program = browser.Program(program_path, case_path)
        cls.addClassCleanup(cls.program.remove)
        cls.program.run("strike", "output.sections=0.5", "output.shape_points=501")
        cls.program("plot", "strike")
        cls.history = cls.program.table("strike", "history.csv")

    def column(self, name, factor=1.0):
        return [factor * float(row[name]) for row in self.history]

    def figure(self, name):
        return Figure(self.program.directory / "strike" / (name + ".svg"))

    def assert_drawn(self, panel, colour, xs, ys, label):
        segments = panel.segments(colour)
        self.assertGreater(len(segments), 5, label)
        points = [(panel.x(x), panel.y(y)) for x, y in zip(xs, ys)]
        heights = [y for segment in segments for _, y in segment]
        self.assertAlmostEqual(min(heights), min(y for _, y in points), delta=1.0, msg=label + ", highest")
        self.assertAlmostEqual(max(heights), max(y for _, y in points), delta=1.0, msg=label + ", lowest")
        columns = {}
        for a, b in segments:
            for column in range(int(min(a[0], b[0])) - 2, int(max(a[0], b[0])) + 3):
                columns.setdefault(column, []).append((a, b))
        for p in points:
            near = min((distance(p, a, b) for a, b in columns.get(int(p[0]), [])), default=math.inf)
            self.assertLessEqual(near, 1.0, f"{label} at {p}")

    def test_force_and_displacements(self):
        figure = self.figure("response")
        times = self.column("time_s", 1e3)
        self.assert_drawn(figure.panel(0), BLUE, times, self.column("force_N", 1e-3), "force")
        for colour, name in ((BLUE, "w_c_m"), (VERMILION, "w_m_m"), (GREEN, "f_c_m")):
            self.assert_drawn(figure.panel(1), colour, times, self.column(name, 1e3), name)

    def test_energies(self):
        panel = self.figure("energies").panel(0)
        times = self.column("time_s", 1e3)
        for colour, name in ((BLUE, "U_m_J"), (VERMILION, "U_k_J"), (GREEN, "U_e_J"), (PURPLE, "U_p_J"),
                             (ORANGE, "D_c_J")):
            self.assert_drawn(panel, colour, times, self.column(name), name)

    def test_the_first_sub_impact(self):
        end = 1.05 * float(self.program.table("strike", "events.csv")[0]["end_s"])
        rows = [row for row in self.history if float(row["time_s"]) <= end]
        figure = self.figure("first-sub-impact")
        times = [1e6 * float(row["time_s"]) for row in rows]
        self.assert_drawn(figure.panel(0), BLUE, times, [1e-3 * float(row["force_N"]) for row in rows], "force")

    def test_the_envelope(self):
        rows = self.program.table("strike", "envelope.csv")
        positions = [float(row["position_m"]) for row in rows]
        figure = self.figure("envelope")
        for panel, colour, name, factor in ((0, BLUE, "max_moment_Nm", 1.0), (0, VERMILION, "min_moment_Nm", 1.0),
                                            (2, GREEN, "permanent_set_m", 1e3)):
            self.assert_drawn(figure.panel(panel), colour, positions,
                              [factor * float(row[name]) for row in rows], name)

    def test_bending_with_its_retraced_lines(self):
        rows = self.program.table("strike", "sections.csv")
        yield_moment = 150e6 * 0.0163 * 0.0075**2 / 6
        yield_curvature = 2 * 150e6 / (71.96e9 * 0.0075)
        self.assert_drawn(self.figure("bending").panel(0), BLUE,
                          [float(row["curvature_per_m"]) / yield_curvature for row in rows],
                          [float(row["moment_Nm"]) / yield_moment for row in rows], "bending")


if __name__ == "__main__":
    if shutil.which("gnuplot") is None:
        print("skipped: missing gnuplot (Debian: gnuplot-nox)")
        sys.exit(browser.skipped)
    unittest.main(argv=sys.argv[:1], verbosity=2)
