"""What the tests of pages share: a page in a browser, its keys, charts and pixels."""

import base64
import re
import sys
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


class PageTestCase(unittest.TestCase):
    maxDiff = 2000
    page = None  # file of the page, which make() writes
    live = True  # it has scripts

    @classmethod
    def setUpClass(cls):
        cls.program = browser.Program(program_path, case_path)
        cls.addClassCleanup(cls.program.remove)
        cls.page = cls.make()
        cls.driver = browser.start()
        cls.addClassCleanup(cls.driver.quit)

    def setUp(self):
        self.driver.set_window_size(1280, 1000)
        browser.open_page(self.driver, self.page, self.live)
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

    def n_printed_pages(self):
        pdf = base64.b64decode(self.driver.execute_cdp_cmd("Page.printToPDF", {})["data"])
        return len(re.findall(rb"/Type\s*/Page\b", pdf))

    def press(self, *keys):
        browser.ActionChains(self.driver).send_keys("".join(KEYS.get(key, key) for key in keys)).perform()
        self.frame()

    def drag(self, element, from_share, to_share):
        """Across an element, from and to shares of its width, at half its height."""
        self.js("arguments[0].scrollIntoView({block: 'center'})", element)
        width = element.size["width"]
        (browser.ActionChains(self.driver).move_to_element_with_offset(element, int((from_share - 0.5) * width), 0)
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


def main():
    """For a file of tests: FILE PROGRAM CASE [CLASS[.TEST]]..."""
    browser.skip_unless_there()
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]], verbosity=2)
