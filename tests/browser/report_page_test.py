"""The page of a run as a reader meets it: report_page_test.py PROGRAM CASE [CLASS]..."""

import time

import browser
from page_test_case import COUNT, CONTRAST, NAMELESS, PageTestCase, main


class ReportPage(PageTestCase):
    """The published strike."""

    @classmethod
    def make(cls):
        directory = cls.program.run("strike")
        cls.program("plot", "strike", "--format", "svg")
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

    def test_any_column_of_the_history_can_be_drawn(self):
        names = self.js("return Object.keys(page.strike.meanings)")
        offered = self.js("return Array.from(document.querySelectorAll('#column option'), (o) => o.value)")
        self.assertEqual(offered, [name for name in names if name not in ("R_0_N", "R_l_N")])
        for name in offered:
            self.js("const s = byId('column'); s.value = arguments[0]; s.dispatchEvent(new Event('change'))", name)
            self.assertEqual(self.js("return page.charts.at(-1).chart.getLabels()[1]"), name)
            same = self.js("const {chart} = page.charts.at(-1), rows = page.strike.history[arguments[0]];"
                           "return rows.every((value, i) => Object.is(value, chart.getValue(i, 1)))", name)
            self.assertTrue(same, name)
        self.assertEqual(self.js("return document.querySelectorAll('#chart-any .cursor').length"), 1)

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
        self.assertRegex(self.find("#part").text, r"^start [\d.]+ .*µs · end .* · peak force .* N · ")
        self.js("page.player.speed = 1e3; page.player.play(); page.player.last -= 1000; page.player.frame(performance.now())")
        self.assertEqual(self.js("return [page.view.time, page.player.playing]"), [view["to"], False])  # not beyond the part
        self.js(f"page.view.setTime({start})")
        self.frame()
        self.assertIn("chosen", self.js("return document.querySelectorAll('[data-hit]')[2].className"))
        low, high = self.js("return page.loop.axes.x.range")
        self.assertLess(high, 1.1e3 * float(third["max_indentation_m"]))
        self.assertLess(self.js("return page.timeline.axes.x.range[1]"), 1.2e6 * end)

    def test_it_plays_pauses_and_steps_to_events(self):
        speed = self.js("return page.player.speed")
        self.js("document.getElementById('play').click()")
        time.sleep(0.5)
        first = self.js("return [page.view.time, performance.now()]")
        time.sleep(1.5)
        second = self.js("return [page.view.time, performance.now()]")
        self.js("document.getElementById('play').click()")
        seconds = (second[1] - first[1]) / 1e3
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
            if rows[0][name] == "":  # an empty column
                self.assertEqual(set(values), {None}, name)
                continue
            expected = [float(row[name]) for row in rows]
            extent = max(expected) - min(expected)
            error = max(abs(a - b) for a, b in zip(values, expected))
            self.assertLessEqual(error, 1e-6 * extent, name)
        hits = self.program.table("strike", "events.csv")
        apart = 0.5 * (float(hits[4]["end_s"]) + float(hits[5]["start_s"]))
        gap = self.js("return [page.strike.gapAt(arguments[0]), page.strike.at('indentation_m', arguments[0])]", apart)
        self.assertAlmostEqual(gap[0], float(hits[4]["residual_indentation_m"]) - gap[1], delta=1e-12)
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
            self.assertEqual(self.find("#theme").text, f"Colours: {theme}")
            for text in ("text", "soft"):
                self.assertGreaterEqual(self.js(CONTRAST, text, "paper"), 4.5, f"{text} in {theme}")
            for line in ("line1", "line2", "line3", "line4", "line5", "line6", "beam" if theme == "dark" else "plastic"):
                self.assertGreaterEqual(self.js(CONTRAST, line, "paper"), 3.0, f"{line} in {theme}")
            self.assertGreaterEqual(self.js(CONTRAST, "text", "doubt-fill"), 4.5, theme)
            self.assertGreater(self.js(COUNT, self.find("#moment"), "line1"), 60, theme)
            backgrounds.add(self.js("return getComputedStyle(document.body).backgroundColor"))
        self.assertEqual(len(backgrounds), 2)

    def test_beam_and_force_are_on_the_first_screen_and_indentation_after_a_click(self):
        inside = """
            return arguments[0].map((id) => byId(id).closest('.panel').getBoundingClientRect())
              .every(({top, bottom, left, right, height}) => height > 150 && top >= arguments[1] && left >= 0
                     && bottom <= innerHeight && right <= innerWidth);"""
        for width in (1400, 700):
            for theme in ("light", "dark"):
                self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {
                    "width": width, "height": 900, "deviceScaleFactor": 1, "mobile": False})
                self.js("scrollTo(0, 0); page.showAll(); byId('dark').media = arguments[0]",
                        "screen" if theme == "dark" else "not all")
                self.frame()
                self.assertTrue(self.js(inside, ["shape", "chart-force"], 0), f"{width}, {theme}")
                answers = self.js("return [...document.querySelectorAll('.tiles.first b')].map((e) =>"
                                  "[e.textContent, e.getBoundingClientRect().bottom <= innerHeight])")
                self.assertGreaterEqual(len(answers), 4)
                self.assertEqual([text for text, seen in answers if not seen], [])
                self.js("document.querySelectorAll('[data-hit]')[4].click()")
                self.frame()
                self.assertTrue(self.js(inside, ["shape", "chart-force", "loop"],
                                        self.js("return byId('bar').getBoundingClientRect().bottom - 1")), f"{width}, {theme}")
        self.driver.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})

    def test_it_opens_at_the_largest_force_and_folds_doubts_into_one_line(self):
        rows = self.program.table("strike", "history.csv")
        largest = max(float(row["force_N"]) for row in rows)
        self.assertGreater(self.js("return page.strike.at('force_N', page.view.time)"), 0.98 * largest)
        doubts = self.js("return [...document.querySelectorAll('.verdict li.not')].map((e) => e.textContent)")
        self.assertGreater(len(doubts), 0)
        uncertain = [row["index"] for row in self.program.table("strike", "events.csv") if row["certain"] == "0" and row["doubt"]]
        for number in uncertain[:8]:
            self.assertIn(f"sub-impact {number}:", "\n".join(doubts))
        steps = self.js("return [...document.querySelectorAll('.steps:not(.remedies) dt')].map((e) => e.textContent)")
        self.assertTrue(steps and all(" run " in step and " --out " in step for step in steps), steps)
        seen = "return document.querySelector('.verdict li').checkVisibility()"
        self.assertFalse(self.js(seen))
        self.find(".verdict summary").send_keys(" ")
        self.assertTrue(self.js(seen))
        self.assertFalse(self.js("return page.player.playing"))

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
            self.assertEqual(self.js("return getComputedStyle(document.getElementById('stills')).display"), "grid")
            shown = "return getComputedStyle(document.querySelector(arguments[0])).display"
            self.assertEqual(self.js(shown, "#strike"), "flow-root")
            self.assertEqual([self.js(shown, place) for place in ("#bar", "#picture", "#more")], 3 * ["none"])
            n_figures = self.js("return document.querySelectorAll('figure.still svg').length")
            self.assertGreaterEqual(n_figures, 7)
        finally:
            self.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": ""})
        n_pages = self.n_printed_pages()
        print(f"{len(self.program.table('strike', 'events.csv'))} sub-impacts, {n_figures} figures: {n_pages} pages")
        self.assertLessEqual(n_pages, 4)

    def test_the_case_to_copy_repeats_the_run(self):
        (self.program.directory / "copied.toml").write_text(self.js("return document.getElementById('toml').textContent"),
                                                            encoding="utf-8")
        self.program("run", "copied.toml", "--out", "again", "--quiet")
        for name in ("events.csv", "history.csv"):
            self.assertEqual((self.program.directory / "again" / name).read_text(),
                             (self.program.directory / "strike" / name).read_text(), name)


class PageWithoutCharts(PageTestCase):
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


class OtherRuns(PageTestCase):
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


class Surroundings(PageTestCase):
    """A bar that swings against a stop, with a spring and a force that ends after 1 ms."""

    @classmethod
    def make(cls):
        (cls.program.directory / "swing.toml").write_text("""
            time = { end = "2 ms" }
            [beam]
            length = "500 mm"
            width = "20 mm"
            thickness = "10 mm"
            density = "7850 kg/m3"
            youngs_modulus = "210 GPa"
            ends = ["pinned", "free"]
            angular_velocity = -4.0
            springs = [{ position = 0.9, stiffness = 1e4 }]
            forces = [{ position = 0.3, table = [[0.0, 50.0], [0.001, 50.0], [0.001001, 0.0]] }]
            [striker]
            fixed = true
            nose_radius = "10 mm"
            position = 0.667
            [contact]
            law = "foundation"
            [model]
            elements = 20
            [output]
            gauges = [{ position = 0.3 }, { position = 0.5, face = "front" }]
            """)
        cls.program("run", "swing.toml", "--out", "swing", "--quiet", "--error-bars", "off")
        cls.program("report", "swing")
        return cls.program.directory / "swing" / "report.html"

    def pixels(self, time, tone):
        self.js("page.view.setTime(arguments[0])", time)
        self.frame()
        return self.js(COUNT, self.find("#shape"), tone)

    def test_the_stop_reaches_out_of_the_picture_and_keeps_its_place(self):
        displacements = self.js("return Array.from(new Set(page.strike.history.w_m_m))")
        self.assertEqual(displacements, [0])
        self.assertGreater(self.pixels(0.1e-3, "striker-apart") + self.pixels(0.1e-3, "striker"), 200)
        labels = self.js("return page.charts.flatMap(({chart}) => chart.getLabels())")
        self.assertIn("stop w_m", labels)
        self.assertNotIn("striker w_m", labels)

    def test_strains_at_gauges_have_a_chart_of_their_own_in_millionths(self):
        chart = ("const {chart} = page.charts.find(({chart}) => chart.getLabels()[1].startsWith('gauge 1'));"
                 "const largest = (column) => Math.max(...page.strike.times.map((t, i) => chart.getValue(i, column)));")
        self.assertEqual(self.js(chart + "return chart.getLabels().slice(1)"),
                         ["gauge 1: x = 0.3 l, back", "gauge 2: x = 0.5 l, front"])
        rows = self.program.table("swing", "history.csv")
        for column in (1, 2):
            strains = [1e6 * float(row[f"gauge_{column}_strain"]) for row in rows]
            self.assertGreater(max(strains), 10)
            self.assertAlmostEqual(self.js(chart + "return largest(arguments[0])", column), max(strains), delta=1e-5 * max(strains))
        self.assertTrue(self.find("#chart-strain").is_displayed())

    def test_it_prints_on_two_pages(self):
        self.assertEqual(self.n_printed_pages(), 2)

    def test_the_spring_is_drawn_throughout_and_the_force_while_it_acts(self):
        self.assertGreater(self.pixels(0.5e-3, "soft"), 100)
        self.assertGreater(self.pixels(0.5e-3, "line3"), 60)
        self.assertLess(self.pixels(1.5e-3, "line3"), 10)


if __name__ == "__main__":
    main()
