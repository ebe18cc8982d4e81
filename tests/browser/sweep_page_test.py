"""The page of a sweep: sweep_page_test.py PROGRAM CASE"""

import base64
import math
import subprocess

import browser
from page_test_case import COPY, COUNT, NAMELESS, PageTestCase, main


class SweepPage(PageTestCase):
    """Of tables as subimpact-sweep writes them: 6 velocities by 5 masses by 2 methods."""

    NAME = "sweep <b>\"1\" `2` 'x'"
    METHODS = ["erk", "a`<i>\"'"]

    @classmethod
    def make(cls):
        cls.program.run("one", "time.end=9e-4", "model.segments=51")
        heading, *hits = (cls.program.directory / "one" / "events.csv").read_text().splitlines()
        cls.runs, cls.hits = [], {}
        runs = ["run,striker.mass,striker.velocity,solver.method,outcome,time_s,n_sub_impacts,n_certain,all_certain,"
                "max_force_N,message"]
        rows = ["run," + heading]
        for m in range(5):
            for v in range(6):
                for method in cls.METHODS:
                    run = len(runs) - 1
                    n = 1 + (m + v) % len(hits)
                    certain = n if (m + v) % 3 else n - 1
                    cls.runs.append((0.1 * 2**m, 2.0 + v, method, n, certain))
                    if run == 7:
                        runs.append(f"{run},{0.1 * 2**m},{2.0 + v},{method},refused,,,,,,because <b>`; \"of this\"")
                        continue
                    runs.append(f"{run},{0.1 * 2**m},{2.0 + v},{method},completed,0.0009,{n},{certain},{int(n == certain)},"
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
        canvas = self.find("#map")
        self.js("arguments[0].scrollIntoView({block: 'center'})", canvas)
        x, y = self.centre(run)
        (browser.ActionChains(self.driver).move_to_element_with_offset(
            canvas, round(x - canvas.size["width"] / 2), round(y - canvas.size["height"] / 2)).pause(0.1).perform())
        self.frame()
        tip = self.find("#tip").text
        browser.ActionChains(self.driver).click().perform()
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
        counts = self.js("return page.map.shade.column.different")
        tones = self.js("return page.map.shade.column.different.map((n) => page.map.shade.rgb(n))")
        for i, tone in enumerate(tones):
            for n, other in zip(counts[:i], tones):
                self.assertGreater(sum(abs(a - b) for a, b in zip(tone, other)), 60, f"{counts[i]} and {n}")
        colours = self.js(COPY + """
            const {data} = copied(document.getElementById('scale')).getImageData(0, 0, 4000, 200);
            return Array.from(new Set(new Uint32Array(data.buffer)), (c) => [c & 255, (c >> 8) & 255, (c >> 16) & 255]);""")
        for n, tone in zip(counts, tones):
            self.assertIn(tone, colours, f"no sample of {n} in the key")

    def test_counts_that_are_not_decided_have_a_cross(self):
        for run, (_, _, _, n, certain) in enumerate(self.runs):
            if run == 7:
                continue
            x, y = self.centre(run)
            colours = {tuple(self.pixel(x + d, y + d)) for d in (-2, 0, 2)}
            plain = self.js("return page.map.shade.rgb(arguments[0])", n)
            has_cross = any(max(abs(a - b) for a, b in zip(c, plain)) > 40 for c in colours)
            self.assertEqual(has_cross, certain < n, f"run {run}: {colours}")
        self.assertIn("the counts of", self.find("ul.headline").text)

    def test_a_click_opens_the_numbers_of_a_run(self):
        run = 33
        mass, velocity, method, n, certain = self.runs[run]
        tip = self.click(run)
        for words in ("run 33:", f"{mass:g} kg", f"{velocity:g} m/s", method):
            self.assertIn(words, tip)
        self.assertEqual(self.find("#run-title").text, "Run 33")
        self.assertIn(f"{1000.5 + run:.4g} N", self.find("#row").text)  # without an error, four digits
        rows = self.driver.find_elements("css selector", "#sub-impacts tbody tr")
        self.assertEqual(len(rows), n)
        for i, (row, hit) in enumerate(zip(rows, self.hits[run])):
            cells = [cell.text for cell in row.find_elements("css selector", "td")]
            start = float(cells[1].split(" ")[0].replace("−", "-"))
            self.assertAlmostEqual(start, 1e6 * float(hit["start_s"]), delta=1e-3 * max(1.0, start))
            self.assertAlmostEqual(float(cells[4]), float(hit["peak_force_N"]), delta=1e-4 * float(hit["peak_force_N"]))
            self.assertEqual("uncertain" in row.get_attribute("class"), i >= certain)
        self.assertGreater(self.js(COUNT, self.find("#timeline"), "line1"), 10)
        command = self.js("return document.getElementById('command').textContent")
        self.assertTrue(command.startswith(f"subimpact run CASE.toml --out run-{run} "), command)  # there is no base.toml
        self.assertIn(f"--set striker.mass={mass:g}", command)
        self.assertIn("--set 'solver.method=" + method.replace("'", "'\\''") + "'", command)

    def test_its_force_is_drawn_as_pulses_with_the_impulses_of_its_contacts(self):
        for mean in (0.9, 2 / math.pi, 0.5, 0.2):
            power = self.js("return RunPanel.powerOfPulse(arguments[0])", mean)
            exact = math.gamma((power + 1) / 2) / math.gamma(power / 2 + 1) / math.sqrt(math.pi)
            self.assertAlmostEqual(exact, mean, delta=2e-3)
        self.click(33)
        self.assertGreater(self.js(COUNT, self.find("#pulses"), "line1"), 100)

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
        self.js("document.getElementById('theme').click(); document.getElementById('theme').click()")
        self.js("addEventListener('afterprint', () => { window.printed = true; });"
                "addEventListener('beforeprint', () => { window.theme = document.documentElement.dataset.theme; });")
        pdf = base64.b64decode(self.driver.execute_cdp_cmd("Page.printToPDF", {"printBackground": True})["data"])
        self.assertEqual(pdf[:5], b"%PDF-")
        self.assertEqual(self.js("return [window.theme, document.documentElement.dataset.theme]"), ["light", "dark"])

    def test_a_sweep_beside_a_run_is_refused_and_damage_is_named(self):
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
    main()
