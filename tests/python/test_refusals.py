"""Plans that are none, of whatever kind: one message, status 2, soon, and nothing that a terminal obeys."""

import itertools
import os
import threading

import pytest

import subimpact as si
from conftest import ELASTIC
from subimpact._text import printable
from subimpact._toml import has_deep_key
from subimpact.sweep.__main__ import main
from subimpact.sweep.plan import MOST_CASES, MOST_VALUES

HUGE = "1" + "0" * 400


@pytest.fixture
def refused(tmp_path, monkeypatch, capsys):
    """What the command prints about a plan, which it has to refuse."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "case.toml").write_text(ELASTIC)

    def refuse(text=None, path="plan.toml"):
        if text is not None:
            (tmp_path / path).write_text(text, encoding="utf-8")
        assert main([str(path), "--out", "out", "--workers", "0"]) == 2
        printed = capsys.readouterr()
        assert printed.out == "" and printed.err.startswith("subimpact-sweep: ")
        assert not set(map(chr, [*range(10), *range(11, 32), 127])) & set(printed.err)
        assert not (tmp_path / "out").exists()
        return printed.err

    return refuse


@pytest.mark.parametrize("lines, words", [
    ("axis = 1", "unknown key"), ("samples = 0", "samples"), ('error_bars = "some"', "error_bars"), ("axes.striker.mass = 1", "list"),
    ("axes.striker.mass = {from = 1, to = 2}", "n = 50"), ("[", "no TOML"), ("axes.striker.mas = [1]", "did you mean"),
    ("together = 5", "together is 5"), ("together = [5]", "[[together]]"), ("[[together]]", "differ in length"),
    ("[[together]]\nstriker.mass = [1]\n[[together]]\nstriker.mass = [2]", "two [[together]]"),
    ("set = 5", "begins with [set]"), ("scatter = 5", "begins with [scatter]"),
    ("axes = 5", "begins with [axes]"), ("axes = [1]", "begins with [axes]"),
    (f"samples = {2**64}", "samples is"), (f"seed = {2**64}", f"0 to {2**64 - 1}"),
    ("axes.striker.mass = " + "[" * 200 + "]" * 200, "striker.mass is [["), ("a = " + "[" * 200 + "]" * 200, "unknown key"),
    ("timeout = 1e300", "timeout is 1e+300"), ("timeout = nan", "leave it out"),
    ("a = " + "[" * 5000, "nested deeper"), (".".join(["a"] * 3000) + " = 1", "nested deeper"),
    (".".join(["a"] * 100_000) + " = 1", "nested deeper"),
    ("set." + "a." * 25 + "a = {" + "b." * 25 + "b = 1}", "nested deeper"),
    ("axes." + "a." * 25 + "a = {" + "b." * 25 + "b = [1]}", "nested deeper"),
    ('"\x1b[31m" = 1'.replace("\x1b", "\\u001b"), r"\x1b[31m"),
    ('axes."\\u001b[31m" = [1]', r"\x1b[31m"), ('axes."solver.method" = ["\\u001b"]', r"\x1b"),
    ('set."\\u009b" = 1', r"\xc2\x9b"),
    (f"set.output.points = [{HUGE}]", "output.points"), (f"axes.striker.mass = [{HUGE}]", "striker.mass"),
    (f"axes.striker.mass = {{ from = {HUGE}, to = 2, n = 3 }}", "striker.mass"),
    ("axes.striker.mass = { from = inf, to = 2, n = 3 }", "striker.mass"),
])
def test_what_is_no_plan_is_one_message(refused, lines, words):
    assert words in refused('case = "case.toml"\n' + lines)


@pytest.mark.parametrize("case, words", [
    ("\\u0000", "cannot be read"), ("none.toml", "give the path of a case file"), (".", "is a directory"),
    ("/dev/zero", "larger than 1000000 bytes"), ("\\u001bx", r"\x1bx"),
])
def test_a_case_that_cannot_be_read_is_one_message(refused, case, words):
    assert words in refused(f'case = "{case}"')


def test_a_plan_is_a_file_of_a_plans_size(refused, tmp_path):
    os.mkfifo(tmp_path / "pipe")
    (tmp_path / "long.toml").write_text("#" * 1_000_001)
    for path in ("/dev/zero", "pipe", "."):
        assert "no regular file" in refused(path=path)
    assert "larger than 1000000 bytes" in refused(path="long.toml")
    assert "cannot be read" in refused(path="\x1b[31m")


def test_a_plan_may_come_through_standard_input(elastic, tmp_path):
    elastic.write(tmp_path / "case.toml")
    reading, writing = os.pipe()
    text = f'case = "{tmp_path}/case.toml"\naxes.striker.mass = [1, 2]'
    writer = threading.Thread(target=lambda: (os.write(writing, text.encode()), os.close(writing)))
    writer.start()
    assert len(si.Plan.from_file(f"/dev/fd/{reading}")) == 2
    writer.join()
    os.close(reading)


@pytest.mark.parametrize("lines, key", [
    ("axes.striker.velocity = { from = 1, to = 2, n = 1000000000 }", "striker.velocity has n"),
    ("samples = 100000000\nscatter.striker.mass = 0.1", "samples is 100000000"),
    ("samples = 1000000000000000000\nscatter.striker.mass = 0.1", "samples is"),
    ("samples = 5000001\nscatter.striker.mass = 0.1\naxes.beam.width = [0.1, 0.2]", "2 of beam.width"),
    ("".join(f"axes.{key} = {{ from = 1, to = 2, n = 300 }}\n" for key in (
        "striker.mass", "striker.velocity", "beam.length")), "300 of beam.length"),
])
def test_too_many_cases_are_refused_by_key_before_they_take_memory(refused, lines, key):
    message = refused('case = "case.toml"\n' + lines)
    assert key in message and ("allowed: up to" in message or "allowed: a whole number" in message)


def test_an_axis_without_end_is_refused(elastic):
    with pytest.raises(si.PlanError, match=f"striker.mass has more than {MOST_VALUES} values"):
        si.Plan(elastic, {"striker.mass": itertools.count(1)})


def test_as_many_cases_as_are_allowed_are_a_plan(elastic):
    plan = si.Plan(elastic, {"striker.mass": [1.0, 2.0]}, {"beam.width": 0.1}, samples=MOST_CASES // 2)
    assert len(plan) == MOST_CASES


@pytest.mark.parametrize("values, words", [
    (dict(scatter="abc", samples=1), "scatter is 'abc'"), (dict(scatter={5: 0.1}, samples=1), "place of a key"),
    (dict(scatter={"striker.mass": float("inf")}, samples=1), "above 0"), (dict(axes=[1]), "lists of values"),
    (dict(axes={5: [1]}), "place of a key"), (dict(axes={(): []}), "place of a key"),
    (dict(axes={"\ud800": [1]}), "place of a key"), (dict(timeout=float("nan")), "timeout is nan"),
    (dict(samples=True), "samples is True"), (dict(scatter={"striker.velocity": 0.01}), "without samples"),
    (dict(samples=10), "nothing scatters"), (dict(samples=10, scatter={}), "nothing scatters"),
    (dict(samples=0, scatter={"striker.velocity": 0.01}), "samples is 0"), (dict(seed=-1), "seed is -1"),
    (dict(samples=10, scatter={"striker.velocity": "1 %"}), "scatter of striker.velocity"), (dict(timeout=0.0), "timeout is 0"),
    (dict(error_bars="some"), "error_bars"), (dict(axes={"striker.velocity": 3.0}), "a list of values"),
    (dict(axes={"solver.method": "erk"}), "a list of values"), (dict(axes={"striker.velocty": [1.0]}), "did you mean"),
    (dict(axes={("beam.width", "beam.thickness"): [0.01, 0.02]}), "tuples of 2 values"),
    (dict(axes={("beam.width", "beam.thickness"): [(0.01,)]}), "2 values"), (dict(axes={"striker.velocity": []}), "no values"),
    (dict(axes={"striker.velocity": [1.0], ("striker.velocity",): [(2.0,)]}), "two axes"),
    (dict(axes={"striker.velocity": [1.0, -1.0]}), "0 or above"), (dict(scatter={"beam.theory": 0.01}, samples=1), "no number"),
    (dict(scatter={"beam.yield_stress": 0.01}, samples=1), "no finite value"), (dict(scatter={"striker.mass": -0.01}, samples=1), "above 0"),
    (dict(scatter={"beam.length": 5}, samples=1), "up to 0.5"), (dict(axes={"beam.length": ["200 g"]}), '"g" is none of its units'),
    (dict(axes={"contact.stiffness": ["2 kN/m"]}), "write the number without a unit"),
])
def test_arguments_that_are_no_plan_are_refused(elastic, values, words):
    with pytest.raises(ValueError, match=words):
        si.Plan(elastic, **values)


@pytest.mark.parametrize("only", [(-1, None), (5, 2), (5, 5), (0,), 5, (0, 2.5)])
def test_a_part_that_is_none_is_refused(elastic, only, tmp_path):
    with pytest.raises(si.PlanError, match="only is"):
        si.sweep(elastic, out=tmp_path / "out", only=only)
    assert not (tmp_path / "out").exists()


def test_dots_of_strings_and_comments_are_none(tmp_path):
    many = "." * 100
    for text in (f'a = "{many}"', f"a = '{many}'", f'a = """\n{many}\n"""', f"a = '''\n{many}'''", f"# {many}",
                 f'a = "\\"{many}"', 'a = "b"\n' * 100, "a.b = [[1], [2]]\n" * 100):
        assert not has_deep_key(text)
    for text in ("." * 33, 'a = "b"\n' + "a." * 33, "a = '" + "\n" + "a." * 33):
        assert has_deep_key(text)


def test_control_characters_are_printed_as_the_program_prints_them(program):
    for text in ("\x1b[31m", "\x7f", "\x9b", "größe"):
        done = program("explain", text, status=2)
        assert printable(text) in done.stderr and printable(printable(text)) == printable(text)
    assert printable("a\n\tb\udcff\ud800") == "a\n\tb\\xff\\xed\\xa0\\x80"
