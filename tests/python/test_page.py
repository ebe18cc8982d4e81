"""Pages of runs, made of their files."""

import ast
import base64
import csv
import hashlib
import html
import json
import re
import shlex
import shutil

import subprocess
import sys
import xml.etree.ElementTree as xml
from pathlib import Path

import numpy as np
import pytest

import subimpact as si
from conftest import ELASTIC, YIELDING
from subimpact import _files
from subimpact.page import markup, numbers
from subimpact.page.run import page

PACKAGE = Path(markup.__file__).parents[1]
OF_PAGES = [*sorted((PACKAGE / "page").glob("*.py")), *(PACKAGE / name for name in ("__init__.py", "_files.py", "_errors.py", "_text.py"))]


def page_of(directory, dygraphs="/nowhere", measured=""):
    """The page of a run, which is valid XML with every id once."""
    text = page(_files.Files(directory), dygraphs, measured)
    ids = [e.get("id") for e in xml.fromstring(text.replace("<!DOCTYPE html>", "")).iter() if e.get("id")]
    assert sorted(ids) == sorted(set(ids))
    return text


def data_of(text):
    return json.loads(re.search(r'<script type="application/json" id="data">(.*?)</script>', text, re.DOTALL)[1])


def unpacked(column):
    """As web/data.js does it."""
    kind = next(iter(column))
    return np.frombuffer(base64.b64decode(column[kind]), "<f8" if kind == "f64" else "<f4")


def reseal(directory):
    """Makes the manifest list the files as they are now."""
    manifest = json.loads((directory / "manifest.json").read_text())
    for name in manifest["files"]:
        content = (directory / name).read_bytes()
        manifest["files"][name] = {"bytes": len(content), "sha256": hashlib.sha256(content).hexdigest()}
    (directory / "manifest.json").write_text(json.dumps(manifest))


def change(directory, file, edit):
    """Another content of a file of JSON, listed as if a run had written it."""
    content = json.loads((directory / file).read_text())
    edit(content)
    (directory / file).write_text(json.dumps(content))
    reseal(directory)


@pytest.fixture(scope="module")
def kept(tmp_path_factory):
    """Directories of an elastic and of a yielding strike."""
    place = tmp_path_factory.mktemp("runs")
    elastic = si.Case.from_text(ELASTIC).changed({"title": 'Beam <A> & "B"', "output.gauges": [{"position": 0.3}]})
    elastic.run(error_bars="off", out=place / "elastic")
    si.Case.from_text(YIELDING).changed({"output.shapes": 1e-4}).run(out=place / "yielding")
    return place


@pytest.fixture
def copy(kept, tmp_path):
    """A copy of one of them, to be changed."""

    def of(name):
        return Path(shutil.copytree(kept / name, tmp_path / name))

    return of


def test_a_page_needs_nothing_from_outside(kept):
    text = page_of(kept / "elastic")
    for word in ("http:", "https:", "src=", "<link", "@import", "<img", "<iframe", 'url("', "url('", "file:"):
        assert word not in text
    assert "default-src 'none'" in text and "Beam &lt;A&gt; &amp; &quot;B&quot;" in text


def test_python_alone_makes_the_page_of_a_run(kept, tmp_path):
    block = ("import sys\nfor name in ('numpy', 'subimpact._core', 'matplotlib', 'pandas'): sys.modules[name] = None\n"
             f"sys.path.insert(0, {str(PACKAGE.parent)!r})\nfrom subimpact.page.__main__ import main\n"
             f"sys.exit(main(['--out', {str(tmp_path)!r}, {str(kept / 'yielding')!r}]))")
    subprocess.run([sys.executable, "-S", "-c", block], check=True)
    assert (tmp_path / "report.html").stat().st_size > 100_000


def test_python_3_9_understands_what_makes_pages():
    for path in OF_PAGES:
        ast.parse(path.read_text(encoding="utf-8"), feature_version=(3, 9))
    assert len(OF_PAGES) > 8


def test_the_history_has_every_column_to_the_digits_of_floats(kept):
    data, result = data_of(page_of(kept / "elastic")), si.read_results(kept / "elastic")
    assert list(data["history"]) == list(result.history.dtype.names)
    assert list(data["meanings"]) == list(result.history.dtype.names)[1:]
    assert data["meanings"]["force_N"] == "contact force" and len(data["gauges"]) == 1
    np.testing.assert_array_equal(unpacked(data["history"]["time_s"]), result.history["time_s"])
    for name in data["meanings"]:
        np.testing.assert_array_equal(unpacked(data["history"][name]), result.history[name].astype("f4"), name)


def test_shapes_are_those_of_the_run_to_a_millionth_of_the_largest(kept):
    shapes, result = data_of(page_of(kept / "yielding"))["shapes"], si.read_results(kept / "yielding").shapes
    np.testing.assert_array_equal(unpacked(shapes["times"]), np.unique(result["time_s"]))
    n = len(unpacked(shapes["positions"]))
    whole = np.zeros((len(unpacked(shapes["times"])), n))
    whole[:, shapes["plastic_points"]] = unpacked(shapes["plastic"]).reshape(len(whole), -1)
    assert len(shapes["plastic_points"]) > 0
    for found, column in ((unpacked(shapes["moment"]), "moment_Nm"), (unpacked(shapes["displacement"]), "displacement_m"),
                          (whole.ravel(), "plastic_curvature_per_m")):
        np.testing.assert_allclose(found, result[column], rtol=0, atol=1e-7 * np.abs(result[column]).max())


def test_a_long_table_keeps_its_extremes_its_last_row_and_few_others():
    rows = [[str(k), "0", "0", ""] for k in range(300_000)]
    rows[123_457][1], rows[200_001][2] = "5e3", "-1e-3"
    kept = list(numbers.thinned(iter(rows), len(rows)))
    assert len(kept) < 25_000 and rows[123_457] in kept and rows[200_001] in kept
    assert kept[0] == rows[0] and kept[-1] == rows[-1]
    assert [float(row[0]) for row in kept] == sorted(float(row[0]) for row in kept)
    assert list(numbers.thinned(iter(rows[:1000]), 1000)) == rows[:1000]


def test_the_page_of_a_long_history_states_what_it_leaves_out(copy):
    directory = copy("elastic")
    heading, *rows = (directory / "history.csv").read_text().splitlines()
    times = 1 + 30_000 // len(rows)
    later = [",".join([repr(float(row.split(",")[0]) + k), *row.split(",")[1:]]) for k in range(times) for row in rows]
    (directory / "history.csv").write_text("\n".join([heading, *later]) + "\n")
    change(directory, "summary.json", lambda summary: summary["counts"].update(history_rows=len(later)))
    text = page_of(directory)
    assert f"Of {len(later)} rows the charts have" in text
    assert unpacked(data_of(text)["history"]["force_N"]).max() == si.read_results(directory).history["force_N"].astype("f4").max()


class Shapes:
    """600 shapes of 3001 points, of which `lines` is all that a page needs."""

    def lines(self, _):
        yield ["time_s", "position_m", "displacement_m", "moment_Nm", "plastic_curvature_per_m"]
        for k in range(600):
            for i in range(3001):
                yield [f"{k}e-6", repr(i / 3000), "1", "2", "0"]


def test_of_many_fine_shapes_those_at_events_and_the_struck_point_are_kept():
    shapes, points, n = numbers.shapes(Shapes(), 3001, 600 * 3001, 0.30001, [{"time": 317e-6}])
    assert list(unpacked(shapes["times"])).count(317e-6) == 1
    assert n < 410 and len(points) < 610 and 900 in points and points[-1] == 3000
    assert len(json.dumps(shapes)) < 3e6 and shapes["plastic_points"] == []


def test_data_end_no_script():
    assert not set("<>&") & set(markup.data_element({"a": "</script><!--&"})[42:-10])


def test_every_number_of_the_summary_is_listed(kept):
    text, summary = page_of(kept / "yielding"), json.loads((kept / "yielding" / "summary.json").read_text())
    flat = {f"{table}.{name}": value for table in ("used", "counts", "maxima", "final", "final_energies", "work", "conservation")
            for name, value in summary[table].items()}
    scalars = {name: value for name, value in flat.items() if isinstance(value, (int, float)) and "contact_stiffness" not in name}
    assert len(scalars) > 40
    for name, value in scalars.items():
        assert f"<code>{name}</code></td><td>{json.dumps(value)}</td>" in text, name


def test_the_table_of_sub_impacts_has_doubts_and_a_row_each(copy):
    directory = copy("yielding")
    hits = list(csv.DictReader(open(directory / "events.csv")))
    text = page_of(directory)
    assert text.count("<tr data-hit") == len(hits)
    assert text.count('class="uncertain" title=') == sum(hit["certain"] == "0" for hit in hits)
    (directory / "events.csv").write_text(
        (directory / "events.csv").read_text().replace("\n2,", "\n2,", 1))
    def spoil(report):
        report["sub_impacts"]["rows"][0] = {"certain": False, "cells": ["<b>1?</b>"] * len(report["sub_impacts"]["columns"])}
    change(directory, "report.json", spoil)
    assert "<td>&lt;b&gt;1?&lt;/b&gt;</td>" in page_of(directory)


def test_what_is_certain_and_what_is_not_comes_first(kept, copy):
    before = page_of(kept / "elastic").partition('class="tiles')[0]
    assert "Not certain:</b> errors are not known" in before and "certainty not known" in before
    directory = copy("yielding")

    def fail(summary):
        summary["outcome"].update(kind="unstable", message="it grows & grows")
        summary["warnings"] = ["beam.length is 711 m <long>"]

    change(directory, "summary.json", fail)
    change(directory, "report.json", lambda report: report.update(caveat="unstable: results up to 100 us passed"))
    banner = page_of(directory).partition('class="tiles')[0]
    for words in ("unstable: results up to 100 µs passed", "it grows &amp; grows", "beam.length is 711 m &lt;long&gt;", "1 warning"):
        assert words in banner


def test_micro_and_plus_minus_are_set_in_print():
    assert markup.in_print("12 us +- 1, 5 usual, 3 um") == "12 µs ± 1, 5 usual, 3 um".replace("3 um", "3 µm")


def test_figures_are_those_drawn_of_the_run_and_not_changed_since(copy):
    directory = copy("elastic")
    place, identity = directory / "figures", json.loads((directory / "manifest.json").read_text())["identity"]
    place.mkdir()
    svg = ('<?xml version="1.0"?>\n<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"><defs>'
           '<path id="m1" d="M0 0"/></defs><use xlink:href="#m1" clip-path="url(#m1)"/></svg>')
    files = {"a.svg": svg, "b.svg": svg, "active.svg": "<svg onload='run()'/>", "figures.json": json.dumps(
        {"figures": [{"name": name, "caption": f"<{name}>."} for name in ("a", "b", "active")], "left_out": ["c: no data"]})}
    manifest = {"subimpact_manifest": 1, "kind": "figures", "identity": identity, "commit": "1" * 32, "files": {}, "replaced": {}}
    for name, content in files.items():
        (place / name).write_text(content)
        manifest["files"][name] = {"bytes": len(content), "sha256": hashlib.sha256(content.encode()).hexdigest()}
    (place / "manifest.json").write_text(json.dumps(manifest))
    text = page_of(directory)
    for words in ('href="#a-m1"', "url(#a-m1)", 'id="b-m1"', "Figure 2.</b> &lt;b&gt;.", "Not drawn: active: has no SVG file",
                  "Not drawn: c: no data"):
        assert words in text
    (place / "b.svg").write_text("<svg/>")
    assert "Not drawn: b: has no SVG file, or one that was changed" in page_of(directory)
    (place / "manifest.json").write_text(json.dumps({**manifest, "identity": "2"}))
    assert "None: <code>subimpact plot</code> draws them" in page_of(directory)


@pytest.mark.parametrize("svg", ["<svg><script/></svg>", "<svg><image href='x'/></svg>", "<svg><a href='http://x'/></svg>", "no",
                                 "<svg><path style='fill: url(http://x)'/></svg>", "<svg><g ONCLICK = 'x'/></svg>"])
def test_a_picture_that_does_something_is_none(svg):
    assert not markup.is_still(svg) and markup.is_still("<svg><path d='M0 0'/></svg>")


def test_the_library_of_charts_is_in_the_page_or_how_to_get_it(kept, tmp_path):
    (tmp_path / "dygraph.min.js").write_text("a[b[0]]>1;'</script>';\n//# sourceMappingURL=dygraph.min.js.map\nlast()")
    (tmp_path / "dygraph.css").write_text(".dygraph {}")
    text = page_of(kept / "elastic", tmp_path)
    assert "a[b[0]] >1;'<\\/script>';\n\nlast()" in text and ".dygraph {}" in text and "charts are missing" not in text
    assert "apt-get install libjs-dygraphs" in page_of(kept / "elastic", tmp_path / "none")


def test_repeated_strikes_are_all_in_a_table_and_a_chart_with_the_command_that_opens_each(elastic, tmp_path, program):
    elastic.changed({"repeat.strikes": 3, "time.end": 5e-4}).run(error_bars="off", out=tmp_path / "of three")
    text = page_of(tmp_path / "of three")
    assert "Of 3 strikes this page shows the last" in text and "Of 3" not in page_of(tmp_path / "of three").replace("Of 3 strikes", "")
    commands = [html.unescape(found) for found in re.findall(r'<tr data-strike="(.*?)">', text)]
    drawn = data_of(text)["strikes"]
    assert len(commands) == len(drawn) == 3 and all(force > 0 for _, force, _ in drawn)
    program(*shlex.split(commands[1].partition(" && ")[0])[1:], "--error-bars=off")
    second = si.read_results(tmp_path / "of three-strike-2")
    assert second.sub_impacts["peak_force_N"].max() == pytest.approx(drawn[1][1], rel=1e-12)


def test_answers_are_those_of_the_screen_with_both_errors(kept):
    result, text = si.read_results(kept / "yielding"), page_of(kept / "yielding")
    printed = " ".join(result.report().split())
    assert markup.in_print(result.verdict["text"]) in text and result.verdict["text"] in printed
    known = [answer for answer in result.answers if answer["known"] and answer["key"] != "zones"]
    assert len(known) > 8
    for answer in known:
        assert f"<span>{answer['label']}</span><b>{markup.in_print(answer['text'])}</b>" in text, answer["key"]
    force = next(answer for answer in known if answer["total_text"])
    assert re.search(f"real beam: ± {force['total_text']}, mostly [^;]*; computed: ± {force['error_text']}", text)
    total = float(force["total_text"]) / float(force["body_text"]) * force["body_error"]
    assert total == pytest.approx(np.hypot(force["error"], force["body_error"]), rel=0.1)
    for part in force["parts"]:
        assert markup.escaped(f"{part['label']} {part['text']}") in text and (not part["remedy"] or markup.in_print(part["remedy"]) in text)


REFUSALS = {
    "it was changed or cut short since": lambda d: (d / "history.csv").write_text((d / "history.csv").read_text() + "\n"),
    "is not the file that the run wrote": lambda d: (d / "events.csv").write_text(""),
    "has no manifest.json of a run": lambda d: (d / "manifest.json").unlink(),
    "is not a manifest of this program": lambda d: (d / "manifest.json").write_text("[]"),
    "a later version of this program wrote it": lambda d: change_text(d / "manifest.json", '"subimpact_manifest": 1', '"subimpact_manifest": 9'),
    "has layout 3, but this program reads layout": lambda d: change(d, "summary.json", lambda s: s.update(layout=3)),
    "is not the summary of a run": lambda d: ((d / "summary.json").write_text("[" * 100_000), reseal(d)),
    "no run of this version has written": lambda d: change(d, "summary.json", lambda s: s.update(counts=[])),
    "has no report.json": lambda d: ((d / "report.json").unlink(), change_manifest(d, "report.json")),
    "is not among the results": lambda d: change_manifest(d, "summary.json"),
    "it is no regular file": lambda d: ((d / "summary.json").unlink(), (d / "summary.json").mkdir()),
}


def change_text(path, old, new):
    assert old in path.read_text()
    path.write_text(path.read_text().replace(old, new))


def change_manifest(directory, without):
    manifest = json.loads((directory / "manifest.json").read_text())
    del manifest["files"][without]
    (directory / "manifest.json").write_text(json.dumps(manifest))


@pytest.mark.parametrize("words", REFUSALS)
def test_damage_is_refused_in_one_line_with_file_and_remedy(words, copy, program):
    directory = copy("elastic")
    REFUSALS[words](directory)
    errors = program("report", directory, status=2).stderr
    assert words in errors and str(directory) in errors and errors.count("\n") == 1
    assert not (directory / "report.html").exists()
    if words not in ("no run of this version has written", "has no report.json"):
        with pytest.raises(si.ResultsError):
            si.read_results(directory)


def test_layouts_are_those_that_the_program_writes(kept):
    for name, layout in _files.LAYOUTS.items():
        assert json.loads((kept / "elastic" / name).read_text())["layout"] == layout


def test_no_directory_and_no_python_are_refused_in_one_line(kept, program, monkeypatch, tmp_path):
    assert "is not a directory; give the output directory" in program("report", tmp_path / "nothing", status=2).stderr
    assert not (tmp_path / "nothing").exists()
    old = tmp_path / "python3"
    for content, words in (("#!/nowhere\n", "cannot be run"), ("", "cannot be run")):
        old.write_text(content)
        monkeypatch.setenv("SUBIMPACT_PYTHON_EXECUTABLE", str(old))
        errors = program("report", kept / "elastic", status=2).stderr
        assert words in errors and "python3-subimpact" in errors and errors.count("\n") == 1


def test_a_python_that_is_too_old_is_named(kept, program, monkeypatch, tmp_path):
    old = tmp_path / "python3"
    old.write_text(f"#!{sys.executable}\nimport sys\nsys.version_info = (3, 8, 1)\nsys.argv = sys.argv[2:]\nexec(sys.argv[0])\n")
    old.chmod(0o755)
    monkeypatch.setenv("SUBIMPACT_PYTHON_EXECUTABLE", str(old))
    errors = program("report", kept / "elastic", status=2).stderr
    assert "is Python 3.8; this command needs Python 3.9 or later" in errors


def test_files_that_are_not_yet_in_their_place_are_found(copy):
    directory = copy("elastic")
    commit = json.loads((directory / "manifest.json").read_text())["commit"]
    (directory / f".subimpact-{commit}").mkdir()
    (directory / "events.csv").rename(directory / f".subimpact-{commit}" / "events.csv")
    assert page_of(directory).count("<tr data-hit") == len(si.read_results(directory).sub_impacts)


def test_a_page_beside_the_run_is_among_its_files(copy, program):
    directory = copy("elastic")
    assert f"{directory}/report.html" in program("report", directory).stdout
    assert "report.html" in json.loads((directory / "manifest.json").read_text())["files"]
    si.read_results(directory)
