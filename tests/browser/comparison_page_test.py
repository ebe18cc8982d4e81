"""The page that compares runs: comparison_page_test.py PROGRAM CASE"""

import re

from page_test_case import NAMELESS, PageTestCase, main


class ComparisonPage(PageTestCase):
    live = False

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

    def test_every_panel_of_the_figure_has_a_line_per_run(self):
        strokes = self.js("return [...document.querySelectorAll('#figure-comparison path')].map((p) => p.style.stroke)")
        for colour in ("rgb(0, 114, 178)", "rgb(213, 94, 0)"):
            self.assertGreaterEqual(strokes.count(colour), 4, colour)

    def test_differences_are_those_of_the_tables(self):
        starts = [float(self.program.table(name, "events.csv")[1]["start_s"]) for name in ("first", "second")]
        cells = [cell.text for cell in self.driver.find_elements("css selector", "h2 + p + .wide tr:nth-child(2) td")]
        self.assertEqual(cells[:2], ["2", "2"])
        shown = float(re.sub("−", "-", cells[3]))
        self.assertAlmostEqual(shown, 1e6 * (starts[1] - starts[0]), delta=1e-4)

    def test_it_needs_no_script_fits_narrow_windows_and_has_names(self):
        self.assertEqual(self.js("return document.scripts.length"), 0)
        self.assertEqual(self.js("return performance.getEntriesByType('resource').map((e) => e.name)"), [])
        self.assert_fits(500)
        self.assertEqual(self.js(NAMELESS), [])


if __name__ == "__main__":
    main()
