"""The pages of `subimpact report` as a reader meets them: pages_test.py PROGRAM CASE [CLASS]..."""

import re
import sys
import time
import unittest

import browser

program_path, case_path = sys.argv[1:3]

KEYS = {"space": "\ue00d", "left": "\ue012", "right": "\ue014", "home": "\ue011", "end": "\ue010",
        "escape": "\ue00c", "enter": "\ue007", "up": "\ue013"}

# A copy of a canvas, to read pixels from.
COPY = """
const copied = (canvas) => {
  const copy = document.createElement('canvas');
  Object.assign(copy, {width: canvas.width, height: canvas.height});
  const draw = copy.getContext('2d', {willReadFrequently: true});
  draw.drawImage(canvas, 0, 0);
  return draw;
};
"""

# The number of pixels of a canvas whose colour is within 40 of the given one.
COUNT = COPY + """
const [canvas, name] = arguments;
const text = getComputedStyle(document.documentElement).getPropertyValue('--' + name).trim();
const wanted = [1, 3, 5].map((i) => parseInt(text.slice(i, i + 2), 16));
const {data} = copied(canvas).getImageData(0, 0, canvas.width, canvas.height);
let count = 0;
for (let i = 0; i < data.length; i += 4) {
  if (data[i + 3] > 128 && wanted.every((value, k) => Math.abs(data[i + k] - value) < 40)) ++count;
}
return count;
"""

# WCAG's ratio of luminances of two CSS variables.
CONTRAST = """
const luminance = (name) => {
  const text = getComputedStyle(document.documentElement).getPropertyValue('--' + name).trim();
  const [r, g, b] = [1, 3, 5].map((i) => parseInt(text.slice(i, i + 2), 16) / 255)
    .map((c) => c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4);
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;
};
const [a, b] = [luminance(arguments[0]), luminance(arguments[1])].sort((x, y) => y - x);
return (a + 0.05) / (b + 0.05);
"""

# Elements of the page without a name for those who do not see them.
NAMELESS = """
return [...document.querySelectorAll('button, input, select, canvas, .plot, figure')]
  .filter((e) => !(e.getAttribute('aria-label') || e.textContent.trim() || e.closest('label')?.textContent.trim()
                   || e.closest('.plot')?.getAttribute('aria-label')))
  .map((e) => e.outerHTML.slice(0, 120));
"""


class PageTest(unittest.TestCase):
    maxDiff = 2000
    page = None  # file of the page, which make() writes

    @classmethod
    def setUpClass(cls):
        cls.program = browser.Program(program_path, case_path)
        cls.addClassCleanup(cls.program.remove)
        cls.page = cls.make()
        cls.driver = browser.start()
        cls.addClassCleanup(cls.driver.quit)

    def setUp(self):
        self.driver.set_window_size(1280, 1000)
        browser.open_page(self.driver, self.page)
        self.frame()

    def tearDown(self):
        problems = [entry for entry in self.driver.get_log("browser")
                    if entry["level"] in ("SEVERE", "WARNING")]
        self.assertEqual(problems, [])

    def js(self, script, *arguments):
        return self.driver.execute_script(script, *arguments)

    def frame(self):
        """Waits until what was changed is drawn."""
        self.driver.execute_async_script(
            "const done = arguments[0]; requestAnimationFrame(() => requestAnimationFrame(() => done()))")

    def find(self, css):
        return self.driver.find_element("css selector", css)

    def press(self, *keys):
        from selenium.webdriver.common.action_chains import ActionChains
        ActionChains(self.driver).send_keys("".join(KEYS.get(key, key) for key in keys)).perform()
        self.frame()

    def drag(self, element, from_share, to_share):
        """Across an element, from and to shares of its width, at half its height."""
        from selenium.webdriver.common.action_chains import ActionChains
        self.js("arguments[0].scrollIntoView({block: 'center'})", element)
        width = element.size["width"]
        (ActionChains(self.driver).move_to_element_with_offset(element, int((from_share - 0.5) * width), 0)
         .click_and_hold().move_by_offset(int((to_share - from_share) * width), 0).release().perform())
        self.frame()

    def view(self):
        return self.js("const {time, from, to, end} = page.view; return {time, from, to, end}")

    def windows(self):
        return self.js("return page.charts.map((c) => c.chart.xAxisRange().map((x) => x / c.unit.per_second))")

    def assert_windows_are(self, start, end):
        for window in self.windows():
            for value, expected in zip(window, (start, end)):
                self.assertAlmostEqual(value, expected, delta=1e-9 * max(abs(end), 1e-6) + 1e-12)

    def assert_fits(self, width):
        self.driver.set_window_size(width, 900)
        self.frame()
        self.assertLessEqual(self.js("return document.documentElement.scrollWidth"),
                             self.js("return innerWidth") + 1, f"at a width of {width}")


class ReportPage(PageTest):
    """The published strike."""

    @classmethod
    def make(cls):
        directory = cls.program.run("strike")
        cls.program("report", "strike")
        return directory / "report.html"

    def test_nothing_is_fetched_and_it_paints_within_a_second(self):
        self.assertEqual(self.js("return performance.getEntriesByType('resource').map((e) => e.name)"), [])
        paint = self.js("return performance.getEntriesByType('paint').map((e) => e.startTime)")
        size = self.page.stat().st_size
        print(f"first paint after {paint[0]:.0f} ms; {size / 1e6:.2f} MB")
        self.assertLess(paint[0], 1000)
        self.assertLess(size, 5e6)

    def test_every_panel_is_drawn(self):
        self.js("page.view.setTime(page.view.end)")
        self.frame()
        self.assertGreater(self.js(COUNT, self.find("#shape"), "plastic"), 30)
        self.js("page.view.setTime(page.strike.sub_impacts[0].end / 2)")
        self.frame()
        for selector, tones in {"#shape": ["beam", "striker"], "#moment": ["line1", "band"],
                                "#loop": ["line1", "line2"], "#timeline": ["line1", "line2"],
                                "#envelope": ["line1", "line2"], "#envelope-moment": ["line1", "line2", "band"],
                                "#set": ["line1", "band"]}.items():
            for tone in tones:
                count = self.js(COUNT, self.find(selector), tone)
                self.assertGreater(count, 60, f"{tone} in {selector}")
        for chart, lines in {"#chart-force": 1, "#chart-displacement": 3, "#chart-energy": 5}.items():
            canvas = self.js("return document.querySelector(arguments[0] + ' .plot canvas')", chart)
            for line in range(1, lines + 1):
                self.assertGreater(self.js(COUNT, canvas, f"line{line}"), 100, f"line {line} in {chart}")

    def test_dragging_across_a_chart_zooms_all_of_them(self):
        before = self.view()
        self.drag(self.find("#chart-force .plot"), 0.3, 0.6)
        after = self.view()
        self.assertLess(after["to"] - after["from"], 0.5 * (before["to"] - before["from"]))
        self.assert_windows_are(after["from"], after["to"])
        self.js("document.getElementById('all').click()")
        self.frame()
        self.assert_windows_are(0, before["end"])

    def test_a_click_on_a_sub_impact_brings_all_panels_there(self):
        third = self.program.table("strike", "events.csv")[2]
        start, end = float(third["start_s"]), float(third["end_s"])
        self.js("document.querySelectorAll('[data-hit]')[2].querySelector('button').click()")
        self.frame()
        view = self.view()
        self.assertAlmostEqual(view["time"], start, delta=1e-15)
        self.assertLess(view["from"], start)
        self.assertGreater(view["to"], end)
        self.assertLess(view["to"] - view["from"], 2 * (end - start))
        self.assert_windows_are(view["from"], view["to"])
        self.assertIn("in sub-impact 3", self.find("#readout").text)
        self.assertIn("chosen", self.js("return document.querySelectorAll('[data-hit]')[2].className"))
        low, high = self.js("return page.loop.axes.x.range")
        self.assertLess(high, 1.1e3 * float(third["max_indentation_m"]))
        self.assertLess(self.js("return page.timeline.axes.x.range[1]"), 1.2e6 * end)

    def test_it_plays_pauses_and_steps_to_events(self):
        speed = self.js("return page.player.speed")
        self.js("document.getElementById('play').click()")
        time.sleep(0.5)
        first = self.js("return [page.view.time, performance.now(), page.player.frames]")
        time.sleep(1.5)
        second = self.js("return [page.view.time, performance.now(), page.player.frames]")
        self.js("document.getElementById('play').click()")
        seconds = (second[1] - first[1]) / 1e3
        print(f"{(second[2] - first[2]) / seconds:.1f} frames per second")
        self.assertAlmostEqual((second[0] - first[0]) / (speed * seconds), 1.0, delta=0.2)
        paused = self.view()["time"]
        self.frame()
        self.assertEqual(self.view()["time"], paused)
        cost = self.js("""
            let least = Infinity;
            for (let i = 0; i < 60; ++i) {
              page.view.time = page.view.end * i / 60;
              const start = performance.now();
              page.drawTime();
              least = Math.min(least, performance.now() - start);
            }
            return least;""")
        print(f"{cost:.2f} ms of script per frame; 50 frames per second leave 20")

    def test_events_are_those_of_the_table_in_their_order(self):
        expected = [float(row["time_s"]) for row in self.program.table("strike", "transitions.csv")
                    if row["kind"].startswith("contact_")]
        self.js("page.view.setTime(0)")
        found = [0.0]
        for _ in range(6):
            self.press("right")
            found.append(self.view()["time"])
        later = sorted({t for t in expected if t > 0})
        self.assertEqual(found[1:], later[:6])
        self.press("left")
        self.assertEqual(self.view()["time"], later[4])
        self.assertIn("event: ", self.find("#readout").text)

    def test_the_keyboard_suffices(self):
        end = self.view()["end"]
        self.press("end")
        self.assertEqual(self.view()["time"], end)
        self.press("home")
        self.assertEqual(self.view()["time"], 0)
        self.press("space")
        self.assertTrue(self.js("return page.player.playing"))
        self.press("space")
        self.assertFalse(self.js("return page.player.playing"))
        self.press("n", "n")
        self.assertEqual(self.js("return page.chosen"), 1)
        self.press("p")
        self.assertEqual(self.js("return page.chosen"), 0)
        self.press("0")
        self.assert_windows_are(0, end)
        self.press("+")
        self.assertLess(self.view()["to"], 0.6 * end)
        self.press("escape")
        self.assert_windows_are(0, end)
        speed = self.js("return page.player.speed")
        self.press("]")
        self.assertGreater(self.js("return page.player.speed"), speed)

    def test_values_are_those_of_the_history(self):
        rows = self.program.table("strike", "history.csv")
        data = self.js("return Object.fromEntries(Object.entries(page.strike.history)"
                       ".map(([name, values]) => [name, Array.from(values)]))")
        self.assertEqual(data["time_s"], [float(row["time_s"]) for row in rows])
        for name, values in data.items():
            expected = [float(row[name]) for row in rows]
            extent = max(expected) - min(expected)
            error = max(abs(a - b) for a, b in zip(values, expected))
            self.assertLessEqual(error, 1e-6 * extent, name)
        shown = self.js("return page.charts[0].chart.getValue(1234, 1)")
        self.assertAlmostEqual(shown, float(rows[1234]["force_N"]), delta=1e-2)

    def test_the_moving_shape_at_every_event_is_that_of_the_table(self):
        shapes = {}
        for row in self.program.table("strike", "shapes.csv"):
            shapes.setdefault(float(row["time_s"]), []).append(row)
        largest = {name: max(abs(float(row[name])) for rows in shapes.values() for row in rows)
                   for name in ("displacement_m", "moment_Nm", "plastic_curvature_per_m")}
        events = self.js("return page.strike.events.map((event) => event.time)")
        self.assertGreater(len(events), 50)
        for event in events:
            rows = shapes[event]
            shape = self.js("""
                const shape = page.strike.shapeAt(arguments[0]);
                return [shape.displacement, shape.moment, shape.plasticCurvature].map((f) => Array.from(f))""", event)
            for name, values in zip(largest, shape):
                error = max(abs(a - float(row[name])) for a, row in zip(values, rows))
                self.assertLessEqual(error, 1e-6 * largest[name], f"{name} at {event}")

    def test_colours_have_contrast_in_light_and_dark(self):
        backgrounds = set()
        for theme in ("light", "dark"):
            self.js("document.getElementById('theme').click()")
            self.frame()
            self.assertEqual(self.js("return document.documentElement.dataset.theme"), theme)
            for text in ("text", "soft"):
                self.assertGreaterEqual(self.js(CONTRAST, text, "paper"), 4.5, f"{text} in {theme}")
            for line in ("line1", "line2", "line3", "line4", "line5", "line6", "beam" if theme == "dark" else "plastic"):
                self.assertGreaterEqual(self.js(CONTRAST, line, "paper"), 3.0, f"{line} in {theme}")
            self.assertGreaterEqual(self.js(CONTRAST, "text", "doubt-fill"), 4.5, theme)
            self.assertGreater(self.js(COUNT, self.find("#moment"), "line1"), 60, theme)
            backgrounds.add(self.js("return getComputedStyle(document.body).backgroundColor"))
        self.assertEqual(len(backgrounds), 2)

    def test_it_fits_narrow_and_wide_windows(self):
        for width in (500, 800, 1900):
            self.assert_fits(width)

    def test_everything_has_a_name(self):
        self.assertEqual(self.js(NAMELESS), [])
        self.assertEqual(self.js("return document.documentElement.lang"), "en")

    def test_it_prints_as_a_still_report(self):
        self.assertEqual(self.js("return getComputedStyle(document.getElementById('stills')).display"), "none")
        self.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "print"})
        try:
            self.assertEqual(self.js("return getComputedStyle(document.getElementById('stills')).display"), "block")
            self.assertEqual(self.js("return getComputedStyle(document.getElementById('strike')).display"), "none")
            self.assertGreaterEqual(self.js("return document.querySelectorAll('figure.still svg').length"), 7)
        finally:
            self.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": ""})

    def test_the_case_to_copy_repeats_the_run(self):
        (self.program.directory / "copied.toml").write_text(self.js("return document.getElementById('toml').textContent"),
                                                            encoding="utf-8")
        self.program("run", "copied.toml", "--out", "again", "--quiet")
        for name in ("events.csv", "history.csv"):
            self.assertEqual((self.program.directory / "again" / name).read_text(),
                             (self.program.directory / "strike" / name).read_text(), name)


class LongReport(PageTest):
    """20,000 rows and 400 shapes; elastic, so that energies follow from moments."""

    @classmethod
    def make(cls):
        directory = cls.program.run("long", "output.interval=4e-7", "output.shapes=2e-5", "output.shape_points=301",
                                    "model.section=elastic")
        cls.program("report", "long")
        return directory / "report.html"

    def test_it_stays_small_and_paints_soon(self):
        self.assertGreaterEqual(self.js("return page.strike.times.length"), 20000)
        self.assertGreaterEqual(self.js("return page.strike.shapes.times.length"), 400)
        size = self.page.stat().st_size
        paint = self.js("return performance.getEntriesByType('paint')[0].startTime")
        print(f"{size / 1e6:.2f} MB, first paint after {paint:.0f} ms")
        self.assertLess(size, 5e6)
        self.assertLess(paint, 1000)

    def test_elastic_energy_is_the_integral_of_the_moments(self):
        bending_stiffness = 71.96e9 * 0.0163 * 0.0075**3 / 12
        most = max(float(row["U_e_J"]) for row in self.program.table("long", "history.csv"))
        pairs = self.js("""
            const strike = page.strike;
            return Array.from(strike.shapes.times).filter((t) => t > 0).map((time) => {
              const {moment} = strike.shapeAt(time);
              return [strike.mean(moment.map((m) => m * m)) * strike.length / (2 * arguments[0]), strike.at('U_e_J', time)];
            });""", bending_stiffness)
        worst = max(abs(integral - energy) for integral, energy in pairs)
        print(f"largest difference of energies: {worst / most:.1e} of the largest")
        self.assertLess(worst, 5e-3 * most)


class HostileTexts(PageTest):
    TITLE = "\"><script>window.hacked = 1</script> `x` ${1} {{data}} ]]> 'q' & \\ </title> ü\nsecond line"

    @classmethod
    def make(cls):
        title = cls.TITLE.replace("\\", "\\\\").replace('"', '\\"').replace("\n", "\\n")
        directory = cls.program.run("hostile", f'title="{title}"', "time.end=3e-4", "model.segments=51")
        cls.program("report", "hostile")
        return directory / "report.html"

    def test_titles_appear_as_text(self):
        self.assertEqual(self.js("return document.querySelector('h1').textContent"), self.TITLE)
        self.assertEqual(self.driver.title, " ".join(self.TITLE.split()))
        self.assertIsNone(self.js("return window.hacked"))
        self.assertEqual(self.js("return document.scripts.length"), 7)

    def test_names_of_directories_appear_as_text_in_comparisons(self):
        name = "a\"b<i>`c` 'd'"
        self.program.run(name, "time.end=3e-4", "model.segments=51")
        self.program("report", "hostile", name, "--out", "both")
        browser.open_page(self.driver, self.program.directory / "both" / "comparison.html")
        self.assertIn(name, [cell.text for cell in self.driver.find_elements("css selector", "td")])
        self.assertIn(self.TITLE.split("\n")[0], self.js("return document.querySelector('h1').textContent"))
        self.assertIsNone(self.js("return window.hacked"))


    def test_titles_are_in_no_figure_and_no_script_of_one(self):
        import xml.etree.ElementTree as ElementTree
        files = [path for path in self.page.parent.iterdir() if path.suffix in (".svg", ".gp")]
        self.assertGreaterEqual(len(files), 14)
        for path in files:
            self.assertNotIn("hacked", path.read_text(encoding="utf-8"), path.name)
            if path.suffix == ".svg":
                ElementTree.parse(path)

    def test_the_case_to_copy_has_the_title(self):
        (self.program.directory / "copied.toml").write_text(
            self.js("return document.getElementById('toml').textContent"), encoding="utf-8")
        self.program("run", "copied.toml", "--out", "again", "--quiet")
        self.program("report", "again")
        browser.open_page(self.driver, self.program.directory / "again" / "report.html")
        self.assertEqual(self.js("return document.querySelector('h1').textContent"), self.TITLE)

    def test_words_of_result_files_appear_as_text(self):
        import json
        import shutil
        directory = self.program.directory / "changed"
        shutil.copytree(self.page.parent, directory)
        (directory / "manifest.json").unlink()  # as an older version left the files
        path = directory / "summary.json"
        summary = json.loads(path.read_text(encoding="utf-8"))
        words = "</p></script><script>window.hacked = 1</script>`${1}`\n{{data}} \" '"
        summary["layout"] = 3
        summary["warnings"] = [words]
        summary["choice"] = summary["program"]["version"] = summary["used"]["mesh"] = words
        summary["libraries"] = {words: words}
        summary["error_bars"].update({"first_unresolved_index": 1, "reason": words, "refined_run": words})
        for part in summary["error_bars"]["parts"]:
            part.update({"name": words, "refined_run": words, "reason": words, "first_unresolved_index": 1})
        summary["outcome"].update({"kind": "solver-failed", "message": words})
        path.write_text(json.dumps(summary), encoding="utf-8")
        self.program("report", "changed")
        browser.open_page(self.driver, directory / "report.html")
        self.assertIsNone(self.js("return window.hacked"))
        self.assertEqual(self.js("return document.scripts.length"), 7)
        self.assertGreaterEqual(self.js("return document.body.textContent").count("window.hacked = 1"), 8)

    def test_names_of_directories_appear_as_text_in_messages_and_pages(self):
        name = "x<i>\"`'\n&"
        (self.program.directory / name).mkdir()
        self.program("plot", "hostile", "--out", name + "/figures", "--scripts", name + "/scripts")
        self.assertTrue((self.program.directory / name / "figures" / "timeline.pdf").exists())
        self.assertTrue((self.program.directory / name / "scripts" / "timeline.gp").exists())
        self.program("report", "hostile", "--dygraphs", name, "--out", "bare")
        browser.open_page(self.driver, self.program.directory / "bare" / "report.html")
        self.assertIn(name, self.js("return document.body.textContent"))
        self.assertEqual(self.js("return document.querySelectorAll('i').length"), 0)


class PageWithoutCharts(PageTest):
    @classmethod
    def make(cls):
        directory = cls.program.run("plain", "time.end=3e-4", "model.segments=51")
        cls.errors = cls.program("report", "plain", "--dygraphs", "/nowhere").stderr
        return directory / "report.html"

    def test_it_shows_the_still_figures_and_how_to_get_charts(self):
        self.assertIn("libjs-dygraphs", self.errors)
        self.assertIn("apt-get install libjs-dygraphs", self.find("body").text)
        self.assertFalse(self.find("#charts").is_displayed())
        self.assertTrue(self.find("#stills").is_displayed())
        self.assertGreater(self.js(COUNT, self.find("#loop"), "line1"), 60)
        self.assertGreater(self.js(COUNT, self.find("#shape"), "beam"), 60)


class OtherRuns(PageTest):
    """Runs that lack something."""

    RUNS = {"no rows": ["output.interval=0"], "rigid": ["model.mesh=rigid"], "open": ["time.end=1e-5"],
            "no shapes": ["output.shapes=0"], "clamped": ['beam.ends=["clamped","pinned"]', "striker.position=0.3"],
            "elastic": ["beam.yield_stress=inf", "model.section=elastic", "contact.law=linear",
                        "contact.stiffness=1e7"]}

    @classmethod
    def make(cls):
        for name, settings in cls.RUNS.items():
            end = [] if name == "open" else ["time.end=3e-4"]
            cls.program.run(name, "model.segments=51", *end, *settings)
            cls.program("report", name)
        return cls.program.directory / "open" / "report.html"

    def test_pages_of_all_of_them_start_and_draw(self):
        for name in self.RUNS:
            with self.subTest(name):
                browser.open_page(self.driver, self.program.directory / name / "report.html")
                self.js("page.step(1); page.choose(0); page.showAll()")
                self.frame()
                self.assertGreater(self.js(COUNT, self.find("#timeline"), "line1"), 10)
                self.assertEqual(self.find("#motion").is_displayed(), name not in ("no shapes", "no rows"))
                self.assertEqual(self.find("#charts").is_displayed(), name != "no rows")
                problems = [entry for entry in self.driver.get_log("browser") if entry["level"] == "SEVERE"]
                self.assertEqual(problems, [])


class ComparisonPage(PageTest):
    @classmethod
    def make(cls):
        cls.program.run("first", "time.end=1e-3", "model.segments=51")
        cls.program.run("second", "time.end=1e-3", "model.segments=51", "solver.method=central-difference",
                        "output.interval=2e-6")
        cls.program("report", "first", "second", "--out", "both")
        return cls.program.directory / "both" / "comparison.html"

    def test_keys_that_differ_are_listed(self):
        text = self.find("body").text
        for key in ("output.interval", "solver.method", "central-difference"):
            self.assertIn(key, text)
        self.assertNotIn("striker.mass", text)

    def test_every_chart_has_a_line_per_run(self):
        for chart in ("force", "deflection", "velocity", "elastic"):
            canvas = self.js("return document.querySelector(arguments[0] + ' .plot canvas')", "#chart-" + chart)
            for line in ("line1", "line2"):
                self.assertGreater(self.js(COUNT, canvas, line), 100, f"{line} of {chart}")

    def test_differences_are_those_of_the_tables(self):
        starts = [float(self.program.table(name, "events.csv")[1]["start_s"]) for name in ("first", "second")]
        cells = [cell.text for cell in self.driver.find_elements("css selector", "[data-from]:nth-child(2) td")]
        self.assertEqual(cells[:2], ["2", "2"])
        shown = float(re.sub("−", "-", cells[3]))
        self.assertAlmostEqual(shown, 1e6 * (starts[1] - starts[0]), delta=1e-4)

    def test_a_click_on_a_row_zooms_all_charts(self):
        self.js("document.querySelectorAll('[data-from]')[1].click()")
        self.frame()
        view = self.view()
        self.assertLess(view["to"] - view["from"], 0.5 * view["end"])
        self.assert_windows_are(view["from"], view["to"])
        self.press("0")
        self.assert_windows_are(0, view["end"])

    def test_it_fits_narrow_windows_and_has_names(self):
        self.assert_fits(500)
        self.assertEqual(self.js(NAMELESS), [])


class ScatterPage(PageTest):
    """A strike on a beam whose thickness is known to 0.3 %."""

    @classmethod
    def make(cls):
        directory = cls.program.run("scatter", "scatter.beam.thickness=0.003", "time.end=1.8e-3", "model.segments=51",
                                    "model.section=exact")
        cls.program("report", "scatter")
        return directory / "report.html"

    def test_bars_of_the_timeline_are_those_of_the_table(self):
        rows = self.program.table("scatter", "events.csv")
        marks = self.js("return page.timeline.marks.filter(({kind}) => kind === 'contact')")
        self.assertEqual(len(marks), len(rows))
        for mark, row in zip(marks, rows):
            for name in ("error", "scatter"):
                text = row[f"start_{name}_s"]
                self.assertEqual(mark[name], float(text) if text else None)
        self.assertGreater(self.js(COUNT, self.find("#timeline"), "scatter"), 30)
        self.assertGreater(self.js(COUNT, self.find("#timeline"), "text"), 30)

    def test_a_bar_ends_at_its_value(self):
        mark = self.js("return page.timeline.marks.find(({scatter}) => scatter > 0)")
        self.js("page.view.setTime(0)")
        self.frame()
        top = self.js(COPY + """
            const {timeline} = page, mark = arguments[0], {axes, canvas} = timeline;
            const x = Math.round(axes.toX(mark.time * timeline.strike.time_unit.per_second)) + 3;
            const data = copied(canvas).getImageData(x, 0, 1, canvas.height).data;
            const text = getComputedStyle(document.documentElement).getPropertyValue('--scatter').trim();
            const wanted = [1, 3, 5].map((i) => parseInt(text.slice(i, i + 2), 16));
            let y = 0;
            while (y < axes.bottom && wanted.some((value, k) => Math.abs(data[4 * y + k] - value) > 3)) ++y;
            return [y, axes.toY(1e6 * mark.scatter)];""", mark)
        self.assertAlmostEqual(*top, delta=1.5)

    def test_the_part_beyond_the_horizon_is_marked(self):
        horizon = self.js("return page.strike.horizon")
        self.assertGreater(horizon, 0)
        self.assertLess(horizon, 1.8e-3)
        self.assertGreater(self.js(COUNT, self.find("#timeline"), "doubt"), 20)
        self.assertIn("; beyond: ", self.find("p.sub:nth-of-type(2)").text)

    def test_it_states_what_bending_theory_leaves_out_as_the_run_does(self):
        printed = self.program("run", self.program.case, "--out", "again", "--set", "time.end=3e-4").stdout
        line = next(line for line in printed.splitlines() if line.lstrip().startswith("left out"))
        self.program("report", "again")
        browser.open_page(self.driver, self.program.directory / "again" / "report.html")
        self.assertIn("Left out: " + re.sub(r"\bus\b", "µs", line.split("left out")[1].strip()), self.find("body").text)


class SweepPage(PageTest):
    """Of tables as subimpact-sweep writes them: 6 velocities by 5 masses by 2 methods."""

    NAME = "sweep <b>\"1\" `2` 'x'"
    METHODS = ["erk", "a`<i>\"'"]

    @classmethod
    def make(cls):
        cls.program.run("one", "time.end=9e-4", "model.segments=51")
        heading, *hits = (cls.program.directory / "one" / "events.csv").read_text().splitlines()
        cls.runs, cls.hits = [], {}
        runs = ["run,striker.mass,striker.velocity,solver.method,outcome,time_s,n_sub_impacts,n_decided,all_decided,"
                "max_force_N,message"]
        rows = ["run," + heading]
        for m in range(5):
            for v in range(6):
                for method in cls.METHODS:
                    run = len(runs) - 1
                    n = 1 + (m + v) % len(hits)
                    decided = n if (m + v) % 3 else n - 1
                    cls.runs.append((0.1 * 2**m, 2.0 + v, method, n, decided))
                    if run == 7:
                        runs.append(f"{run},{0.1 * 2**m},{2.0 + v},{method},refused,,,,,,because <b>`; \"of this\"")
                        continue
                    runs.append(f"{run},{0.1 * 2**m},{2.0 + v},{method},completed,0.0009,{n},{decided},{int(n == decided)},"
                                f"{1000.5 + run},")
                    rows += [f"{run},{hit}" for hit in hits[:n]]
                    cls.hits[run] = [dict(zip(heading.split(","), hit.split(","))) for hit in hits[:n]]
        directory = cls.program.directory / cls.NAME
        directory.mkdir()
        (directory / "runs.csv").write_text("\n".join(runs) + "\n", encoding="utf-8")
        (directory / "sub_impacts.csv").write_text("\n".join(rows) + "\n", encoding="utf-8")
        cls.program("report", cls.NAME)
        return directory / "sweep.html"

    def centre(self, run):
        """Of the mark of a run on the map, in pixels."""
        return self.js("""
            const {left, top, width, height} = page.map.marks.find(({run}) => run === arguments[0]);
            return [left + width / 2, top + height / 2];""", run)

    def pixel(self, x, y):
        return self.js(COPY + "return Array.from(copied(document.getElementById('map'))"
                       ".getImageData(Math.round(arguments[0]), Math.round(arguments[1]), 1, 1).data.slice(0, 3))", x, y)

    def click(self, run):
        from selenium.webdriver.common.action_chains import ActionChains
        canvas = self.find("#map")
        self.js("arguments[0].scrollIntoView({block: 'center'})", canvas)
        x, y = self.centre(run)
        (ActionChains(self.driver).move_to_element_with_offset(
            canvas, round(x - canvas.size["width"] / 2), round(y - canvas.size["height"] / 2)).pause(0.1).perform())
        self.frame()
        tip = self.find("#tip").text
        ActionChains(self.driver).click().perform()
        self.frame()
        return tip

    def choose(self, name, value):
        self.js("""
            const select = document.getElementById(arguments[0]);
            select.value = arguments[1];
            select.dispatchEvent(new Event('change'));""", name, value)
        self.frame()

    def test_nothing_is_fetched_and_names_appear_as_text(self):
        self.assertEqual(self.js("return performance.getEntriesByType('resource').map((e) => e.name)"), [])
        self.assertEqual(self.js("return document.querySelector('h1').textContent"), "Sweep: " + self.NAME)
        self.assertEqual(self.js("return document.querySelectorAll('b > *, i').length"), 0)

    def test_every_run_has_a_field_in_the_colour_of_its_count(self):
        self.assertTrue(self.js("return page.map.isGrid"))
        self.assertEqual(self.js("return page.map.marks.length"), 60)
        for run, (_, _, _, n, _) in enumerate(self.runs):
            x, y = self.centre(run)
            width = self.js("return page.map.marks.find(({run}) => run === arguments[0]).width", run)
            found = self.pixel(x - 0.4 * width, y)
            expected = self.js("return page.map.shade.rgb(arguments[0])", n) if run != 7 else None
            if expected:
                self.assertLess(max(abs(a - b) for a, b in zip(found, expected)), 6, f"run {run}: {found} {expected}")
        low, high = self.js("return [page.map.shade.rgb(page.map.shade.low), page.map.shade.rgb(page.map.shade.high)]")
        self.assertGreater(sum(abs(a - b) for a, b in zip(low, high)), 250)

    def test_counts_that_are_not_decided_have_a_cross(self):
        for run, (_, _, _, n, decided) in enumerate(self.runs):
            if run == 7:
                continue
            x, y = self.centre(run)
            colours = {tuple(self.pixel(x + d, y + d)) for d in (-2, 0, 2)}
            plain = self.js("return page.map.shade.rgb(arguments[0])", n)
            has_cross = any(max(abs(a - b) for a, b in zip(c, plain)) > 40 for c in colours)
            self.assertEqual(has_cross, decided < n, f"run {run}: {colours}")
        self.assertIn("the counts of", self.find("ul.headline").text)

    def test_a_click_opens_the_numbers_of_a_run(self):
        run = 33
        mass, velocity, method, n, decided = self.runs[run]
        tip = self.click(run)
        for words in ("run 33:", f"{mass:g} kg", f"{velocity:g} m/s", method):
            self.assertIn(words, tip)
        self.assertEqual(self.find("#run-title").text, "Run 33")
        self.assertIn(f"{1000.5 + run:g} N", self.find("#row").text)
        rows = self.driver.find_elements("css selector", "#sub-impacts tbody tr")
        self.assertEqual(len(rows), n)
        for i, (row, hit) in enumerate(zip(rows, self.hits[run])):
            cells = [cell.text for cell in row.find_elements("css selector", "td")]
            start = float(cells[1].split(" ")[0].replace("−", "-"))
            self.assertAlmostEqual(start, 1e6 * float(hit["start_s"]), delta=1e-3 * max(1.0, start))
            self.assertAlmostEqual(float(cells[4]), float(hit["peak_force_N"]), delta=1e-4 * float(hit["peak_force_N"]))
            self.assertEqual("undecided" in row.get_attribute("class"), i >= decided)
        self.assertGreater(self.js(COUNT, self.find("#timeline"), "line1"), 10)
        command = self.js("return document.getElementById('command').textContent")
        self.assertIn(f"--set striker.mass={mass:g}", command)
        self.assertIn("--set 'solver.method=" + method.replace("'", "'\\''") + "'", command)

    def test_a_run_that_was_refused_shows_why(self):
        self.click(7)
        self.assertIn("because <b>`; \"of this\"", self.find("#row").text)
        self.assertIn("It has none.", self.find("#hits-note").text)

    def test_the_keyboard_suffices(self):
        self.js("document.getElementById('map').focus()")
        self.frame()
        self.assertEqual(self.js("return page.map.chosen"), 0)
        self.press("right", "right")  # the other method, then the next velocity
        self.assertEqual(self.js("return page.map.chosen"), 2)
        self.press("n")
        self.assertEqual(self.js("return page.map.chosen"), 3)
        self.press("p", "left")
        self.assertEqual(self.js("return page.map.chosen"), 1)
        self.press("up")
        self.assertEqual(self.runs[self.js("return page.map.chosen")][0], 0.2)
        self.press("enter")
        self.assertEqual(self.js("return document.activeElement.id"), "run")

    def test_one_value_of_a_further_key_can_be_chosen(self):
        self.js("""
            const {select} = page.filters[0];
            select.value = '0';
            select.dispatchEvent(new Event('change'));""")
        self.assertEqual(self.js("return page.map.visible.length"), 30)

    def test_any_column_may_be_an_axis_or_a_colour(self):
        for x in ("striker.velocity", "solver.method", "max_force_N"):
            for y in ("max_force_N", "solver.method"):
                self.choose("x", x)
                self.choose("y", y if y != "solver.method" else "n_sub_impacts")
                self.assertEqual(self.js("return page.map.visible.length"), 59, (x, y))
        for shade in ("max_force_N", "outcome", "striker.mass"):
            self.choose("shade", shade)
            self.assertGreater(self.js(COPY + """
                const canvas = document.getElementById('scale');
                return new Set(copied(canvas).getImageData(0, 10, canvas.width, 1).data).size"""), 2, shade)

    def test_points_stand_where_their_values_are(self):
        self.choose("y", "max_force_N")
        for run in (0, 31, 59):
            x, y = self.centre(run)
            axes = self.js("return [page.map.axes.toX(arguments[0]), page.map.axes.toY(arguments[1])]", self.runs[run][1], 1000.5 + run)
            self.assertAlmostEqual(x, axes[0], delta=1e-6)
            self.assertAlmostEqual(y, axes[1], delta=1e-2)

    def test_it_fits_all_windows_in_light_and_dark_and_has_names(self):
        self.js("page.choose(3)")
        for theme in ("light", "dark"):
            self.js("document.getElementById('theme').click()")
            self.frame()
            self.assertGreater(self.js(COUNT, self.find("#map"), "text"), 20, theme)
            for width in (500, 1900):
                self.assert_fits(width)
        self.assertEqual(self.js(NAMELESS), [])

    def test_it_prints_the_map_on_white(self):
        import base64
        self.js("document.getElementById('theme').click(); document.getElementById('theme').click()")
        self.js("addEventListener('afterprint', () => { window.printed = true; });"
                "addEventListener('beforeprint', () => { window.theme = document.documentElement.dataset.theme; });")
        pdf = base64.b64decode(self.driver.execute_cdp_cmd("Page.printToPDF", {"printBackground": True})["data"])
        self.assertEqual(pdf[:5], b"%PDF-")
        self.assertEqual(self.js("return [window.theme, document.documentElement.dataset.theme]"), ["light", "dark"])

    def test_a_sweep_beside_a_run_is_refused_and_damage_is_named(self):
        import subprocess
        done = subprocess.run([self.program.path, "report", self.NAME, "one", "--out", "both"], cwd=self.program.directory,
                              capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 2)
        self.assertIn("holds a sweep", done.stderr)
        broken = self.program.directory / "broken"
        broken.mkdir()
        (broken / "runs.csv").write_text("run,outcome\n0\n")
        (broken / "sub_impacts.csv").write_text("")
        done = subprocess.run([self.program.path, "report", "broken"], cwd=self.program.directory, capture_output=True,
                              text=True, check=False)
        self.assertEqual(done.returncode, 2)
        self.assertIn("runs.csv:2: has 1 cell", done.stderr)
        self.assertFalse((broken / "sweep.html").exists())


if __name__ == "__main__":
    browser.skip_unless_there()
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]], verbosity=2)
