"""Long work shows itself on standard error: at once, and how far it is."""

import io
import subprocess
import sys
from pathlib import Path

import pytest
from rich.console import Console

from gcs.cli import output
from gcs.cli.progress import working


def test_a_demo_speaks_before_it_loads_anything_heavy(tmp_path: Path) -> None:
    (tmp_path / "taken").mkdir()
    (tmp_path / "taken" / "file").touch()
    command = [sys.executable, "-X", "importtime", "-m", "gcs.main", "demo", "--out", tmp_path / "taken"]
    result = subprocess.run(command, capture_output=True, text=True, timeout=100)
    assert result.returncode == 2
    assert result.stdout == ""
    lines = [line.rpartition("|")[2].strip() for line in result.stderr.splitlines()]  # the last: a module's name
    spoke = lines.index("Loading planner and simulation")
    for heavy in ("numba", "numpy", "scipy", "planner.plan", "missions.scenario"):
        assert spoke < lines.index(heavy), heavy


def test_away_from_a_terminal_work_is_a_plain_line(monkeypatch: pytest.MonkeyPatch) -> None:
    written = io.StringIO()
    monkeypatch.setattr(output, "progress", Console(file=written))
    with working("Counting [geese]", count=3) as bar:
        bar.advance("Counting ducks")
        bar.show(2, 3, note="soon")
    assert written.getvalue() == "Counting [geese]\n"


def test_on_a_terminal_work_shows_its_count_and_the_time_left_and_goes(monkeypatch: pytest.MonkeyPatch) -> None:
    written = io.StringIO()
    monkeypatch.setattr(output, "progress", Console(file=written, force_terminal=True, width=80))
    with working("Counting [geese]", count=40, done=10) as bar:
        assert "Counting [geese]" in written.getvalue()
        for _ in range(3):
            bar.advance()
    shown = written.getvalue()
    assert "13/40" in shown
    assert " left" in shown
    assert "Counting" not in shown.rpartition("\r")[2]


def test_work_that_nobody_can_count_shows_how_long_it_has_taken(monkeypatch: pytest.MonkeyPatch) -> None:
    written = io.StringIO()
    monkeypatch.setattr(output, "progress", Console(file=written, force_terminal=True, width=80))
    with working("Loading"):
        pass
    assert "0:00 so far" in written.getvalue()
    assert "0/" not in written.getvalue()
