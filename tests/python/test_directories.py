"""The directory of a sweep: sealed, locked, and of one kind."""

import hashlib
import json

import pytest

import subimpact as si
from conftest import tables
from subimpact.sweep import tables as module


def manifest(directory):
    return json.loads((directory / "manifest.json").read_text())


@pytest.fixture
def swept(population, tmp_path):
    """A sweep of four cases in a directory, and a function that sweeps other ones."""

    def sweep(*masses):
        axes = {"striker.mass": masses, "striker.velocity": [1.0, 2.0]}
        return si.sweep(population.case, axes, out=tmp_path / "out", workers=0)

    sweep(0.1, 0.2)
    return tmp_path / "out", sweep


def test_both_tables_are_sealed_as_one(swept):
    directory, sweep = swept
    first = manifest(directory)
    assert first["kind"] == "sweep" and set(first["files"]) == {"base.toml", "runs.csv", "sub_impacts.csv"}
    for name, seal in first["files"].items():
        assert seal["sha256"] == hashlib.sha256((directory / name).read_bytes()).hexdigest()
    sweep(0.4)
    assert manifest(directory)["identity"] != first["identity"]
    names = {path.name for path in directory.iterdir()}
    assert names == {"base.toml", "manifest.json", "runs.csv", "sub_impacts.csv", "sweep.rows"}


def test_foreign_files_are_kept_and_links_are_not_followed(swept):
    directory, sweep = swept
    (directory / "sub_impacts.csv").unlink()
    (directory / "sub_impacts.csv").symlink_to(directory.parent / "elsewhere")
    (directory / "manifest.json").unlink()  # from here on no file is the program's
    (directory / "runs.csv").write_text("mine")
    sweep(0.1, 0.2)
    assert (directory / "runs.csv.kept").read_text() == "mine"
    assert not (directory.parent / "elsewhere").exists()
    assert not (directory / "sub_impacts.csv").is_symlink()


def test_the_directory_of_a_run_takes_no_sweep(population, tmp_path):
    si.run(population.case, error_bars="off", out=tmp_path)
    before = {path.name: path.read_bytes() for path in tmp_path.iterdir()}
    with pytest.raises(si.StoreError, match="subimpact run"):
        si.sweep(population, out=tmp_path, workers=0)
    assert {path.name: path.read_bytes() for path in tmp_path.iterdir()} == before


def test_the_directory_of_a_sweep_takes_no_run(swept, elastic):
    directory, _ = swept
    with pytest.raises(si.OutputError, match="sweep"):
        si.run(elastic, error_bars="off", out=directory)


def test_links_in_place_of_temporary_files_are_not_followed(population, tmp_path):
    """The names that older versions wrote to, too."""
    out = tmp_path / "out"
    out.mkdir()
    for name in (".lock", ".runs.csv.new", ".subimpact-lock", ".sweep.h5.new"):
        (out / name).symlink_to(tmp_path / f"elsewhere{name}")
    with pytest.raises(si.StoreError, match="cannot be written to"):
        si.sweep(population, out=out, workers=0)
    (out / ".subimpact-lock").unlink()
    si.sweep(population, out=out, workers=0)
    assert [path.name for path in tmp_path.iterdir()] == ["out"]


def test_a_sweep_that_fails_leaves_the_tables_before(swept, monkeypatch):
    directory, sweep = swept
    before = tables(directory)

    def fail(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(module, "_write_rows", fail)
    with pytest.raises(si.OutputError, match="No space left on device.*make room"):
        sweep(0.4)
    assert tables(directory) == before
    assert not list(directory.glob(".subimpact-*"))


def test_hdf5_goes_with_its_tables_and_with_no_others(swept):
    pytest.importorskip("h5py")
    directory, sweep = swept
    done = sweep(0.1, 0.2)
    done.write_hdf5()
    done.write_hdf5()  # again
    assert set(manifest(directory)["files"]) == {"base.toml", "runs.csv", "sub_impacts.csv", "sweep.h5"}
    sweep(0.4)
    assert not (directory / "sweep.h5").exists()
    with open(directory / "runs.csv", "a") as file:
        file.write("more\n")
    with pytest.raises(si.StoreError, match="runs.csv: is not the file that the run wrote.*run the sweep again"):
        done.write_hdf5()
    (directory / "manifest.json").write_text("[]")
    with pytest.raises(si.StoreError, match="manifest.json: is not a manifest of this program"):
        done.write_hdf5()
