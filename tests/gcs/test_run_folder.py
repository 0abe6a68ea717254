"""A run is all that it takes to fly it: the scenario's other files may go away."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from gcs.run_folder import RunFolder, make_run_folder
from missions.errors import InputError
from missions.scenario import Scenario, parse_scenario, read_scenario_text
from planner.formation_plan import FormationPlan


@pytest.fixture
def run(tmp_path: Path, straight_plan: Callable[[Scenario], FormationPlan]) -> tuple[RunFolder, Scenario]:
    """A run of `ridge` on an elevation file of its own, which is gone."""
    import matplotlib as mpl

    name = "jacksboro_fault_dem.npz"
    file = tmp_path / "dem.npz"
    file.write_bytes((Path(mpl.get_data_path()) / "sample_data" / name).read_bytes())
    text = read_scenario_text("ridge")[0].replace(f"matplotlib:{name}", "dem.npz")
    scenario = parse_scenario(text, "ridge.toml", tmp_path)
    folder = make_run_folder(tmp_path / "run", scenario.name)
    folder.write_plan(text, scenario, straight_plan(scenario))
    file.unlink()
    return folder, scenario


def test_a_run_outlives_the_raster_that_it_was_planned_on(run: tuple[RunFolder, Scenario], tmp_path: Path) -> None:
    folder, scenario = run
    moved = RunFolder(folder.path.rename(tmp_path / "moved"))
    again, _ = moved.read()
    assert np.array_equal(again.environment.terrain.posts, scenario.environment.terrain.posts)
    assert again.environment.terrain[4:8] == scenario.environment.terrain[4:8]
    assert again.model_dump() == scenario.model_dump()


def test_a_run_without_its_ground_says_what_is_missing(run: tuple[RunFolder, Scenario]) -> None:
    folder, _ = run
    folder.raster.unlink()
    with pytest.raises(InputError, match=r"scenario\.toml: terrain\.raster: .*terrain\.npz: no such file"):
        folder.read()


def test_a_run_is_flown_once_at_a_time(tmp_path: Path) -> None:
    run = RunFolder(tmp_path)
    with run.flying():
        (run.truth / "1.f64").write_bytes(b"of the first")
        with pytest.raises(InputError, match="is being flown already"), run.flying():
            pass
        assert (run.truth / "1.f64").read_bytes() == b"of the first"
    with run.flying():
        assert not any(run.truth.iterdir())
