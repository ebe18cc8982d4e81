"""The page that compares runs: comparison_page_test.py PROGRAM CASE"""

import re

from page_test_case import COUNT, NAMELESS, PageTestCase, main


class ComparisonPage(PageTestCase):
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


if __name__ == "__main__":
    main()
