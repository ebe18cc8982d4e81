"""Figures: what they show, and the files that `subimpact plot` writes."""

import json
import os
import re
import subprocess
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import numpy as np
import pytest

matplotlib = pytest.importorskip("matplotlib")
matplotlib.use("Agg")

import subimpact as si
from conftest import ELASTIC, PROGRAM, YIELDING
from subimpact import plot
from subimpact.plot import __main__ as command
from subimpact.plot.style import COLOURS, unit

STABILITY = Path(__file__).parents[2] / "validation/truth/stability"
OF_RUN = ["response", "first-sub-impact", "indentation", "energies", "timeline", "bending", "shapes", "envelope"]


@pytest.fixture(scope="module")
def run():
    return si.run(si.Case.from_text(YIELDING, "yielding.toml").changed({"time.end": 1e-3}))


@pytest.fixture(scope="module")
def directory(run, tmp_path_factory):
    """A run, and its figures as the program draws them."""
    path = tmp_path_factory.mktemp("plot") / "run"
    run.write(path)
    done = subprocess.run([PROGRAM, "plot", path, "--format", "svg"], capture_output=True, text=True, check=True)
    assert done.stderr == "" and f"figures in {path}/figures" in done.stdout and "response.svg\n    Contact" in done.stdout
    return path


def words(axes):
    return " ".join(text.get_text() for text in np.ravel(axes)[0].figure.findobj(matplotlib.text.Text))


def table(**columns):
    return {name: np.array(values) for name, values in columns.items()}


def grid(**columns):
    """Six runs over two keys."""
    return table(**{"run": range(6), "striker.mass": [0.1, 0.1, 0.1, 0.2, 0.2, 0.2], "striker.velocity": [1.0, 2.0, 4.0] * 2,
                    "outcome": ["completed"] * 5 + ["unstable"], "n_sub_impacts": [1.0, 2.0, 1.0, 13.0, 2.0, 9.0], **columns})


def test_every_figure_of_a_run_is_drawn_and_listed_with_its_caption(directory):
    listed = json.loads((directory / "figures/figures.json").read_text(encoding="utf-8"))
    assert [figure["name"] for figure in listed["figures"]] == OF_RUN and listed["failed"] == listed["left_out"] == []
    assert all(figure["caption"].endswith(".") for figure in listed["figures"])
    assert {file.name for file in (directory / "figures").iterdir()} == {
        "figures.json", "manifest.json", *(f"{name}.svg" for name in OF_RUN)}


def test_svg_files_are_small_xml_with_text_as_text_and_no_date(directory):
    for name in OF_RUN:
        file = directory / "figures" / f"{name}.svg"
        text = file.read_text(encoding="utf-8")
        ids = [element.get("id") for element in ElementTree.parse(file).iter() if element.get("id")]
        assert len(text) < 60_000 and len(ids) == len(set(ids)) and "<style" not in text and "<metadata" not in text
        assert set(re.findall(r"(?:#|\()#?(m[0-9a-f]{10})", text)) <= set(ids)
    assert "contact force, kN" in (directory / "figures/response.svg").read_text(encoding="utf-8")


def test_the_page_of_a_run_holds_its_figures(directory, program):
    program("report", directory)
    page = (directory / "report.html").read_text(encoding="utf-8")
    assert page.count('class="still"') == len(OF_RUN) and "contact force, kN" in page


def test_one_figure_drawn_again_is_the_same_to_the_byte_and_the_others_stay(directory):
    file = directory / "figures/timeline.svg"
    before, listed = file.read_bytes(), (directory / "figures/figures.json").read_bytes()
    assert command.main([str(directory), "--only", "timeline", "--format", "svg"]) == 0
    assert file.read_bytes() == before and (directory / "figures/figures.json").read_bytes() == listed


def test_formats_and_names_are_those_asked_for_in_directories_of_any_name(directory, program, tmp_path):
    out = tmp_path / "-rf \n\"$HOME `id` ;'"
    program("plot", directory, f"--out={out}", "--only", "first-sub-impact", "--format", "png,pdf")
    assert sorted(file.suffix for file in out.glob("first*")) == [".pdf", ".png"]


def test_figures_of_another_run_are_removed_and_runs_are_not_mixed_with_them(directory, tmp_path):
    other = si.run(si.Case.from_text(ELASTIC, "elastic.toml").changed(
        {"output.interval": 0.0, "output.shapes": 0.0, "output.sections": [], "output.points": []}))
    other.write(tmp_path / "other")
    out = str(tmp_path / "out")
    assert command.main([str(directory), "--out", out, "--only", "first-sub-impact", "--format", "svg"]) == 0
    drawn = plot.draw_directory(tmp_path / "other", out, ["svg"])
    assert list(drawn.captions) == ["timeline"] and not os.path.exists(out + "/first-sub-impact.svg")
    assert any(reason.startswith("response: the run kept no history; run it again") for reason in drawn.left_out)
    with pytest.raises(si.OutputError, match="holds the results of another run"):
        plot.draw_directory(directory, tmp_path / "other", ["svg"])


def test_wrong_input_ends_with_status_2_and_says_what_is_allowed(directory, program, capsys):
    assert "nowhere: is not a directory" in program("plot", "nowhere", status=2).stderr
    assert command.main([str(directory), "--only", "respnse"]) == 2
    with pytest.raises(SystemExit, match="2"):
        command.main([str(directory), "--format", "gif"])
    said = capsys.readouterr().err
    assert "respnse: no figure of" in said and "allowed: svg, png, pdf" in said


def test_without_matplotlib_the_program_says_what_to_install(directory, tmp_path):
    (tmp_path / "matplotlib.py").write_text("raise ModuleNotFoundError(\"No module named 'matplotlib'\")")
    done = subprocess.run([PROGRAM, "plot", directory], capture_output=True, text=True,
                          env={**os.environ, "PYTHONPATH": str(tmp_path)})
    assert done.returncode == 2 and done.stderr.count("\n") == 1 and "apt-get install" in done.stderr


def test_a_figure_that_fails_is_named_and_the_others_are_drawn(directory, tmp_path, monkeypatch, capsys):
    from subimpact.plot import directory as drawing

    monkeypatch.setitem(drawing._OF_RUN, "energies", lambda result: 1 / 0)
    out = tmp_path / "out"
    assert command.main([str(directory), "--out", str(out), "--format", "svg", "--only", "energies,timeline"]) == 3
    assert "energies: cannot be drawn (ZeroDivisionError" in capsys.readouterr().err
    assert (out / "timeline.svg").exists() and not (out / "energies.svg").exists()


def test_curves_are_the_columns_of_the_history_in_the_units_of_the_axes(run):
    top, bottom = plot.response(run)
    history = run.history
    np.testing.assert_array_equal(top.lines[0].get_xydata(), np.c_[1e3 * history["time_s"], 1e-3 * history["force_N"]])
    np.testing.assert_array_equal(bottom.lines[1].get_ydata(), 1e3 * history["w_m_m"])
    assert bottom.get_xlabel() == "time, ms" and bottom.get_ylabel() == "displacement, mm"


def test_gauges_have_a_figure_where_there_are_any(run, tmp_path):
    with pytest.raises(plot.Absent, match="output.gauges"):
        plot.gauges(run)
    case = si.Case.from_text(ELASTIC, "e.toml").changed({"time.end": 1e-4, "output.gauges": [{"position": "0.2 m"}, {"position": 0.5, "face": "front"}]})
    struck = si.run(case, error_bars="off")
    axes = plot.gauges(struck)
    np.testing.assert_array_equal(axes.lines[1].get_ydata(), 1e6 * struck.history["gauge_2_strain"])
    assert "back, 0.2 m" in words(axes) and "front, " in words(axes) and axes.get_ylabel() == "strain, µm/m"
    struck.write(tmp_path / "run")
    assert "gauges" in plot.draw_directory(tmp_path / "run", formats=["svg"]).captions


def test_axes_that_are_given_are_drawn_into(run):
    axes = matplotlib.figure.Figure().add_subplot()
    assert run.plot(axes) is axes and plot.force(run, axes) is axes and len(axes.lines) == 2


def test_uncertain_sub_impacts_are_told_apart_and_counted_above(run):
    n = int((run.sub_impacts["certain"] == 0).sum())
    axes = plot.timeline(run)
    hollow = [line for panel in axes for line in panel.lines if line.get_markerfacecolor() == "white"]
    assert n > 0 and sum(len(line.get_xdata()) for line in hollow) == 2 * n
    assert f"{n} of {len(run.sub_impacts)} sub-impact" in words(axes)
    assert any(bars.get_hatch() for bars in plot.force(run).collections)


def test_a_run_that_did_not_complete_says_so_above_its_panels(run):
    class Failed(si.Result):
        outcome, first_failure = "solver-failed", (1e-4, 1.5e-4)

    said = words(plot.timeline(Failed(run._run)))
    assert "solver failed at 1 ms\nfirst failure between 100 and 150 µs" in said


def test_strikes_that_end_in_contact_have_a_figure_without_restitution():
    case = si.Case.from_text(ELASTIC, "e.toml").changed({"repeat.strikes": 2, "time.end": 1e-5, "output.shapes": 0.0})
    axes = plot.strikes(si.run(case, error_bars="off"))
    assert "in contact at the end of every strike" in words(axes)


def test_a_map_has_the_number_of_every_cell_and_tells_one_from_two():
    axes = plot.sweep_map(grid(all_certain=[1, 1, 0, 1, 1, 1]))
    assert [text.get_text() for text in axes.texts] == ["1", "2", "1", "13", "2"]  # the unstable one is grey
    mesh = axes.collections[0]
    assert mesh.to_rgba(1) != mesh.to_rgba(2) and axes.get_xlabel() == "striker.velocity, m/s"
    assert any(bars.get_hatch() for bars in axes.collections)
    for other, hatched in (({"restitution_error": [0.01, 0.2, np.nan, 0, 0.01, 0.01]}, True), ({"restitution_error": [0.01] * 6}, False),
                           ({"warnings": ["", "rotations", "", "", "", ""]}, True), ({"warnings": [np.nan] * 6}, False)):
        axes = plot.sweep_map(grid(all_certain=[1, 1, 0, 1, 1, 1], restitution=[0.5] * 6, **other), column="restitution")
        assert any(bars.get_hatch() for bars in axes.collections) == hatched  # by the doubt of what it shows, not of counts
    with pytest.raises(plot.Absent, match="two keys"):
        plot.sweep_map(grid(**{"striker.mass": [0.1] * 6}))


def test_what_a_figure_does_not_draw_is_refused_with_what_it_draws(run):
    for draw, source, words in ((plot.sweep_map, run, "sweep_map.. has a Result; allowed: the runs of a sweep"),
                                (plot.response, si.Case(), "response.. has a Case; allowed: a subimpact.Result")):
        with pytest.raises(TypeError, match=words):
            draw(source)


def test_a_histogram_marks_mean_and_quantiles():
    forces = 1e3 * np.arange(101.0)
    axes = plot.histogram({"max_force_N": forces}, None, "max_force_N")
    assert axes.lines[0].get_xdata()[0] == pytest.approx(50) and axes.get_xlabel() == "max force, kN" and "5 %: 5, 95 %: 95" in axes.get_title()
    assert sum(bar.get_height() for bar in axes.containers[0]) == 101 and axes.get_title().startswith("101 of 101 runs")
    some = plot.histogram({"restitution": np.where(forces < 3e4, forces, np.nan)}, None, "restitution")
    assert some.get_title().startswith("30 of 101 runs")
    with pytest.raises(TypeError, match="column="):
        plot.histogram({"max_force_N": forces}, "max_force_N")


def test_studies_are_drawn_of_their_tables(tmp_path):
    drawn = plot.draw_directory(STABILITY, tmp_path, ["svg"])
    assert list(drawn.captions) == ["outcomes"]
    assert ">bdf, order up to 2<" in (tmp_path / "outcomes.svg").read_text(encoding="utf-8")


def test_work_precision_fills_no_mark_below_the_error_of_the_reference_and_tells_wrong_and_failed_runs_apart():
    points = table(label=["elastic section"] * 5, method=["erk"] * 5, kind=["rtol"] * 5,
                   verdict=["right", "right", "wrong count", "unstable", "refused"],
                   max_error_s=[1e-9, 1e-14, 1e-7, np.nan, np.nan], odd_duration_s=[np.nan, np.nan, 3e-6, np.nan, np.nan],
                   reference_error_s=[1e-12] * 5, observed_order=[np.nan] * 5, wall_s=[0.2, 0.3, 0.1, 0.1, np.nan])
    axes = plot.work_precision(points)
    marks = [(line.get_marker(), line.get_markerfacecolor(), list(line.get_xdata())) for line in axes.lines
             if line.get_linestyle() == "None" and len(line.get_xdata())]
    assert [(mark, face) for mark, face, _ in marks] == [("o", COLOURS[0]), ("o", "white"), ("x", COLOURS[0]), ("x", COLOURS[0])]
    np.testing.assert_allclose([x for _, _, (x,) in marks[:3]], [1e-3, 1e-8, 3.0])  # where they are; the last: lost or invented
    assert marks[3][2][0] > 3 and axes.get_xlim()[0] <= 1e-8


def test_no_two_curves_of_fourteen_methods_look_alike():
    names = [f"erk:{k}" for k in range(14)]
    n = len(names)
    points = table(label=["a"] * n, method=names, kind=["rtol"] * n, verdict=["right"] * n, max_error_s=[1e-9] * n,
                   odd_duration_s=[np.nan] * n, reference_error_s=[1e-12] * n, observed_order=[np.nan] * n, wall_s=[0.1] * n)
    lines = plot.work_precision(points).get_legend().get_lines()[:n]
    assert len({(line.get_color(), line.get_marker()) for line in lines}) == n


def test_studies_of_methods_are_tables_in_python_and_their_figures(tmp_path):
    case = si.Case.from_text(ELASTIC, "e.toml").changed({"time.end": 1e-3})
    runs, matches = si.compare(case, ["nystrom", "erk:verner"])
    assert list(runs["method"]) == ["nystrom", "erk:verner"] and (runs["max_end_difference_s"] < 1e-9).all()
    assert set(matches["method"]) == {"nystrom", "erk:verner"} and plot.differences(matches).get_yscale() == "log"
    points = si.work_precision(case, ["erk:dormand-prince"], point_seconds=0.2)
    assert set(points["kind"]) == {"rtol", "step"} and plot.work_precision(points) is not None
    outcomes = si.stability(case, ["central-difference"])
    assert {"right", "refused"} <= set(outcomes["verdict"]) and len(plot.outcomes(outcomes)) == 2
    with pytest.raises(si.CaseError, match="leapfrog"):
        si.compare(case, ["leapfrog"])


def test_a_comparison_and_a_sensitivity_have_figures(tmp_path, program):
    (tmp_path / "e.toml").write_text(ELASTIC)
    case = tmp_path / "e.toml"
    for arguments, name in ((("compare", case, "--methods", "erk"), "differences"),
                            (("sensitivity", case, "--by", "striker.velocity"), "sensitivity")):
        program(*arguments, "--set", "time.end=3e-4", "--out", tmp_path / name)
        assert list(plot.draw_directory(tmp_path / name, formats=["svg"]).captions) == [name]


def test_a_table_that_is_cut_short_is_refused(tmp_path):
    (tmp_path / "runs.csv").write_text("run,outcome\n1,completed\n2\n")
    with pytest.raises(si.ResultsError, match="runs.csv"):
        plot.draw_directory(tmp_path)


def test_units_suit_the_largest_value():
    assert unit("force", [10.0, -2e3]) == ("kN", 1e-3) and unit("length", [2e-6]) == ("µm", 1e6)
    assert unit("time", 8e-3) == ("ms", 1e3)
