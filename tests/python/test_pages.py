"""The Python of docs/populations.md, executed block after block as a reader would."""

import re
from pathlib import Path

PAGE = Path(__file__).parents[2] / "docs" / "populations.md"


def test_every_block_of_the_page_runs(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("MPLBACKEND", "Agg")
    blocks = re.findall(r"```python\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL)
    assert len(blocks) >= 5
    names = {}
    for block in blocks:
        exec(compile(block, PAGE.name, "exec"), names)
    assert (tmp_path / "map.png").stat().st_size > 1000
    assert len(names["runs"]) == 100 and (names["runs"].outcome == "completed").all()
