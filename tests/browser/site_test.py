"""The site of the documentation, built, served and searched without network: site_test.py PROGRAM [TEST]...

Prints the rank of the page that each word is expected to lead to.
"""

import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import browser

PROJECT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(PROJECT / "docs/site"))
sys.dont_write_bytecode = True

import build  # noqa: E402  (these lie in docs/site)
import checks  # noqa: E402

program_path = sys.argv[1]

# What people type, and the pages of which one has to be among the first three.
WORDS = {
    "yield stress": ["docs/glossary", "reference/keys"],
    "restitution": ["docs/glossary", "docs/contact-laws", "reference/keys"],
    "nose_radius": ["reference/keys"],
    "Hertz": ["docs/contact-laws", "docs/theory/contact", "validation/physics/contact_tests"],
    "tolerance": ["docs/glossary"],
    "sweep": ["docs/populations", "docs/glossary"],
    "pandas": ["docs/populations", "reference/python"],
    "zones": ["docs/glossary", "docs/theory/events"],
    "cantilever": ["docs/gallery"],
    "strain": ["docs/files", "reference/columns", "docs/results"],
    "damping": ["docs/glossary", "docs/theory/beam", "reference/keys"],
    "units": ["docs/case-file", "docs/tutorial", "reference/keys"],
    "error bars": ["docs/glossary", "docs/theory/errors"],
    "install": ["docs/library", "docs/populations"],
    "permanent set": ["docs/glossary", "docs/theory/accounts"],
    "gravity": ["reference/keys", "docs/case-file"],
    "peak force": ["docs/glossary"],
    "mesh": ["docs/theory/meshes", "docs/methods", "reference/keys"],
    "timoshenko": ["docs/theory/beam", "docs/model", "validation/physics/timoshenko"],
    "events.csv": ["docs/files", "reference/columns"],
    "peak_force_N": ["docs/files", "reference/columns"],
    "sensitivity": ["reference/commands", "docs/theory/predictability", "docs/files", "reference/python"],
    "velocity": ["reference/keys"],
    "steel": ["docs/gallery", "docs/contact-laws", "docs/case-file"],
    "contact law": ["docs/contact-laws", "docs/glossary", "docs/results"],
    "near miss": ["docs/glossary", "docs/files", "docs/theory/events"],
    "graze": ["docs/glossary", "validation/truth/grazes"],
    "convergence": ["docs/theory/meshes", "docs/theory/errors", "validation/truth/mesh"],
    "cluster": ["docs/populations"],
    "C++": ["docs/library", "reference/cpp"],
    "observer": ["docs/recipes", "reference/cpp/simulate"],
    "gap": ["docs/glossary"],
    "separation": ["docs/glossary", "docs/results"],
    "drop test": ["docs/gallery", "docs/case-file"],
}

SEARCH = """
const input = document.querySelector('.md-search__input');
input.value = arguments[0];
input.dispatchEvent(new KeyboardEvent('keyup'));
"""
# What the search says, and the pages of its hits, best first.
SHOWN = """
return [document.querySelector('.md-search-result__meta').textContent.trim(),
        [...document.querySelectorAll('.md-search-result__item')].map((e) => e.querySelector('a').href)];
"""


class Site(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        directory = pathlib.Path(tempfile.mkdtemp(prefix="subimpact-site-"))
        cls.addClassCleanup(shutil.rmtree, directory)
        cls.site = directory / "site"
        start = time.monotonic()
        cls.built = subprocess.run([PROJECT / "scripts/docs", "--site", cls.site, "--program", program_path],
                                   capture_output=True, text=True, check=False)
        cls.seconds = time.monotonic() - start
        print(f"built in {cls.seconds:.1f} s")
        server = build.server(cls.site, 0)
        cls.addClassCleanup(server.server_close)
        threading.Thread(target=server.serve_forever, daemon=True).start()
        cls.addClassCleanup(server.shutdown)
        cls.address = f"http://127.0.0.1:{server.server_address[1]}/"
        cls.driver = browser.start(reachable="127.0.0.1")
        cls.addClassCleanup(cls.driver.quit)

    def test_has_no_dead_link_and_no_page_that_is_too_long(self):
        self.assertEqual(self.built.returncode, 0, self.built.stderr)

    def shown(self, search, says):
        """The pages of the hits once the search says what is expected of it."""
        self.driver.execute_script(SEARCH, search)
        for _ in range(1200):
            meta, hits = self.driver.execute_script(SHOWN)
            if re.search(says, meta):
                return [hit[len(self.address):].partition("?")[0].partition("#")[0].strip("/") for hit in hits]
            time.sleep(0.05)
        raise AssertionError(f"the search for {search!r} says {meta!r}")

    def test_finds_what_people_type(self):
        missed = []
        self.driver.get(self.address)
        self.driver.find_element("css selector", ".md-search__input").click()
        for word, pages in WORDS.items():
            self.shown("", "Type to start|^$")
            hits = self.shown(word, "matching doc")
            ranks = [i for i, hit in enumerate(hits, 1) if hit in pages]
            print(f"{word:16} rank {ranks[0] if ranks else '-'}  {', '.join(hits[:4])}")
            if not ranks or ranks[0] > 3:
                missed.append(f"{word}: {hits[:5]}")
        self.assertEqual(missed, [])
        self.assertEqual([entry for entry in self.driver.get_log("browser") if entry["level"] == "SEVERE"], [])


class Checks(unittest.TestCase):
    def test_name_what_is_wrong_with_a_page(self):
        page = "<article><p id=here>{}</p><a href='{}'>.</a><img src='{}'></article>"
        with tempfile.TemporaryDirectory() as directory:
            site = pathlib.Path(directory)
            (site / "other").mkdir()
            (site / "picture.svg").write_text("")
            (site / "index.html").write_text(page.format("short", "other/#here", "picture.svg"))
            (site / "other/index.html").write_text(page.format("word " * 2600, "../#there", "https://a.org/b.png"))
            self.assertEqual(checks.faults(site), [
                "other/index.html: no such anchor ../#there", "other/index.html: fetches https://a.org/b.png",
                "other/index.html: 2600 words, more than 2500"])
            (site / "picture.svg").unlink()
            (site / "other/index.html").unlink()
            self.assertEqual(checks.faults(site), [
                "index.html: dead link other/#here", "index.html: dead link picture.svg"])


if __name__ == "__main__":
    browser.skip_unless_there()
    if build.missing():
        print("skipped:", build.missing())
        sys.exit(browser.skipped)
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]], verbosity=2)
