"""What the corrections are worth: the shipped V with all of the law, without neighbours, and as plain autopilots."""

import re
from pathlib import Path
from typing import get_args

import pytest

from gcs.metrics.formation_error import formation_error
from gcs.metrics.tracks import tracks
from gcs.truth import read_truths
from missions.plan_type import PlanType
from missions.scenario import load_scenario
from planner.plan import plan
from sitl.config import Arm
from sitl.formation.correction import Correction
from sitl.formation.graph import edges
from sitl.modes import Mode
from sitl.swarm import SwarmOptions, vehicle_configs
from sitl.ticks import TICK_S, delay_ticks
from sitl.truth import TruthWriter
from sitl.vehicle import Vehicle

VEE = load_scenario("vee")
PLAN = plan(VEE)


@pytest.fixture(scope="module")
def rms_m(tmp_path_factory: pytest.TempPathFactory) -> dict[Arm, float]:
    """Formation error of each arm, flown in one process with the endpoints' own vehicles, tick by tick."""
    return {arm: fly(arm, tmp_path_factory.mktemp(arm)) for arm in get_args(Arm)}


def fly(arm: Arm, folder: Path) -> float:
    references = PLAN.references(VEE)
    vehicles = []
    for config, uav in zip(vehicle_configs(VEE, SwarmOptions(seed=1, delay_s=0.2, arm=arm)), PLAN.uavs, strict=True):
        vehicle = Vehicle(config, TruthWriter(folder / f"{config.sysid}.f64"))
        vehicle.load(PlanType.MISSION, uav.mission.items)
        vehicle.arm()
        vehicle.set_mode(Mode.AUTO)
        vehicles.append(vehicle)
    said: list[dict[int, Correction]] = []
    for tick in range(round(max(r.duration_s for r in references.values()) / TICK_S)):
        said.append({vehicle.sysid: vehicle.observe() for vehicle in vehicles})
        heard = said[tick - delay_ticks(0.2)] if tick >= delay_ticks(0.2) else {}
        for vehicle in vehicles:
            vehicle.advance(heard)
    for vehicle in vehicles:
        vehicle._truth.close()
    truths = read_truths(folder, references)
    return formation_error(tracks(references, truths), edges("ring", list(references))).overall_rms_m


def test_the_law_keeps_the_formation_within_a_quarter_of_plain_autopilots(rms_m: dict[Arm, float]) -> None:
    assert rms_m["full"] <= 0.25 * rms_m["plain"]


def test_neighbours_are_worth_a_good_third_of_what_is_left(rms_m: dict[Arm, float]) -> None:
    assert rms_m["full"] <= 0.6 * rms_m["own_schedule"]


def test_the_readme_quotes_these_figures(rms_m: dict[Arm, float]) -> None:
    text = (Path(__file__).parents[2] / "README.md").read_text()
    quoted = [float(value) for value in re.findall(r"^\| .*(?:--no-\w+`\)|with neighbours) \| ([\d.]+) m", text, re.M)]
    assert quoted == pytest.approx([rms_m["plain"], rms_m["own_schedule"], rms_m["full"]], rel=0.02)
