"""Titles, names and words that would be markup: hostile_texts_test.py PROGRAM CASE"""

import hashlib
import json
import shutil
import xml.etree.ElementTree as ElementTree

import browser
from page_test_case import PageTestCase, main


class HostileTexts(PageTestCase):
    TITLE = "\"><script>window.hacked = 1</script> `x` ${1} {{data}} ]]> 'q' & \\ </title> ü\nsecond line"

    @classmethod
    def make(cls):
        title = cls.TITLE.replace("\\", "\\\\").replace('"', '\\"').replace("\n", "\\n")
        directory = cls.program.run("hostile", f'title="{title}"', "time.end=3e-4", "model.segments=51")
        cls.program("plot", "hostile", "--format", "svg")
        cls.program("report", "hostile")
        return directory / "report.html"

    def test_titles_appear_as_text(self):
        self.assertEqual(self.js("return document.querySelector('h1').textContent"), self.TITLE)
        self.assertEqual(self.driver.title, " ".join(self.TITLE.split()))
        self.assertIsNone(self.js("return window.hacked"))
        self.assertEqual(self.js("return document.scripts.length"), 8)

    def test_names_of_directories_appear_as_text_in_comparisons(self):
        name = "a\"b<i>`c` 'd'"
        self.program.run(name, "time.end=3e-4", "model.segments=51")
        self.program("report", "hostile", name, "--out", "both")
        browser.open_page(self.driver, self.program.directory / "both" / "comparison.html", live=False)
        self.assertIn("B: " + name, [cell.text for cell in self.driver.find_elements("css selector", "th")])
        self.assertIn(self.TITLE.split("\n")[0], self.js("return document.querySelector('h1').textContent"))
        self.assertIsNone(self.js("return window.hacked"))


    def test_titles_are_in_no_figure(self):
        files = list((self.page.parent / "figures").glob("*.svg"))
        self.assertGreaterEqual(len(files), 7)
        for path in files:
            self.assertNotIn("hacked", path.read_text(encoding="utf-8"), path.name)
            ElementTree.parse(path)

    def test_the_case_to_copy_has_the_title(self):
        (self.program.directory / "copied.toml").write_text(
            self.js("return document.getElementById('toml').textContent"), encoding="utf-8")
        self.program("run", "copied.toml", "--out", "again", "--quiet")
        self.program("report", "again")
        browser.open_page(self.driver, self.program.directory / "again" / "report.html")
        self.assertEqual(self.js("return document.querySelector('h1').textContent"), self.TITLE)

    def test_words_of_result_files_appear_as_text(self):
        directory = self.program.directory / "changed"
        shutil.copytree(self.page.parent, directory)
        path = directory / "summary.json"
        summary = json.loads(path.read_text(encoding="utf-8"))
        words = "</p></script><script>window.hacked = 1</script>`${1}`\n{{data}} \" '"
        summary["warnings"] = [words]
        summary["choice"] = summary["program"]["version"] = summary["used"]["mesh"] = words
        summary["libraries"] = {words: words}
        summary["error_bars"].update({"first_unresolved_index": 1, "reason": words, "refined_run": words})
        summary["outcome"].update({"kind": "solver-failed", "message": words})
        summary["verdict"]["text"] = words
        for answer in summary["answers"]:
            answer.update({"label": words, "text": words, "error_text": words, "body_text": words, "note": words})
        path.write_text(json.dumps(summary), encoding="utf-8")
        report = json.loads((directory / "report.json").read_text(encoding="utf-8"))
        report.update({name: words for name in ("caveat", "tolerance", "strikes", "verbose", "case")})
        for line in report["headlines"]:
            line.update({"text": words})
        for row in report["sub_impacts"]["rows"]:
            row["cells"] = [words] * len(row["cells"])
        (directory / "report.json").write_text(json.dumps(report), encoding="utf-8")
        manifest = json.loads((directory / "manifest.json").read_text(encoding="utf-8"))
        for path in (path, directory / "report.json"):
            manifest["files"][path.name] = {"bytes": path.stat().st_size,
                                            "sha256": hashlib.sha256(path.read_bytes()).hexdigest()}
        (directory / "manifest.json").write_text(json.dumps(manifest), encoding="utf-8")
        self.program("report", "changed")
        browser.open_page(self.driver, directory / "report.html")
        self.assertIsNone(self.js("return window.hacked"))
        self.assertEqual(self.js("return document.scripts.length"), 8)
        self.assertGreaterEqual(self.js("return document.body.textContent").count("window.hacked = 1"), 8)

    def test_names_of_directories_appear_as_text_in_messages_and_pages(self):
        name = "x<i>\"`'\n&"
        (self.program.directory / name).mkdir()
        self.program("plot", "hostile", "--out", name + "/figures", "--format", "pdf", "--only", "timeline")
        self.assertTrue((self.program.directory / name / "figures" / "timeline.pdf").exists())
        self.program("report", "hostile", "--dygraphs", name, "--out", "bare")
        browser.open_page(self.driver, self.program.directory / "bare" / "report.html")
        self.assertIn(name, self.js("return document.body.textContent"))
        self.assertEqual(self.js("return document.querySelectorAll('i').length"), 0)


if __name__ == "__main__":
    main()
