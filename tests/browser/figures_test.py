"""Figures as gnuplot draws them: extremes within a pixel. figures_test.py PROGRAM CASE

The curves and ticks are read from the SVG files. Two labelled ticks of an axis give its scale, so
that pixels and values of the tables can be compared.
"""

import re
import shutil
import sys
import unittest
import xml.etree.ElementTree as ElementTree

import browser

program_path, case_path = sys.argv[1:3]
SVG = "{http://www.w3.org/2000/svg}"


class Figure:
    """Curves (lists of points, by colour) and labelled ticks of a figure."""

    def __init__(self, path):
        self.curves = []  # (colour, [(x, y), ...])
        self.labels = []  # (value, x, y) of numbers
        self._walk(ElementTree.parse(path).getroot(), "none", (0.0, 0.0))

    def _walk(self, element, colour, shift):
        colour = element.get("color", element.get("stroke", colour)) if element.tag == SVG + "g" else colour
        moved = re.match(r"translate\(([-\d.]+),([-\d.]+)\)", element.get("transform", ""))
        if moved:
            shift = tuple(a + float(b) for a, b in zip(shift, moved.groups()))
        if element.tag == SVG + "path":
            stroke = element.get("stroke", colour)
            self.curves.append((stroke if stroke != "currentColor" else colour, points_of(element.get("d", ""))))
        if element.tag == SVG + "text":
            text = "".join(element.itertext()).strip().replace("−", "-")
            try:
                self.labels.append((float(text), *shift))
            except ValueError:
                pass
        for child in element:
            self._walk(child, colour, shift)


def points_of(path):
    """Points of a path of absolute and relative lines, as gnuplot writes it."""
    points, x, y = [], 0.0, 0.0
    for command, numbers in re.findall(r"([MLHVlhv])\s*([-\d.,\s]*)", path):
        values = [float(n) for n in re.findall(r"-?\d+\.?\d*", numbers)]
        for i in range(0, len(values) - 1, 2):
            dx, dy = values[i], values[i + 1]
            x, y = (x + dx, y + dy) if command == "l" else (dx, dy)
            points.append((x, y))
    return points


def scale(pairs):
    """Slope and offset of pixels over values, from labelled ticks; also checks that they agree."""
    pairs = sorted(set(pairs))
    (v0, p0), (v1, p1) = pairs[0], pairs[-1]
    slope = (p1 - p0) / (v1 - v0)
    for value, pixel in pairs:
        assert abs(p0 + slope * (value - v0) - pixel) < 0.6, "ticks are not on one scale"
    return slope, p0 - slope * v0


class Extremes(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.program = browser.Program(program_path, case_path)
        cls.addClassCleanup(cls.program.remove)
        cls.program.run("strike", "output.sections=0.5", "output.shapes=2e-5")
        cls.program("plot", "strike")
        cls.history = cls.program.table("strike", "history.csv")

    def column(self, name, factor=1.0):
        return [factor * float(row[name]) for row in self.history]

    def figure(self, name):
        return Figure(self.program.directory / "strike" / (name + ".svg"))

    def panel(self, figure, colour, index=0):
        """The longest curve of a colour in the index-th panel from above, with its scale."""
        curves = [points for stroke, points in figure.curves if same(stroke, colour) and len(points) > 20]
        self.assertTrue(curves, f"no curve of colour {colour}")
        curves.sort(key=lambda points: min(y for _, y in points))
        return curves[index]

    def assert_extremes(self, figure, curve, values, bottom, top):
        """Highest and lowest pixel of a curve are those of the largest and smallest value; the
        scale is that of the labels at the left between the heights bottom and top."""
        left = min(x for _, x, _ in figure.labels)
        ticks = [(value, y) for value, x, y in figure.labels if x < left + 40 and top - 9 <= y <= bottom + 9]
        self.assertGreaterEqual(len(ticks), 2, "labelled ticks")
        slope, offset = scale(ticks)
        label = ticks[0][1] - (slope * ticks[0][0] + offset)
        self.assertAlmostEqual(label, 0.0, delta=1.0)
        height = [y for _, y in curve]
        baseline = 3.9  # labels stand this far below their tick, in pixels
        for value, pixel in ((max(values), min(height)), (min(values), max(height))):
            self.assertAlmostEqual(slope * value + offset - baseline, pixel, delta=1.0)

    def test_force(self):
        figure = self.figure("response")
        curve = self.panel(figure, "#0072B2")
        values = self.column("force_N", 1e-3)
        self.assert_extremes(figure, curve, values, max(y for _, y in curve), min(y for _, y in curve))


def same(stroke, colour):
    if stroke.startswith("rgb"):
        return [int(n) for n in re.findall(r"\d+", stroke)] == [int(colour[i:i + 2], 16) for i in (1, 3, 5)]
    return stroke.lower() == colour.lower()


if __name__ == "__main__":
    if shutil.which("gnuplot") is None:
        print("skipped: missing gnuplot")
        sys.exit(browser.skipped)
    unittest.main(argv=sys.argv[:1], verbosity=2)
