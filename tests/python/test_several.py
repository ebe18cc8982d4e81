"""Pages of sweeps and of several runs."""

import csv
import json
import math
import re
import xml.etree.ElementTree as xml

import numpy as np
import pytest

import subimpact as si
from subimpact._files import Files
from subimpact._core import matched
from subimpact.page import several
from subimpact.page.several import n_leading


def well_formed(text):
    xml.fromstring(text.replace("<!DOCTYPE html>", ""))
    assert "<script" not in text and "http:" not in text and "https:" not in text
    return text


def sweep_page(directory, runs):
    directory.mkdir(exist_ok=True)
    (directory / "runs.csv").write_text(runs)
    (directory / "sub_impacts.csv").write_text("run\n")
    return well_formed(several.sweep_page(Files(directory)))


HEADING = "run,striker.mass,striker.velocity,outcome,n_sub_impacts,all_certain,message\n"
THREE = HEADING + "0,0.1,1,completed,7,1,\n1,0.2,1,completed,9,0,\n2,0.3,1,</script>,,,why\n"


def test_the_page_of_a_sweep_states_first_what_is_certain(tmp_path):
    text = sweep_page(tmp_path / 'a"<script>`b`', THREE)
    for words in ("count and order of the sub-impacts in 1 of 3 runs.", "the counts of 1 run, which the map hatches",
                  "1 run with the outcome &quot;&lt;/script&gt;&quot;", "<b>7 to 9</b>", "3 different, 0.1 to 0.3 kg",
                  "Sweep: " + str(tmp_path), "a&quot;&lt;script&gt;`b`", "<td>why</td>", "--set striker.mass=0.1"):
        assert words in text, words


def test_a_sweep_without_error_bars_is_not_certain(tmp_path):
    text = sweep_page(tmp_path / "sweep", THREE.replace("all_certain", "other"))
    assert "the sweep was made without error bars" in text


@pytest.mark.parametrize("runs, words", [(HEADING, "has no run yet"), ("", "has no run yet"), (THREE + "3,1\n", "runs.csv:5: has 2 cells"),
                                         (THREE.replace("outcome", "end"), "has no column outcome")])
def test_tables_that_no_sweep_writes_are_refused(tmp_path, runs, words):
    with pytest.raises(si.ResultsError, match=re.escape(words)):
        sweep_page(tmp_path / "sweep", runs)


def test_a_sweep_has_maps_histograms_and_all_its_runs(population, tmp_path, program):
    si.sweep(population.case, {"striker.mass": [0.1, 0.2, 0.4], "striker.velocity": [1.0, 2.0, 4.0]}, out=tmp_path / "out", workers=0)
    assert "sweep.html" in program("report", tmp_path / "out").stdout
    text = well_formed((tmp_path / "out" / "sweep.html").read_text())
    assert 'id="figure-map-n_sub_impacts"' in text and 'id="figure-histograms"' in text
    assert text.partition('id="runs"')[2].count("<tr>") == 10
    assert "<td>largest force</td>" in text.partition("the base case</h2>")[2].partition("<h2>")[0]
    with open(tmp_path / "out" / "runs.csv") as file:
        forces = [float(row["max_force_N"]) for row in csv.DictReader(file)]
    row = re.search(r"<tr><td>max_force_N</td>(.*?)</tr>", text)[1]
    assert f"<td>9</td><td>{np.mean(forces):.6g} ± " in row and f"<td>{np.std(forces, ddof=1):.4g}</td>" in row and ", of 9 runs" in row
    assert "sweep.html" in json.loads((tmp_path / "out" / "manifest.json").read_text())["files"]
    with open(tmp_path / "out" / "runs.csv", "a") as file:
        file.write("more\n")
    assert "changed or cut short" in program("report", tmp_path / "out", status=2).stderr


def test_warnings_of_a_sweep_are_counted_by_kind_on_its_page():
    (certain, _, words), = several._warnings({"warnings": np.array(["", "rotations", "rotations;units"])}, 3)
    assert not certain and words.startswith("rotations in 2, units in 1 of 3 runs") and not several._warnings({"warnings": np.full(3, np.nan)}, 3)


@pytest.fixture
def runs(elastic, tmp_path):
    elastic["time.end"] = 5e-4
    elastic.run(out=tmp_path / "a<b")
    elastic.changed({"striker.velocity": 16.0}).run(out=tmp_path / "second")
    return [str(tmp_path / name) for name in ("a<b", "second")]


def test_runs_are_compared_by_keys_answers_curves_and_sub_impacts(runs):
    text = well_formed(several.comparison_page(runs))
    for words in ("a&lt;b", "<td>striker.velocity</td><td>15.9 m/s</td><td>16.0 m/s</td>", "Sub-impacts of B compared with those of A",
                  "correspond one to one", 'id="figure-comparison"', "<td>time to compute</td>"):
        assert words in text, words
    assert "<td>striker.mass</td>" not in text
    same = well_formed(several.comparison_page([runs[0]] * 2))
    assert "None: the cases are the same." in same and "+0.0000" in same


def test_the_program_plots_and_reports_several_runs(runs, tmp_path, program):
    assert "comparison.html" in program("report", *runs, "--out", tmp_path / "both").stdout
    program("plot", *runs, "--out", tmp_path / "figures", "--format", "svg")
    assert (tmp_path / "figures" / "comparison.svg").exists()
    for command in ("report", "plot"):
        assert "--out DIR" in program(command, *runs, status=2).stderr


def test_sub_impacts_correspond_that_overlap_each_other_most():
    def hits(*times):
        return np.array([*times], [("start_s", "f8"), ("end_s", "f8")])

    a = hits((0, 1), (2, 3), (4, math.nan))
    assert matched(a, a) == [(0, 0), (1, 1), (2, 2)] and n_leading(matched(a, a)) == 3
    assert matched(a, hits((0, 1.1), (1.5, 1.6), (2, 3.1))) == [(0, 0), (None, 1), (1, 2), (2, None)]
    assert matched(a, hits((0, 3))) == [(0, 0), (1, None), (2, None)]  # merged
    assert n_leading(matched(a, a[1:])) == 0 and matched(hits(), a[:1]) == [(None, 0)]


def test_a_result_in_files_is_the_one_that_was_written(elastic, tmp_path):
    result = elastic.run(out=tmp_path)
    read = si.read_results(tmp_path)
    assert (read.outcome, read.time, read.usable, read.n_certain, read.all_certain, read.warnings, read.message, read.first_failure) == (
        result.outcome, result.time, result.usable, result.n_certain, result.all_certain, result.warnings, result.message,
        result.first_failure)
    assert read.report() == result.report() and repr(read) == repr(result)
    assert read.summary == result.summary and read.case == result.case
    for key in si.keys():
        assert read[key] == result[key], key
    for table in ("sub_impacts", "transitions", "supports", "history", "sections", "points", "shapes", "envelope", "strikes"):
        one, other = getattr(result, table), getattr(read, table)
        assert one.dtype == other.dtype and len(one) == len(other) and not other.flags.writeable, table
    with pytest.raises(KeyError):
        read["beam"]
    read.write(tmp_path / "again")
    np.testing.assert_array_equal(si.read_results(tmp_path / "again").history["force_N"], result.history["force_N"])
