"""What used to be told wrongly, or not at all."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from typer.testing import Result

from gcs.cli.station import chosen_sysids
from gcs.cli.tables import flight_table
from gcs.figures import style
from gcs.truth import write_truths
from missions.errors import InputError
from missions.formats.mission_file import read_mission_file

FULL = Path("/dev/full")
needs_full_device = pytest.mark.skipif(not FULL.exists(), reason="no such device there")


@pytest.mark.parametrize("text", ["3-", "-3", "1,4-", "2--4", ""])
def test_half_a_range_of_vehicles_is_refused(text: str) -> None:
    with pytest.raises(InputError, match="--vehicle"):
        chosen_sysids(text)


@needs_full_device
def test_a_full_disk_is_told_with_the_file(tmp_path: Path) -> None:
    for name in ("1.f64", "scene.png"):
        (tmp_path / name).symlink_to(FULL)
    with pytest.raises(OSError, match="No space left") as of_truth:
        write_truths({1: np.zeros((5000, 6))}, tmp_path)
    assert of_truth.value.filename == str(tmp_path / "1.f64")
    with pytest.raises(OSError, match="No space left") as of_picture, style.page(tmp_path / "scene.png", 3.0):
        pass
    assert of_picture.value.filename == str(tmp_path / "scene.png")


def test_the_table_of_a_flight_shows_places_only_where_they_were_taken() -> None:
    def metrics(*places: int) -> dict[str, Any]:
        usual = {"planned_arrival_s": 90.0, "arrival_s": 90.1, "planned_length_km": 2.4, "flown_length_km": 2.4}
        held = {"items_uploaded": 9, "items_verified": 9, "completed": True, "lost_s": None}
        vehicles = [
            {"sysid": i, "name": f"G{i}", "place": place, **usual, **held} for i, place in enumerate(places, start=1)
        ]
        return {"scenario": "vee", "seed": 1, "delay_s": 0.2, "vehicles": vehicles}

    kept, taken = flight_table(metrics(1, 2)), flight_table(metrics(1, 1))
    assert "place" not in [column.header for column in kept.columns]
    assert next(list(column.cells) for column in taken.columns if column.header == "place") == ["1", "1"]


@pytest.fixture
def px4_folder(run_folder: Path, skein: Callable[..., Result], tmp_path: Path) -> Path:
    result = skein("export", run_folder, "--format", "plan", "--autopilot", "px4", "--out", tmp_path / "px4")
    assert result.exit_code == 0, result.stderr
    return tmp_path / "px4"


def test_a_plan_says_whose_dialect_it_is_in_and_check_names_it(px4_folder: Path, skein: Callable[..., Result]) -> None:
    (file, *_) = sorted(px4_folder.glob("*.plan"))
    assert read_mission_file(file).autopilot == "px4"
    assert "px4" in skein("check", file).stdout


def test_a_plan_for_another_autopilot_is_warned_of(swarm: Any, px4_folder: Path, run_folder: Path) -> None:
    warned = swarm("upload", px4_folder, "--vehicle", "2")
    assert "is for px4, and the vehicle is ardupilot" in warned.stderr
    assert "px4" not in swarm("upload", run_folder / "missions", "--vehicle", "2").stderr
