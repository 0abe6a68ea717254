"""The shell completes what it cannot know by itself, through the protocol that its own scripts use."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from gcs.cli import completion
from missions.scenario import shipped_scenarios
from planner.find_path import METHODS
from sitl.modes import Mode


def completed(line: str, folder: Path) -> list[str]:
    """What bash is told to offer for the last word of a line."""
    words = line.split(" ")
    environment = os.environ | {
        "_SKEIN_COMPLETE": "complete_bash",
        "COMP_WORDS": "\n".join(words),
        "COMP_CWORD": str(len(words) - 1),
    }
    program = "import sys; sys.argv = ['skein']; from gcs.cli import app; app(prog_name='skein')"
    command = [sys.executable, "-c", program]
    result = subprocess.run(command, capture_output=True, text=True, timeout=60, env=environment, cwd=folder)
    return result.stdout.split()


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """With two runs, and a folder that is none."""
    for name in ("runs/first", "alone"):
        (tmp_path / name).mkdir(parents=True)
        (tmp_path / name / "plan.json").touch()
    (tmp_path / "runs" / "other").mkdir()
    return tmp_path


@pytest.mark.parametrize(
    ("line", "offered"),
    [
        ("skein re", ["rehearse", "report", "replay", "reproduce"]),
        ("skein demo r", ["radars", "ridge"]),
        ("skein fly ", ["alone", "runs/first"]),
        ("skein fly runs/f", ["runs/first"]),
        ("skein rehearse al", ["alone"]),
        ("skein export alone --format k", ["kml"]),
        ("skein mode TA", ["TAKEOFF"]),
        ("skein plan vee --method p", ["pso", "published"]),
        ("skein plan vee --verb", ["--verbose"]),
    ],
)
def test_bash_is_offered(line: str, offered: list[str], folder: Path) -> None:
    assert completed(line, folder) == offered


def test_what_is_offered_is_what_there_is() -> None:
    assert completion.scenarios("") == shipped_scenarios()
    assert completion.methods("") == list(METHODS)
    assert completion.modes("") == list(Mode.__members__)
