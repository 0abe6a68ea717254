"""Missions that end on the ground, for both autopilots."""

from collections.abc import Callable
from pathlib import Path

import pytest

from gcs.export import ExportOptions, export
from missions.altitude_frame import AltitudeFrame
from missions.autopilot import Autopilot
from missions.commands import Command, Frame
from missions.errors import InputError
from missions.formats.qgc_plan_reader import read_plan
from missions.scenario import Scenario, load_scenario
from planner.formation_plan import FormationPlan

PlanByHand = Callable[[Scenario], FormationPlan]
DIALECTS = [(Autopilot.ardupilot, altitude) for altitude in AltitudeFrame] + [(Autopilot.px4, AltitudeFrame.relative)]


@pytest.mark.parametrize(("autopilot", "altitude"), DIALECTS)
def test_the_loiter_gives_way_to_a_landing(
    autopilot: Autopilot, altitude: AltitudeFrame, plan_by_hand: PlanByHand, tmp_path: Path
) -> None:
    scenario = load_scenario("radars")
    formation = plan_by_hand(scenario)
    options = ExportOptions("plan", autopilot, altitude, landing=True)
    for uav, path in zip(formation.uavs, export(scenario, formation, options, tmp_path).files, strict=True):
        mission = read_plan(path).mission
        down, land = mission.items[-2:]
        assert len(mission) == len(uav.mission) + 1
        assert (down.command, land.command) == (Command.NAV_LOITER_TO_ALT, Command.NAV_LAND)
        assert down.param2 == uav.mission[-1].param3
        amsl = land.alt_m + (mission.home.alt_m if land.frame == Frame.GLOBAL_RELATIVE_ALT else 0.0)
        assert amsl == pytest.approx(400.0, abs=0.1)  # the flat ground


def test_a_formation_whose_circles_meet_is_told_so_and_nothing_is_written(
    plan_by_hand: PlanByHand, tmp_path: Path
) -> None:
    scenario = load_scenario("vee")
    with pytest.raises(InputError, match="vehicle 1: its circle is nearer than"):
        export(scenario, plan_by_hand(scenario), ExportOptions("plan", landing=True), tmp_path)
    assert list(tmp_path.iterdir()) == []
