"""Figures as gnuplot draws them: within a pixel of the tables. figures_test.py PROGRAM CASE

Curves, ticks and labels are read from the SVG files. The labelled ticks of an axis give its scale,
so that every row of a table has a place in the figure: that place must lie within a pixel of the
curve, and the curve's highest and lowest points within a pixel of the largest and smallest values.
"""

import math
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
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

    def __init__(self, ticks, is_log=False):
        self.forth = math.log10 if is_log else float
        ticks = sorted({(self.forth(value), pixel) for value, pixel in ticks})
        assert len(ticks) >= 2, f"labelled ticks: {ticks}"
        (v0, p0), (v1, p1) = ticks[0], ticks[-1]
        self.slope = (p1 - p0) / (v1 - v0)
        self.offset = p0 - self.slope * v0
        for value, pixel in ticks:
            assert abs(self.offset + self.slope * value - pixel) < 0.6, f"ticks of several scales: {ticks}"

    def __call__(self, value):
        return self.offset + self.slope * self.forth(value)


class Figure:
    def __init__(self, path):
        self.curves = []  # (colour, points)
        self.ticks = {"x": [], "y": []}  # (value, x, y) of the tick's end at the axis
        self.boxes = set()  # (left, right, top, bottom) of panels, from their borders
        self.texts = []  # (text, left, right, top, bottom), roughly
        self._recent = []
        self._anchor, self._size, self._is_upright = "start", 14.0, False
        self._walk(ElementTree.parse(path).getroot(), "none", (0.0, 0.0))

    def _walk(self, element, colour, shift):
        colour = element.get("color", colour)
        self._anchor = element.get("text-anchor", self._anchor)
        self._size = float(element.get("font-size", self._size))
        self._is_upright = "rotate(" in element.get("transform", "") or (self._is_upright and element.tag == SVG + "text")
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
                if len(points) == 3 and points[0][0] == points[1][0] and points[1][1] == points[2][1]:
                    self.boxes.add((points[0][0], points[2][0], points[0][1], points[1][1]))
        if element.tag == SVG + "text":
            text = "".join(element.itertext()).strip()
            self._label(text.replace("−", "-"), shift, len(element.findall(SVG + "tspan")) > 1)
            self._place(text, element, shift)
        for child in element:
            self._walk(child, colour, shift)

    def _place(self, text, element, place):
        size = self._size
        width = 0.52 * size * len(text)
        left = place[0] - {"middle": 0.5, "end": 1.0}.get(self._anchor, 0.0) * width
        if text and not self._is_upright:
            self.texts.append((text, left, left + width, place[1] - 0.75 * size, place[1] + 0.2 * size))

    def _label(self, text, place, is_power):
        """A number beside the tick that was drawn just before it."""
        power = re.fullmatch(r"10\s*(-?\d+)", text) if is_power else None
        try:
            value = 10.0 ** int(power[1]) if power else float(text)
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
        return sorted(self.boxes, key=lambda box: (box[2], box[0]))

    def panel(self, index, **options):
        return Panel(self, self.panels()[index], **options)


class Panel:
    """A panel: scales of its axes and segments of its curves."""

    def __init__(self, figure, box, is_log=False):
        """`is_log`: whether the upright axis is logarithmic."""
        self.figure = figure
        self.left, self.right, self.top, self.bottom = box
        beside = [(v, x, y) for v, x, y in figure.ticks["y"] if self.top - 1 <= y <= self.bottom + 1]
        nearest = max((x for _, x, _ in beside if x <= self.left + 16), default=0)
        self.y = Scale([(v, y) for v, x, y in beside if abs(x - nearest) < 3], is_log)
        # The labels below this panel, or below those under it, which share its scale.
        below = [(v, x, y) for v, x, y in figure.ticks["x"]
                 if self.left - 2 <= x <= self.right + 2 and y >= self.bottom - 12]
        lowest = min((y for _, _, y in below), default=0)
        self.x = Scale([(v, x) for v, x, y in below if abs(y - lowest) < 3])

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
        return Figure(self.program.directory / "strike" / "figures" / (name + ".svg"))

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
        below = self.figure("energies").panel(1)
        for colour, name in ((BLUE, "f_c_m"), (VERMILION, "u_mf_m")):
            self.assert_drawn(below, colour, times, self.column(name, 1e3), name)

    def test_the_first_sub_impact(self):
        end = 1.05 * float(self.program.table("strike", "events.csv")[0]["end_s"])
        rows = [row for row in self.history if float(row["time_s"]) <= end]
        figure = self.figure("first-sub-impact")
        times = [1e6 * float(row["time_s"]) for row in rows]
        self.assert_drawn(figure.panel(0), BLUE, times, [1e-3 * float(row["force_N"]) for row in rows], "force")
        self.assert_drawn(figure.panel(1), VERMILION, times, [1e-6 * float(row["stress_back_Pa"]) for row in rows],
                          "stress")

    def test_force_against_indentation(self):
        hits = self.program.table("strike", "events.csv")
        figure = self.figure("indentation")
        panel = figure.panel(0)

        def rows_between(start, end):
            rows = [row for row in self.history if start <= float(row["time_s"]) <= end]
            return ([1e3 * float(row["indentation_m"]) for row in rows], [1e-3 * float(row["force_N"]) for row in rows])

        largest = max(self.column("indentation_m", 1e3))
        first = rows_between(0.0, float(hits[0]["end_s"]))
        self.assert_drawn(panel, BLUE, *first, "first sub-impact")
        xs, ys = rows_between(float(hits[1]["start_s"]), 1.0)
        shown = [(x, y) for x, y in zip(xs, ys) if 0 <= x <= 1.06 * largest]
        self.assert_drawn(panel, "#A0A0A0", *zip(*shown), "later sub-impacts")
        peak = max(range(len(first[0])), key=lambda i: first[0][i])
        rightmost = max(x for a, b in panel.segments(BLUE) for x in (a[0], b[0]))
        self.assertAlmostEqual(rightmost, panel.x(first[0][peak]), delta=1.0)
        yielding = [i for i in range(1, len(hits))
                    if float(hits[i]["residual_indentation_m"]) > float(hits[i - 1]["residual_indentation_m"])]
        insets = figure.panels()[1:]
        self.assertEqual(len(insets), min(3, len(yielding)))
        for box, colour, i in zip(insets, (VERMILION, GREEN, PURPLE), yielding):
            inset = Panel(figure, box)
            xs, ys = rows_between(float(hits[i]["start_s"]), float(hits[i]["end_s"]))
            self.assert_drawn(inset, colour, xs, ys, f"sub-impact {i + 1}")

    def test_the_timeline_with_its_bars(self):
        hits = self.program.table("strike", "events.csv")
        figure = self.figure("timeline")
        zones = {}
        for hit in hits:
            start, end = float(hit["start_s"]), float(hit["end_s"] or hits[-1]["start_s"])
            zones[hit["zone"]] = (zones.get(hit["zone"], (start, 0.0))[0], end)
        # Columns as wide as the zones last, at least 0.15 of all, between 0.11 and 0.98 of the width.
        total = sum(end - start for start, end in zones.values())
        shares = [max((end - start) / total, 0.15) for start, end in zones.values()]
        per_share = (0.98 - 0.11 - 0.03 * (len(shares) - 1)) / sum(shares)
        columns, left = [], 0.11
        for (start, end), share in zip(zones.values(), shares):
            margin = 0.022 * (end - start) / (per_share * share)
            columns.append((1e3 * (start - margin), 1e3 * (end + margin), left, left + per_share * share))
            left += per_share * share + 0.03
        self.assertGreaterEqual(len(columns), 2)  # zones
        n = len(columns)
        self.assertEqual(len(figure.panels()), 2 * n)
        upper, lower = figure.panel(0, is_log=True), figure.panel(n, is_log=True)
        stems = {name: [(points[0][0], *sorted(y for _, y in points)) for colour, points in figure.curves
                        if colour in [colour_of(c) for c in colours] and len(points) == 2 and points[0][0] == points[1][0]]
                 for name, colours in {"duration": ("#0072B2", "#8CBEDF"), "impulse": ("#D55E00", "#EFB58C"),
                                       "error": ("#000000",)}.items()}
        n_bars = 0
        for hit in hits:
            start = 1e3 * float(hit["start_s"])
            left, right = next(column for column in columns if column[0] <= start <= column[1])[2:]
            x = Scale([(value, at) for value, at, y in figure.ticks["x"] if 800 * left - 2 <= at <= 800 * right + 2])(start)

            def assert_stem(name, panel, value, at=x, number=hit["index"]):
                near = min(stems[name], key=lambda stem: abs(stem[0] - at) + abs(stem[1] - panel.y(value)))
                self.assertAlmostEqual(near[0], at, delta=1.0, msg=f"{name} {number}")
                self.assertAlmostEqual(near[1], panel.y(value), delta=1.0, msg=f"{name} {number}")
                self.assertAlmostEqual(near[2], panel.bottom, delta=1.0, msg=f"{name} {number}")

            if hit["end_s"]:
                assert_stem("duration", upper, 1e6 * (float(hit["end_s"]) - float(hit["start_s"])))
            assert_stem("impulse", lower, 1e3 * float(hit["impulse_Ns"]))
            error = 1e6 * float(hit["start_error_s"] or 0)
            if error > 0 and upper.y(error) < upper.bottom - 2:
                assert_stem("error", upper, error)
                n_bars += 1
        self.assertGreaterEqual(n_bars, 5)

    def test_shapes(self):
        shapes = {}
        for row in self.program.table("strike", "shapes.csv"):
            shapes.setdefault(float(row["time_s"]), []).append(row)
        times = sorted(shapes)
        figure = self.figure("shapes")
        colours = ["#440154", "#46327E", "#365C8D", "#277F8E", "#1FA187", "#4AC16D", "#9FDA3A"]
        for k, colour in enumerate(colours, start=1):
            rows = shapes[min(times, key=lambda time: (abs(time - times[-1] * k / 7), -time))]
            xs = [float(row["position_m"]) for row in rows]
            self.assert_drawn(figure.panel(0), colour, xs, [1e3 * float(row["displacement_m"]) for row in rows],
                              f"shape {k}")
            self.assert_drawn(figure.panel(1), colour, xs, [float(row["moment_Nm"]) for row in rows], f"moment {k}")

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

    def test_legends_cover_no_data(self):
        for name in ("response", "first-sub-impact", "indentation", "energies", "shapes", "envelope"):
            figure = self.figure(name)
            legends = []  # words with a sample of their line beside them, at the same height
            for text, left, right, top, bottom in figure.texts:
                for _, points in figure.curves:
                    flat = len(points) == 2 and points[0][1] == points[1][1] and abs(points[0][0] - points[1][0]) < 60
                    beside = min(abs(x - edge) for x, _ in points for edge in (left, right)) < 30
                    if flat and beside and top - 2 < points[0][1] < bottom + 2 and points[0][0] > left - 60:
                        legends.append((text, left, right, top, bottom))
            ticks = {f"{value:g}" for axis in figure.ticks.values() for value, *_ in axis}
            for text, left, right, top, bottom in legends:
                if text.replace("−", "-") in ticks:
                    continue
                for colour, points in figure.curves:
                    if colour is None or len(points) < 4:
                        continue
                    for x, y in points:
                        self.assertFalse(left < x < right and top < y < bottom, f"{name}: {text} covers {(x, y)}")

    def test_signs_are_as_in_print(self):
        for path in sorted((self.program.directory / "strike" / "figures").glob("*.svg")):
            for text, *_ in Figure(path).texts:
                self.assertNotRegex(text, r"(^|[ ,(])-\d|\bus\b|\bum\b", path.name)


# The tables of studies, with values in a narrow range, for which few ticks are at hand.
STUDIES = {
    "critical_steps": ({"critical_steps.csv": "method,theory,segments,predicted_s,measured_s\n"
                        + "".join(f"{m},{t},{n},{s}e-6,{s}e-6\n" for m in ("erk", "nystrom")
                                  for t in ("rayleigh", "euler-bernoulli") for n, s in ((101, 1.31), (201, 1.29)))}, ""),
    "stiff_contact": ({"stiff_contact.csv": "stiffness_N_per_m,beam_only_s,predicted_s,measured_s\n"
                       "2.1e6,1.3e-6,1.2e-6,1.21e-6\n3.2e6,1.3e-6,1.1e-6,1.12e-6\n"}, ""),
    "damping": ({"damping.csv": "method,omega_h,predicted,measured\nark:a,0.5,0.9,0.9\nark:a,2,0.5,0.5\n",
                 "bdf_growth.csv": "order,omega_h,growth\n1,0.5,0.9\n1,2,0.8\n"}, ""),
    "missed_pairs": ({"missed_pairs.csv": "step_s,runs,right_with_search,right_without,shortest_s\n"
                      "2e-7,10,10,9,2.5e-7\n3e-7,10,10,7,2.5e-7\n"}, ""),
    "layers": ({"layers.csv": "layers,sub_impacts,exact_sub_impacts,corresponding,median_difference_s,max_difference_s\n"
                "20,9,9,9,2.1e-7,2.6e-7\n40,9,9,9,1.9e-7,2.2e-7\n"}, ""),
    "work_precision": ({}, "labels = \"'elastic'\"\ncost_label = 'wall time (ms)'\nwidth = 770\n$points << EOD\n"
                       "panel,method,mark,error_us,cost\n1,erk,right,0.21,2.2\n1,erk,right,0.26,2.1\nEOD\n"),
}


class LogarithmicAxes(unittest.TestCase):
    def test_of_studies_have_two_labelled_ticks_at_least(self):
        sources = pathlib.Path(__file__).parents[2] / "src" / "report" / "figures"
        for name, (tables, settings) in STUDIES.items():
            with self.subTest(name), tempfile.TemporaryDirectory() as place:
                directory = pathlib.Path(place)
                for file, text in tables.items():
                    (directory / file).write_text(text)
                script = "".join((sources / f"{part}.gp").read_text(encoding="utf-8") for part in ("style", "tables"))
                (directory / "script.gp").write_text(
                    script + settings + (sources / f"{name}.gp").read_text(encoding="utf-8"), encoding="utf-8")
                done = subprocess.run(["gnuplot", "-e", "set terminal svg size 800,500 enhanced; set encoding utf8", "script.gp"],
                                      cwd=directory, capture_output=True, text=True, check=False)
                self.assertEqual(done.returncode, 0, done.stderr)
                (directory / "figure.svg").write_text(done.stdout, encoding="utf-8")
                figure = Figure(directory / "figure.svg")
                self.assertGreaterEqual(len({value for value, *_ in figure.ticks["x"]}), 2, "along x")
                self.assertGreaterEqual(len({value for value, *_ in figure.ticks["y"]}), 2, "along y")
                for text, *_ in figure.texts:
                    self.assertNotRegex(text, r"(^|[ ,(])-\d|\bus\b|\bum\b", name)


if __name__ == "__main__":
    if shutil.which("gnuplot") is None:
        print("skipped: missing gnuplot (Debian: gnuplot-nox)")
        sys.exit(browser.skipped)
    unittest.main(argv=sys.argv[:1], verbosity=2)
