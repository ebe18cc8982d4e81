"""Cases: keys, values, messages."""

import copy
import os
import pickle
import re
import threading

import numpy as np
import pytest

import subimpact as si
from conftest import ELASTIC

# A value that each type of key refuses.
WRONG = {"number": "many", "count": 2.5, "flag": "yes", "text": 7, "choice": "no such choice",
         "pair": ["no such choice", "neither"], "numbers": "half", "placed": "half"}


@pytest.mark.parametrize("key", si.keys().values(), ids=lambda key: key.name)
def test_every_key_takes_its_value_and_refuses_others_by_name(key, elastic):
    value = elastic[key.name]
    if value is not None:
        elastic[key.name] = value
        assert elastic[key.name] == value
    with pytest.raises(si.CaseError) as refused:
        elastic[key.name] = WRONG[key.type]
    assert refused.value.key == key.name
    assert str(refused.value).startswith(key.name + " is ")
    with pytest.raises(si.CaseError) as refused:
        elastic[key.name] = object()
    assert refused.value.key == key.name


def test_tables_keys_with_dots_and_a_file_are_one_case(elastic, tmp_path):
    given = elastic.given()
    nested = {}
    for key, value in given.items():
        *tables, leaf = key.split(".")
        place = nested
        for table in tables:
            place = place.setdefault(table, {})
        place[leaf] = value
    elastic.write(tmp_path / "case.toml")
    for other in (si.Case(nested), si.Case(given), si.Case.from_file(tmp_path / "case.toml"),
                  pickle.loads(pickle.dumps(elastic)), copy.copy(elastic)):
        assert other == elastic
        assert other.given() == given


def test_numpy_numbers_and_arrays_are_values(elastic):
    elastic["striker.velocity"] = np.float32(2.5)
    elastic["model.segments"] = np.int64(101)
    elastic["study.pair_detection"] = np.bool_(False)
    elastic["output.points"] = np.array([0.25, 0.75])
    elastic["output.sections"] = ()
    elastic["beam.length"] = np.array(0.5)
    assert elastic["beam.length"] == 0.5
    assert elastic["striker.velocity"] == 2.5
    assert elastic["model.segments"] == 101
    assert elastic["study.pair_detection"] is False
    assert elastic["output.points"] == [0.25, 0.75]
    assert elastic["output.sections"] == []
    elastic.check()


def test_texts_of_any_characters_survive(elastic):
    for title in ('a "b" \\ c', "line\nbreak\t", "größe 𝛼", ""):
        elastic["title"] = title
        assert si.Case.from_text(elastic.to_toml())["title"] == title


def test_a_deleted_key_has_its_default(elastic):
    assert elastic["model.segments"] == 51
    del elastic["model.segments"]
    assert elastic["model.segments"] == 501
    with pytest.raises(si.CaseError, match="unknown key"):
        del elastic["model.segmnts"]


def test_a_copy_changes_by_itself(elastic):
    other = elastic.changed({"striker.velocity": 3.0}, model=dict(segments=61))
    assert (other["striker.velocity"], other["model.segments"]) == (3.0, 61)
    assert (elastic["striker.velocity"], elastic["model.segments"]) == (15.9, 51)
    assert other != elastic


def test_problems_name_place_key_and_remedy():
    with pytest.raises(si.CaseError) as refused:
        si.Case.from_text("[beam]\nlenght = 1\n", "x.toml")
    error = refused.value
    assert (error.key, error.line) == ("beam.lenght", 2)
    assert 'did you mean "beam.length"?' in error.problems[0]
    assert len(error.problems) > 3  # what is missing is named too
    with pytest.raises(si.CaseError, match='did you mean "striker.velocity"') as refused:
        si.Case()["striker.velocty"] = 1.0
    assert refused.value.key == "striker.velocty"
    again = pickle.loads(pickle.dumps(refused.value))
    assert (str(again), again.key) == (str(refused.value), refused.value.key)


def test_what_keys_must_have_together_is_checked_before_a_run(elastic):
    elastic["contact.law"] = "foundation"
    with pytest.raises(si.CaseError) as refused:
        elastic.check()
    assert refused.value.key == "contact.stiffness"
    with pytest.raises(si.CaseError, match="contact.stiffness"):
        si.run(elastic)


def test_a_path_in_place_of_a_case_is_refused_with_the_way_to_read_it():
    for call in (si.Case, si.run, si.sensitivity, si.Plan, lambda path: si.sweep(path, out="none")):
        with pytest.raises(TypeError, match="from_file"):
            call("strike.toml")


def test_explain_and_resolve_are_those_of_the_program(elastic, tmp_path, program):
    elastic.write(tmp_path / "case.toml")
    printed = program("explain", tmp_path / "case.toml").stdout

    def without_times(text):
        return re.sub(r"\S+ (us|ms|s)\b", "", text)

    assert without_times(elastic.explain()) == without_times(printed)
    assert elastic.resolve() == si.run(elastic).summary["used"]


def test_notes_and_doubtful_units(elastic):
    elastic["model.layers"] = 20
    assert any("model.layers" in note for note in elastic.notes())
    elastic["beam.length"] = 711.2
    assert any("beam.length" in warning for warning in elastic.warnings())


@pytest.mark.parametrize("key, value", [
    ("title", "\ud800"), ("output.points", [10**400]), ("solver.events", "\udcff"),
])
def test_values_that_cannot_be_kept_are_refused_by_key(elastic, key, value):
    with pytest.raises(si.CaseError) as refused:
        elastic[key] = value
    assert refused.value.key == key and "allowed: " in str(refused.value)
    with pytest.raises(si.CaseError):
        si.Plan(elastic, {key: [value]})


def test_texts_with_lone_surrogates_are_no_cases(elastic):
    for call in (si.Case({"\ud800": 1}).check, lambda: si.Case.from_text('title = "\ud800"'),
                 lambda: elastic["\ud800"], lambda: elastic.changed({"\ud800": 1})):
        with pytest.raises(si.CaseError):
            call()


def test_a_table_that_holds_itself_is_refused():
    table = {"mass": 1.0}
    table["striker"] = table
    with pytest.raises(si.CaseError, match="nested deeper"):
        si.Case(striker=table)


def test_files_are_read_no_further_than_a_case_can_be_long(tmp_path):
    (tmp_path / "long.toml").write_text("#" * 1_000_001)
    (tmp_path / "latin.toml").write_bytes(b"title = '\xff'")
    for path, words in (("/dev/zero", "larger than 1000000 bytes"), (tmp_path, "is a directory"),
                        (tmp_path / "long.toml", "larger than 1000000 bytes"), ("a\0b", "cannot be read"),
                        (tmp_path / "latin.toml", "no UTF-8"), (tmp_path / "none", "cannot be read")):
        with pytest.raises(si.CaseError, match=words):
            si.Case.from_file(path)


def test_a_case_may_come_through_a_pipe(elastic, tmp_path):
    os.mkfifo(tmp_path / "pipe")
    writer = threading.Thread(target=(tmp_path / "pipe").write_text, args=[ELASTIC])
    writer.start()
    assert si.Case.from_file(tmp_path / "pipe") == elastic
    writer.join()


def test_a_case_becomes_a_dict_of_its_values(elastic):
    assert dict(elastic) == elastic.as_dict() and list(elastic.keys()) == list(elastic)
    known = si.keys()
    assert (known["beam.poisson"].least, known["beam.poisson"].most) == (0.0, 0.5)
    assert known["beam.load"].least is None and known["beam.length"].most is None


def test_identity_depends_on_values_but_not_on_the_title(elastic):
    other = elastic.changed({"title": "another"})
    assert other.identity() == elastic.identity()
    assert other.identity("how") != elastic.identity()
    for key, value in (("striker.velocity", np.nextafter(15.9, 16)), ("output.zone_gap", 0.2)):
        assert elastic.changed({key: value}).identity() != elastic.identity()


def test_whole_floating_point_numbers_are_counts(elastic):
    elastic["model.segments"] = 101.0
    assert repr(elastic["model.segments"]) == "101"
    assert si.Plan(elastic, {"model.segments": np.linspace(51, 101, 3)}).settings(1) == [("model.segments", 76)]
    for value in (101.5, 1e300, float("inf")):
        with pytest.raises(si.CaseError, match="allowed: a whole number"):
            elastic["model.segments"] = value


def test_values_with_a_unit_are_those_of_a_file(elastic):
    elastic["beam.length"] = "500 mm"
    assert elastic["beam.length"] == 0.5
    assert elastic.given()["beam.length"] == 0.5
    assert elastic.changed({"striker.mass": "1 lb"})["striker.mass"] == 0.45359237
    linear = elastic.changed({"contact.law": "linear", "contact.stiffness": "60 MN/m",
                              "beam.springs": [{"position": 0.5, "stiffness": "2 kN/m"}]})
    assert linear["contact.stiffness"] == 60e6
    assert linear["beam.springs"] == [{"position": 0.5, "stiffness": 2000.0}]
    assert si.Case(linear.given()) == linear
    for key, value, words in [("beam.length", "500 mN", "mm"), ("beam.length", "-5 mm", "above 0")]:
        with pytest.raises(si.CaseError, match=words):
            elastic[key] = value
    linear["contact.law"] = "hertz"
    with pytest.raises(si.CaseError, match=r"is in MN/m.*N/m\^1.5"):
        linear.check()


def open_case():
    """A stubby cantilever whose theory is open, though it needs shear."""
    return si.Case(
        beam=dict(material="6082-T6", length=0.1, width=0.03, thickness=0.016, ends=["clamped", "free"]),
        striker=dict(mass=0.16, velocity=0.5, position=0.8), contact=dict(law="hertz", stiffness=2e8),
        model=dict(section="elastic"), time=dict(end=2e-3))


def test_a_key_of_the_mesh_does_not_change_the_model():
    case = open_case()
    assert case.chosen()["beam.theory"] == "timoshenko"
    for changes, mesh in (({"model.elements": 40}, "spectral"), ({"model.segments": 101}, "cells")):
        other = case.changed(changes)
        assert other.chosen() == case.chosen()
        assert other.why_chosen() == case.why_chosen()
        assert other["model.mesh"] == mesh
    with pytest.raises(si.CaseError, match="this scene needs shear") as refused:
        case.changed({"model.mesh": "hermite"}).chosen()
    assert refused.value.key == "model.mesh"
    assert case.changed({"model.mesh": "hermite", "beam.theory": "rayleigh"})["model.mesh"] == "hermite"
