"""The site of the documentation: staged, built by MkDocs and checked."""

import functools
import http.server
import json
import pathlib
import re
import shutil
import subprocess
import sys

import checks
import reference
from menus import OTHER_WORDS
from stage import Stage

HERE = pathlib.Path(__file__).resolve().parent
MATHJAX = pathlib.Path("/usr/share/javascript/mathjax")  # Debian's libjs-mathjax; without it formulas stay as typed
MATHJAX_PARTS = ["MathJax.js", "config/TeX-AMS_SVG.js", "jax/element", "jax/input/TeX", "jax/output/SVG/jax.js",
                 "jax/output/SVG/autoload", "jax/output/SVG/fonts/TeX", "extensions/TeX", "extensions/tex2jax.js",
                 "extensions/MathMenu.js", "extensions/MathZoom.js"]
PACKAGES = "mkdocs mkdocs-material"


def missing():
    """What has to be installed first, in a line; empty if nothing has."""
    if shutil.which("mkdocs") is None:
        return f"the site needs MkDocs: apt-get install --no-install-recommends {PACKAGES}"
    themes = subprocess.run(["mkdocs", "build", "--help"], capture_output=True, text=True).stdout
    return "" if "material" in themes else f"the site needs MkDocs Material: apt-get install {PACKAGES}"


def add_mathjax(pages):
    """MathJax among the pages, if this machine has it; its scripts, for the configuration."""
    if not (MATHJAX / "MathJax.js").exists():
        print("no libjs-mathjax: formulas are shown as they are typed", file=sys.stderr)
        return []
    for part in MATHJAX_PARTS:
        destination = pages / "mathjax" / part
        destination.parent.mkdir(parents=True, exist_ok=True)
        (shutil.copytree if (MATHJAX / part).is_dir() else shutil.copyfile)(MATHJAX / part, destination)
    shutil.copyfile(HERE / "mathjax.js", pages / "mathjax.js")
    return ["mathjax.js", "mathjax/MathJax.js?config=TeX-AMS_SVG"]


def stage(project, program, python, folder):
    """The pages in folder/pages and mkdocs' configuration in folder; the faults that were found."""
    pages = folder / "pages"
    pages.mkdir(parents=True)
    staged = Stage(project, pages)
    staged.add_project()
    for name in ("keys", "columns", "commands"):
        staged.add(f"reference/{name}.md", getattr(reference, name)(program))
    staged.add("reference/python.md", reference.python_package(python, program.parent.parent / "python", HERE))
    for path, text in reference.headers(project).items():
        staged.add(path, text)
    staged.write()
    shutil.copyfile(HERE / "site.css", pages / "site.css")
    configuration = {"INHERIT": str(project / "mkdocs.yml"), "docs_dir": "pages", "nav": staged.menus(),
                     "extra_javascript": add_mathjax(pages)}
    (folder / "mkdocs.json").write_text(json.dumps(configuration, indent=1))
    return staged.faults


def improve_search(site, pages):
    """Adds to what is searched: meanings of keys beside their names, the last parts of dotted names, and words that
    people use for what a page calls otherwise; these are tags, which weigh most and are not shown. Takes away the
    texts of files."""
    path = site / "search/search_index.json"
    index = json.loads(path.read_text())
    index["docs"] = [entry for entry in index["docs"] if not entry["location"].startswith("source/")]
    keys = (pages / "reference/keys.md").read_text()
    meanings = dict(re.findall(r"(?m)^### `(.+)`\n\n(.*?)(?:;.*)?$", keys))
    words = {checks.address_of(path): others for path, others in OTHER_WORDS.items()}
    for entry in index["docs"]:
        names = re.findall(r"\w+\.(\w+_\w+)", entry["title"])
        if tags := words.get(entry["location"], []) + names:
            entry["tags"] = tags
        if entry["location"].startswith("reference/keys/#") and entry["title"] in meanings:
            entry["title"] += ": " + meanings[entry["title"]]
    path.write_text(json.dumps(index, separators=(",", ":")))


def build(project, program, python, site):
    """Builds the site in a folder, in place of an older one; the faults that were found."""
    site = site.resolve()
    staged = site.with_name(site.name + "-pages")
    for folder, mark in ((site, "sitemap.xml"), (staged, "mkdocs.json")):
        if folder.exists() and not (folder / mark).exists() and any(folder.iterdir()):
            raise SystemExit(f"{folder} exists and is no site; remove it, or name another folder")
    shutil.rmtree(staged, ignore_errors=True)
    staged.mkdir(parents=True)
    (staged / "mkdocs.json").touch()
    faults = stage(project, program, python, staged)
    done = subprocess.run(["mkdocs", "build", "--quiet", "-f", staged / "mkdocs.json", "-d", staged / "site"],
                          capture_output=True, text=True)
    if done.returncode != 0:
        raise SystemExit(f"mkdocs: {done.stderr.strip()}")
    faults += [line for line in done.stderr.splitlines() if "WARNING" in line]
    improve_search(staged / "site", staged / "pages")
    shutil.rmtree(site, ignore_errors=True)
    (staged / "site").rename(site)
    return faults + checks.faults(site)


class Quiet(http.server.SimpleHTTPRequestHandler):
    def log_message(self, *arguments):
        pass


def server(site, port):
    """A server of the site for this machine alone."""
    return http.server.ThreadingHTTPServer(("127.0.0.1", port), functools.partial(Quiet, directory=str(site)))
