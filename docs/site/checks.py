"""What a built site is checked for: dead links, pages that are too long to read, anything from elsewhere."""

import html.parser
import posixpath
import re
import urllib.parse

from menus import LISTINGS, MOST_WORDS

SKIPPED = {"script", "style", "pre", "svg"}  # in which no words are counted


class Page(html.parser.HTMLParser):
    """Anchors, links, foreign parts and the number of words of a page."""

    def __init__(self, text):
        super().__init__()
        self.anchors, self.links, self.foreign = {""}, set(), set()
        self.words = 0
        self.inside = []  # of those that count for words
        self.article = False
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        self.anchors.update(value for name in ("id", "name") if (value := values.get(name)))
        if tag == "a" and values.get("href"):
            self.links.add(values["href"])
        for name in ("src", "href"):
            if tag in ("img", "script", "link", "iframe") and values.get(name) and values.get("rel") != "canonical":
                (self.foreign if re.match(r"(https?:)?//", values[name]) else self.links).add(values[name])
        if tag == "article":
            self.article = True
        if tag in SKIPPED:
            self.inside.append(tag)

    def handle_endtag(self, tag):
        if tag == "article":
            self.article = False
        if self.inside and self.inside[-1] == tag:
            self.inside.pop()

    def handle_data(self, data):
        if self.article and not self.inside:
            self.words += len(re.findall(r"\S*\w\S*", data))


def dead_links(pages, files):
    for path, page in pages.items():
        for link in sorted(page.links):
            parts = urllib.parse.urlsplit(link)
            if parts.scheme or parts.netloc:
                continue
            name = urllib.parse.unquote(parts.path)
            target = posixpath.normpath(posixpath.join(posixpath.dirname(path), name)) if name else path
            if name.endswith("/") or target in (".", "") or name in (".", ".."):
                target = posixpath.normpath(posixpath.join(target, "index.html"))
            if target not in files:
                yield f"{path}: dead link {link}"
            elif target in pages and urllib.parse.unquote(parts.fragment) not in pages[target].anchors:
                yield f"{path}: no such anchor {link}"


def address_of(path):
    """The address on the site of a page of the project."""
    return path.removesuffix("README.md") if path.endswith("README.md") else path.removesuffix(".md") + "/"


def source_of(path):
    """The path of the page in the project; folders are README.md."""
    folder = posixpath.dirname(path)
    return (folder + ".md" if folder else "README.md"), posixpath.join(folder, "README.md")


def is_listing(path):
    return any(name.startswith(listing) for name in source_of(path) for listing in LISTINGS)


def read(site):
    return {str(path.relative_to(site)): Page(path.read_text()) for path in site.rglob("*.html")
            if "mathjax" not in path.parts and path.name != "404.html"}


def faults(site):
    """The faults of a site, a line each."""
    pages = read(site)
    files = {str(path.relative_to(site)) for path in site.rglob("*") if path.is_file()}
    found = list(dead_links(pages, files))
    for path, page in sorted(pages.items()):
        found += [f"{path}: fetches {link}" for link in sorted(page.foreign)]
        if page.words > MOST_WORDS and not is_listing(path):
            found.append(f"{path}: {page.words} words, more than {MOST_WORDS}")
    return found
