"""Plans of all scenarios that ship, for both autopilots in all frames: MAVSDK, pymavlink and Skein read the same."""

from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import pytest

from gcs.bench.mavsdk_station import from_raw_items
from gcs.export import ExportOptions, export
from missions.altitude_frame import AltitudeFrame
from missions.autopilot import Autopilot
from missions.commands import PLACES, Command
from missions.dialect import wire_items
from missions.fence import parse_fence
from missions.formats.qgc_plan_reader import read_plan
from missions.formats.waypoints_reader import read_waypoints
from missions.mission import MissionItem
from missions.scenario import Scenario, load_scenario, shipped_scenarios
from planner.formation_plan import FormationPlan
from planner.plan import plan

Items = tuple[MissionItem, ...]
TENTH_M = 0.1
DIALECTS = [
    *((Autopilot.ardupilot, altitude) for altitude in AltitudeFrame),
    *((Autopilot.px4, altitude) for altitude in (AltitudeFrame.amsl, AltitudeFrame.relative)),
]


@pytest.fixture(scope="module")
def planned() -> Callable[[str], tuple[Scenario, FormationPlan]]:
    """A scenario that ships and its plan, each made once."""

    @cache
    def make(name: str) -> tuple[Scenario, FormationPlan]:
        scenario = load_scenario(name)
        return scenario, plan(scenario)

    return make


def read_by_pymavlink(path: Path) -> Items:
    """All rows, home first."""
    loader = pytest.importorskip("pymavlink.mavwp").MAVWPLoader()
    rows = [loader.wp(seq) for seq in range(loader.load(str(path)))]
    return tuple(
        MissionItem(
            *(row.command, row.frame, row.param1, row.param2, row.param3, row.param4),
            *(round(row.x * 1e7), round(row.y * 1e7), row.z, bool(row.autocontinue)),
        )
        for row in rows
    )


@pytest.mark.parametrize(("autopilot", "altitude"), DIALECTS)
@pytest.mark.parametrize("name", shipped_scenarios())
def test_all_readers_find_what_was_planned(
    name: str,
    autopilot: Autopilot,
    altitude: AltitudeFrame,
    planned: Callable[[str], tuple[Scenario, FormationPlan]],
    raw_missions: Callable[[Autopilot], Any],
    amsl_m: Callable[[MissionItem, MissionItem, Scenario], float],
    tmp_path: Path,
) -> None:
    scenario, formation = planned(name)
    mavsdk = raw_missions(autopilot)
    before = int(autopilot is Autopilot.ardupilot)  # MAVSDK puts a home there, and takes row 0 for an item all the same
    plans, rows = (
        export(scenario, formation, ExportOptions(form, autopilot, altitude), tmp_path).files
        for form in ("plan", "waypoints")
    )
    for uav, plan_file, rows_file in zip(formation.uavs, plans, rows, strict=True):
        read = read_plan(plan_file)
        own = read.mission
        assert own == read_waypoints(rows_file)
        assert own.home == uav.mission.home
        imported = mavsdk.import_qgroundcontrol_mission(str(plan_file))
        assert from_raw_items(imported.mission_items) == wire_items(own, autopilot)
        assert parse_fence(from_raw_items(imported.geofence_items)) == read.fence
        assert len(imported.rally_items) == len(read.rally)
        by_rows = mavsdk.import_mission_planner_mission(str(rows_file)).mission_items
        assert from_raw_items(by_rows)[before:] == own.items
        assert read_by_pymavlink(rows_file) == own.items
        for wanted, item in zip(uav.mission, own, strict=True):
            assert (item.command, item.params) == (wanted.command, wanted.params)
            if item.command in PLACES:
                assert abs(amsl_m(item, own.home, scenario) - wanted.alt_m) < TENTH_M
            if (autopilot, item.command) != (Autopilot.px4, Command.NAV_TAKEOFF):  # PX4's is ahead of home
                assert (item.lat_e7, item.lon_e7) == (wanted.lat_e7, wanted.lon_e7)
