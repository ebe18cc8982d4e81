"""The store of a sweep: damage, truncation, what is no store."""

import errno
import os
import random

import pytest

import subimpact as si
from conftest import tables
from subimpact.sweep.store import FILE, Store
from subimpact.sweep.worker import COLUMNS, Row


def rows(n):
    cells = "," * (len(COLUMNS) - 1)
    return [Row(f"{i:032x}", "completed", f"{i}{cells}", str(i) * 300) for i in range(n)]


def test_rows_come_back_as_they_were(tmp_path):
    with Store(tmp_path) as store:
        store.add(rows(50))
        store.add(rows(60))  # again, and more
    with Store(tmp_path) as store:
        assert sorted(store.rows()) == sorted(rows(60))
        last, first = rows(60)[-1], rows(60)[0]
        assert list(store.rows_of([last.identity, "nothing", first.identity])) == [last, None, first]
        assert store.notes == []


@pytest.mark.parametrize("seed", range(40))
def test_a_damaged_store_is_recovered_or_refused(tmp_path, seed):
    """Bytes overwritten, blocks zeroed or the end cut off: every row that is then read is right."""
    with Store(tmp_path) as store:
        store.add(rows(200))
    path = tmp_path / FILE
    content = bytearray(path.read_bytes())
    chance = random.Random(seed)
    kind = seed % 4
    if kind == 0:
        for _ in range(20):
            content[chance.randrange(len(content))] = chance.randrange(256)
    elif kind == 1:
        start = chance.randrange(len(content))
        content[start:start + 4096] = bytes(len(content[start:start + 4096]))
    elif kind == 2:
        del content[chance.randrange(1, len(content)):]
    else:
        start = chance.randrange(100, len(content))
        content[start:start + 200] = chance.randbytes(len(content[start:start + 200]))
    path.write_bytes(content)
    right = {row.identity: row for row in rows(200)}
    try:
        store = Store(tmp_path)
    except si.StoreError as error:
        assert str(path) in str(error)
        return
    with store:
        found = list(store.rows())
        for row in found:
            assert right[row.identity] == row
        assert list(store.rows_of([row.identity for row in found])) == found
        store.add(rows(200))
        assert len(store.outcomes) == 200
    with Store(tmp_path) as store:
        assert sorted(store.rows()) == sorted(rows(200))


def test_a_sweep_runs_again_what_was_damaged(population, tmp_path):
    si.sweep(population, out=tmp_path, workers=0)
    expected = tables(tmp_path)
    lines = (tmp_path / FILE).read_bytes().splitlines(keepends=True)
    lines[1:6] = [line[:9] + line[9:].replace(b"1", b"2") for line in lines[1:6]]
    (tmp_path / FILE).write_bytes(b"".join(lines))
    sweep = si.sweep(population, out=tmp_path, workers=0)
    assert "5 wrong rows" in sweep.notes[0] and "35 of its rows" in sweep.notes[0]
    assert tables(tmp_path) == expected


@pytest.mark.parametrize("content", [b"run,outcome\n", b"SQLite", b"\0" * 5000])
def test_what_is_no_store_is_refused(tmp_path, content):
    (tmp_path / FILE).write_bytes(content)
    with pytest.raises(si.StoreError, match="no store"):
        Store(tmp_path)
    assert (tmp_path / FILE).read_bytes() == content


@pytest.mark.parametrize("target", ["there", "dangling", "fifo", "directory"])
def test_a_store_that_is_no_file_of_its_own_is_refused(tmp_path, target):
    """A link, dangling or not, is not followed."""
    elsewhere = tmp_path / "elsewhere"
    path = tmp_path / "sweep" / FILE
    path.parent.mkdir()
    if target == "fifo":
        os.mkfifo(path)
    elif target == "directory":
        path.mkdir()
    else:
        path.symlink_to(elsewhere)
    if target == "there":
        elsewhere.write_bytes(b"")
    with pytest.raises(si.StoreError, match="no regular file"):
        Store(tmp_path / "sweep")
    assert elsewhere.exists() == (target == "there")
    assert target != "there" or elsewhere.read_bytes() == b""


def test_a_store_that_cannot_be_begun_is_an_output_error(tmp_path, monkeypatch):
    def full(_):
        raise OSError(errno.ENOSPC, "No space left on device")

    with monkeypatch.context() as disk:
        disk.setattr(os, "fsync", full)
        with pytest.raises(si.OutputError, match="make room"):
            Store(tmp_path)
    with Store(tmp_path) as begun:
        assert begun.outcomes == {}


def test_what_a_full_disk_or_a_kill_left_of_a_row_is_written_over(tmp_path, monkeypatch):
    def full(_):
        raise OSError(errno.ENOSPC, "No space left on device")

    with Store(tmp_path) as store:
        store.add(rows(5))
        with monkeypatch.context() as disk:
            disk.setattr(os, "fsync", full)
            with pytest.raises(si.OutputError, match="make room"):
                store.add(rows(200)[5:])
        store.add(rows(7)[5:])
    with open(tmp_path / FILE, "ab") as file:
        file.write(b"0123abcd [\"torn")
    with Store(tmp_path) as store:
        assert list(store.rows()) == rows(7) and store.notes == []
        store.add(rows(8)[7:])
    with Store(tmp_path) as store:
        assert list(store.rows()) == rows(8) and store.notes == []


def test_an_empty_file_is_an_empty_store(tmp_path):
    (tmp_path / FILE).write_bytes(b"")
    with Store(tmp_path) as store:
        assert store.outcomes == {}
