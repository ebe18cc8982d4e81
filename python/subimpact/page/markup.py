"""Pieces of a page: escaped texts, tiles, tables, figures, and the whole around them."""

from __future__ import annotations

import html
import json
import re
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from string import Template
from typing import Any

from .._text import printable

WEB = Path(__file__).parent / "web"
DYGRAPHS = "/usr/share/javascript/dygraphs"

_ACTIVE = re.compile(
    r"""<(script|foreignObject|iframe|image|a|style)\b|\son\w+\s*=|href\s*=\s*["'][^#]|url\((?!#)|<!ENTITY""", re.IGNORECASE)
_NO_XML = re.compile("[\ufffe\uffff]")


def web(name: str) -> str:
    return (WEB / name).read_text(encoding="utf-8")


def escaped(text: object) -> str:
    return html.escape(_NO_XML.sub("\ufffd", printable(str(text))))


def in_print(text: object) -> str:
    """Words with units and signs as they are set in print, escaped: "12 us +- 1" becomes "12 µs ± 1"."""
    return escaped(re.sub(r" u([sm])(?![0-9A-Za-z])", r" µ\1", str(text)).replace("+-", "±"))


def filled(name: str, fields: Mapping[str, str]) -> str:
    return Template(web(name)).substitute(fields)


def tiles(answers: Iterable[tuple[str, str, str]]) -> str:
    return "".join(f"<div><span>{escaped(label)}</span><b>{in_print(value)}</b>"
                   + (f"<small>{in_print(note)}</small>" if note else "") + "</div>\n" for label, value, note in answers)


def paragraphs(texts: Iterable[str], kind: str = "", before: str = "") -> str:
    mark = f' class="{kind}"' if kind else ""
    return "".join(f"<p{mark}>{before}{in_print(text)}.</p>\n" for text in texts if text)


def headlines(lines: Iterable[tuple[bool, str, str]]) -> str:
    """A line each: whether it is certain, about what, words."""
    return "".join(f'<li class="{"certain" if certain else "not"}"><b>{escaped(about)}</b> {in_print(words)}</li>\n'
                   for certain, about, words in lines)


def table(heading: Sequence[str], rows: Iterable[Sequence[object]], name: str = "") -> str:
    head = "".join(f"<th>{escaped(name)}</th>" for name in heading)
    body = "".join("<tr>" + "".join(f"<td>{in_print(cell)}</td>" for cell in row) + "</tr>\n" for row in rows)
    mark = f' id="{name}"' if name else ""
    return f'<div class="wide"><table class="keys"{mark}><thead><tr>{head}</tr></thead><tbody>\n{body}</tbody></table></div>\n'


def is_still(svg: str) -> bool:
    """Whether an SVG file is a picture and nothing more: results may come from anywhere."""
    return svg.startswith("<") and "<svg" in svg and not _ACTIVE.search(svg)


def inlined(svg: str, prefix: str) -> str:
    """An SVG file as an element of a page: without prologue and name spaces, its ids not shared with other figures."""
    text = svg[svg.index("<svg"):]
    text = re.sub(r' xmlns(?::xlink)?="[^"]*"', "", text).replace("xlink:href", "href")
    return re.sub(r"""(\bid=["']|href=["']#|url\(#)""", rf"\g<1>{prefix}-", text)


def figures(drawn: Iterable[tuple[str, str, str]]) -> str:
    """Figures with captions: name, caption, SVG file."""
    return "".join(
        f'<figure class="still" id="figure-{escaped(name)}" role="img" aria-label="Figure {number}. {escaped(caption)}">'
        f"{inlined(svg, escaped(name))}<figcaption><b>Figure {number}.</b> {escaped(caption)}</figcaption></figure>\n"
        for number, (name, caption, svg) in enumerate(drawn, 1))


def charts(directory: str) -> tuple[str, str, str]:
    """dygraphs, which draws zoomable charts: its script, its style, and why both are missing and what to do."""
    try:
        script, style = (Path(directory, name).read_text(encoding="utf-8") for name in ("dygraph.min.js", "dygraph.css"))
    except (OSError, ValueError):
        return "", "", (f"{directory} has no dygraph.min.js and dygraph.css; install dygraphs (Debian: apt-get install "
                        "libjs-dygraphs), or name the directory that holds both (--dygraphs DIR), and write this page again")
    return _within(script), _within(style), ""


def _within(text: str) -> str:
    """A text that ends neither its element nor its character data, and names no other file."""
    text = re.sub(r"//# sourceMappingURL[^\n]*", "", text, count=1)
    return text.replace("</script", "<\\/script").replace("]]>", "]] >").replace("</style", "<\\/style")


def data_element(data: Any) -> str:
    """Data for the scripts of a page, without < > and &."""
    text = json.dumps(data, separators=(",", ":"), allow_nan=False)
    for character in "<>&":
        text = text.replace(character, f"\\u{ord(character):04x}")
    return f'<script type="application/json" id="data">{text}</script>\n'


def whole(title: str, body: str, style: str = "", data: str = "", scripts: Iterable[str] = ()) -> str:
    elements = "".join(f"<script>/*<![CDATA[*/\n{script}\n/*]]>*/</script>\n" for script in scripts)
    return filled("page.html", {"title": escaped(title), "style": web("report.css") + style, "dark": web("dark.css"), "body": body,
                                "data": data, "scripts": elements})
