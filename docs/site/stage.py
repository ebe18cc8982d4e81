"""Lays the pages of the site out in a folder, for mkdocs: the pages of the project, in their folders, with
links that hold there, and what they link to."""

import json
import pathlib
import re
import shutil

from menus import CUT_AT, MENUS

FENCE = re.compile(r"(?ms)^```.*?^```[ ]*$")
LINK = re.compile(r"\]\(([^)\s]+)\)")
MARK = re.compile(r"<!--.*?-->\n?", re.S)
COPIED = {".svg", ".png", ".gif", ".ipynb", ".csv"}  # as files; other files that are linked become pages
FRONT = "---\nhide: [navigation]\n---\n\n"  # of the first page, which is alone on its menu
LANGUAGES = {".h": "cpp", ".cpp": "cpp", ".py": "python", ".toml": "toml", ".txt": "cmake"}


def slug(heading):
    """The anchor of a heading, as GitHub makes it."""
    return re.sub(r"[^\w\- ]", "", heading.replace("`", "")).strip().lower().replace(" ", "-")


def outside_fences(text, change):
    """The text, changed everywhere but in blocks of code."""
    at, parts = 0, []
    for fence in FENCE.finditer(text):
        parts += [change(text[at:fence.start()]), fence[0]]
        at = fence.end()
    return "".join(parts) + change(text[at:])


def with_lists(text):
    """The text as MkDocs wants lists: an empty line before the first item, paragraphs of items set in by four."""
    lines = []
    for line in text.split("\n"):
        before = lines[-1] if lines else ""
        if re.match(r" {2,3}\S", line) and not before and any(map(is_item, lines[-12:])):
            line = "    " + line.lstrip()
        elif is_item(line) and before and not is_item(before) and not re.match(r" {2,3}\S", before):
            lines.append("")
        lines.append(line)
    return "\n".join(lines)


def is_item(line):
    return re.match(r"([-*]|\d+\.) \S", line) is not None


def headings(text, level=2):
    """(title, position) of the headings of a level, outside blocks of code."""
    blanked = FENCE.sub(lambda fence: " " * len(fence[0]), text)
    return [(found[1].strip(), found.start()) for found in re.finditer(rf"(?m)^#{{{level}}} (.*)$", blanked)]


def title_of(text):
    found = headings(text, 1)
    return re.sub(r"[`*]", "", found[0][0]) if found else ""


def relative(path, page):
    """A path of the site as seen from a page; both from the top."""
    up = len(pathlib.PurePosixPath(page).parent.parts)
    return "../" * up + str(path)


class Stage:
    def __init__(self, project, folder):
        self.project, self.folder = project, folder
        self.texts = {}  # by path from the top of the site
        self.moved = {}  # (page, anchor): the page on which a cut has put it
        self.faults = []

    def add(self, path, text):
        """A page that is written already."""
        self.texts[str(path)] = text

    def add_project(self):
        pages = ["README.md", "CONTRIBUTING.md", "CHANGELOG.md"]
        for folder in ("docs", "validation", "benchmarks"):
            found = (self.project / folder).rglob("*.md")
            pages += sorted(str(path.relative_to(self.project)) for path in found)
        for path in pages:
            self.texts[path] = (self.project / path).read_text()
        for path, titles in CUT_AT.items():
            self.cut(path, titles)

    def cut(self, path, titles):
        text = self.texts[path]
        places = dict(headings(text))
        missing = [title for title in titles if title not in places]
        if missing:
            self.faults.append(f"{path}: has no heading {', '.join(missing)}, where docs/site/menus.py cuts it")
            return
        starts = [places[title] for title in titles] + [len(text)]
        whole = title_of(text)
        self.texts[path] = text[:starts[0]].rstrip() + "\n\n## Further\n\n"
        for title, begin, end in zip(titles, starts, starts[1:]):
            page = str(pathlib.PurePosixPath(path).parent / f"{slug(title)}.md")
            part = text[begin:end]
            rest = outside_fences(part.partition("\n")[2], lambda piece: re.sub(r"(?m)^##(#+ )", r"#\1", piece))
            name = pathlib.PurePosixPath(path).name
            self.texts[page] = f"# {title}\n\nA part of [{whole}]({name}).\n{rest}"
            self.texts[path] += f"- [{title}]({slug(title)}.md)\n"
            for level in (2, 3, 4):
                for heading, _ in headings(part, level):
                    self.moved[path, slug(heading)] = page

    # Links ------------------------------------------------------------------------------------------------

    def write(self):
        """All pages, and what they link to."""
        done = set()
        while remaining := [path for path in self.texts if path not in done]:
            for path in remaining:
                done.add(path)
                text = MARK.sub("", self.texts[path]) if not path.startswith("source/") else self.texts[path]
                text = outside_fences(text, lambda piece, path=path: LINK.sub(
                    lambda found: f"]({self.target(found[1], path)})", with_lists(piece)))
                self.texts[path] = text
                destination = self.folder / path
                destination.parent.mkdir(parents=True, exist_ok=True)
                destination.write_text(("" if path != "README.md" else FRONT) + text)

    def target(self, link, page):
        """What a link of a page becomes."""
        if re.match(r"\w+:", link):
            return link
        name, _, anchor = link.partition("#")
        path = page if not name else self.resolved(name, page)
        if path is None:
            self.faults.append(f"{page}: dead link {link}")
            return link
        path = self.moved.get((path, anchor), path)
        hash_and_anchor = f"#{anchor}" if anchor else ""
        if path == page:
            return hash_and_anchor or pathlib.PurePosixPath(page).name
        return relative(path, page) + hash_and_anchor

    def resolved(self, name, page):
        """The path on the site of what a page calls `name`, which is staged if it is not yet."""
        path = (self.project / pathlib.PurePosixPath(page).parent / name).resolve()
        if not path.is_relative_to(self.project):
            return None
        inside = str(path.relative_to(self.project))
        if inside in self.texts:
            return inside
        if path.is_dir():
            return self.folder_page(path, inside)
        if not path.exists():
            return None
        if path.suffix in COPIED:
            destination = self.folder / inside
            destination.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(path, destination)
            return inside
        source = f"source/{inside}.md"
        if source not in self.texts:
            block = f"```{LANGUAGES.get(path.suffix, '')}\n{path.read_text().rstrip()}\n```"
            self.texts[source] = f"# {inside}\n\n{block}\n"
        return source

    def folder_page(self, path, inside):
        readme = f"{inside}/README.md"
        if readme in self.texts:
            return readme
        if readme.startswith("include"):
            return "reference/cpp/README.md"
        listing = f"source/{inside}/README.md"
        if listing not in self.texts:
            files = sorted(file for file in path.iterdir() if file.is_file() and file.suffix in LANGUAGES)
            up = "../" * len(pathlib.PurePosixPath(listing).parent.parts)
            self.texts[listing] = f"# {inside}\n\n" + "".join(
                f"- [{file.name}]({up}{inside}/{file.name})\n" for file in files)
        return listing

    # Menus ------------------------------------------------------------------------------------------------

    def menu(self, entry):
        if isinstance(entry, dict):
            return [{title: self.menu(part)} for title, part in entry.items()]
        if not entry.endswith("/"):
            return self.with_parts(entry)
        pages = sorted((path for path in self.texts if path.startswith(entry)), key=lambda path: (
            pathlib.PurePosixPath(path).parent, path.rpartition("/")[2] != "README.md"))
        return [{title_of(self.texts[path]) or path: path} for path in pages]

    def with_parts(self, path):
        parts = sorted({page for (whole, _), page in self.moved.items() if whole == path})
        if not parts:
            return path
        return [path, *({title_of(self.texts[part]): part} for part in parts)]

    def menus(self):
        """For mkdocs: lists of one-entry dictionaries."""
        listed = json.dumps(MENUS)
        moved = set(self.moved.values())
        menus = self.menu(MENUS)
        others = [path for path in self.texts
                  if path.startswith("docs/") and f'"{path}"' not in listed and path not in moved]
        use = next(entry["Use"] for entry in menus if "Use" in entry)
        use += [{title_of(self.texts[path]): path} for path in others]
        return menus
