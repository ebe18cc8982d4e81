"""The page of a sweep: sweep_page_test.py PROGRAM CASE"""


from page_test_case import NAMELESS, PageTestCase, main


class SweepPage(PageTestCase):
    """Of tables as subimpact-sweep writes them: 6 velocities by 5 masses by 2 methods."""

    live = False

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

    def test_nothing_is_fetched_and_names_appear_as_text(self):
        self.assertEqual(self.js("return performance.getEntriesByType('resource').map((e) => e.name)"), [])
        self.assertEqual(self.js("return document.querySelector('h1').textContent"), "Sweep: " + self.NAME)
        self.assertEqual(self.js("return [document.querySelectorAll('b > *, i').length, document.scripts.length]"), [0, 0])

    def test_every_run_has_a_row(self):
        rows = [[cell.text for cell in row.find_elements("css selector", "td")]
                for row in self.driver.find_elements("css selector", "#runs tbody tr")]
        self.assertEqual(len(rows), 60)
        for run, (row, (mass, velocity, method, n, certain)) in enumerate(zip(rows, self.runs)):
            self.assertEqual((row[0], float(row[1]), float(row[2]), row[3]), (str(run), mass, velocity, method))
            if run != 7:
                self.assertEqual(row[4:7], ["completed", str(n), str(certain)])
        self.assertEqual([rows[7][4], rows[7][-1]], ["refused", "because <b>`; \"of this\""])

    def test_maps_and_histograms_are_drawn_and_doubt_is_stated(self):
        for name in ("map-n_sub_impacts", "map-max_force_N", "histograms"):
            self.assertGreater(self.js("return document.getElementById(arguments[0]).querySelectorAll('path').length",
                                       "figure-" + name), 20, name)
        self.assertIn("the counts of", self.find("ul.headline").text)

    def test_the_command_makes_a_run_alone(self):
        command = self.find("pre").text
        self.assertTrue(command.startswith("subimpact run CASE.toml --out run-0 --set striker.mass=0.1 "), command)  # no base.toml

    def test_it_fits_all_windows_has_names_and_prints(self):
        for width in (500, 1900):
            self.assert_fits(width)
        self.assertEqual(self.js(NAMELESS), [])
        self.assertGreater(self.n_printed_pages(), 0)

if __name__ == "__main__":
    main()
