"""Screen, files, page and Python show the same answers, as text."""

import random
import re

import pytest

import subimpact as si
from conftest import README_STRIKE
from subimpact.page.markup import in_print

TEMPLATES = ("hammer", "ball-drop", "cantilever", "stop", "repeated-strikes", "tube", "rollers", "ensemble")


def random_scene(seed):
    """A scene of the kinds that people have; a short run."""
    draw = random.Random(seed)
    ends = draw.choice(["free,free", "pinned,pinned", "clamped,free", "clamped,clamped"]).split(",")
    beam = {"length": draw.uniform(0.2, 1.0), "width": draw.uniform(0.01, 0.05), "thickness": draw.uniform(3e-3, 2e-2),
            "density": draw.choice([2700, 7850]), "youngs_modulus": draw.choice([70e9, 210e9])}
    text = "\n".join(f"{key} = {value:.4g}" for key, value in beam.items())
    if draw.random() < 0.6:
        text += f"\nyield_stress = {draw.uniform(1e8, 4e8):.3g}"
    nose = draw.choice(["sphere", "cylinder"])
    return f"""
time.end = {draw.uniform(1e-4, 4e-4):.3g}
scene.gravity = {draw.choice([0, 9.81])}
striker = {{ mass = {draw.uniform(0.05, 1.0):.3g}, nose = "{nose}", nose_radius = 0.01, velocity = {draw.uniform(0.5, 15):.3g} }}
[beam]
ends = ["{ends[0]}", "{ends[1]}"]
{text}
"""


def strike(case, program, directory):
    """The screen of a run, its page, and the run as Python reads it."""
    (directory / "case.toml").write_text(case)
    screen = program("run", directory / "case.toml", "--out", directory / "run", "--all").stdout
    program("report", directory / "run")
    return screen, (directory / "run/report.html").read_text(), si.read_results(directory / "run")


def check(screen, page, result):
    """Every text of the answers stands on screen and page, and no other number in the table of the screen."""
    words = " ".join(screen.split())
    assert result.verdict["text"] in words
    table = screen[screen.index("+- computed"):].split("\n\n")[0].split("\n")[1:]
    rows = [row for row in table if row]
    assert rows
    shown = {answer["label"]: answer for answer in result.answers if answer["known"]}
    zones = shown["zones"]["items"]
    for row in rows:
        if zone := re.match(" +zone ([0-9]+) +(.*)", row):
            item = zones[int(zone[1]) - 1]
            assert " ".join(zone[2].split()) == f"{item['begin_text']} {item['error_text']} {item['body_text']}"
            continue
        label = max((label for label in shown if row.strip().startswith(label)), key=len)
        answer = shown[label]
        rest = " ".join(row.strip()[len(label):].split())
        part = answer["parts"][0]["label"] if answer["parts"] and answer["parts"][0]["change"] != 0 else ""
        assert rest == " ".join(f"{answer['text']} {answer['error_text']} {answer['body_text']} {part}".split())
    assert in_print(result.verdict["text"]) in page
    for answer in result.answers:
        if answer["known"] and answer["key"] != "zones":
            body = f"+- {answer['total_text']}" if answer["total_text"] else answer["body_text"]
            errors = [f"real beam: {body}", f"computed: +- {answer['error_text']}"] if answer["error_text"] else [""]
            shown_errors = "[^<]*".join(re.escape(in_print(each)) for each in errors)
            assert re.search(f">{re.escape(in_print(answer['text']))}</b><small>[^<]*{shown_errors}", page)
        assert answer["known"] == (answer["value"] is not None) == (answer["why"] is None)


@pytest.mark.parametrize("template", TEMPLATES)
def test_a_template_has_the_same_answers_on_the_screen_in_files_and_in_python(template, program, tmp_path):
    case = program("new", template).stdout.replace("strikes = 10 ", "strikes = 2 ")
    check(*strike(case, program, tmp_path))


@pytest.mark.parametrize("seed", range(8))
def test_a_random_scene_has_the_same_answers_on_the_screen_and_in_files(seed, program, tmp_path):
    check(*strike(random_scene(seed), program, tmp_path))


def test_a_run_made_in_python_has_the_answers_of_the_program(program, tmp_path):
    screen, page, loaded = strike(README_STRIKE, program, tmp_path)
    check(screen, page, loaded)
    made = si.run(si.Case.from_text(README_STRIKE, "case.toml"))
    assert made.answers == loaded.answers
    assert made.verdict == loaded.verdict
    lines = screen[: screen.index("peak force")].rstrip().split("\n")
    assert len(lines) <= 27  # the last is the heading of the sub-impacts
