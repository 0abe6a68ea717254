"""MAVSDK imports what is exported, without a word, as the items that each autopilot is to be sent."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from gcs.bench.mavsdk_station import from_raw_items
from missions.altitude_frame import AltitudeFrame
from missions.autopilot import Autopilot
from missions.commands import Command, Frame
from missions.dialect import in_dialect, wire_items
from missions.fence import Fence, FenceCircle, FencePolygon, parse_fence, rally_items
from missions.formats.qgc_plan import write_plan
from missions.formats.waypoints import write_waypoints
from missions.mission import Mission, MissionItem
from missions.vehicle_plan import Plan

MakeMissions = Callable[[Autopilot], Any]
AREA = FencePolygon(True, ((464_000_000, 112_000_000), (464_000_000, 114_000_000), (466_000_000, 113_000_000)))
FENCE = Fence((AREA, FenceCircle(False, (465_200_000, 113_400_000), 1500.0)))
DIALECTS = [
    *((Autopilot.ardupilot, altitude) for altitude in AltitudeFrame),
    *((Autopilot.px4, altitude) for altitude in (AltitudeFrame.amsl, AltitudeFrame.relative)),
]


@pytest.fixture
def plan(make_mission: Any) -> Plan:
    home, *items = make_mission(12)
    takeoff = MissionItem(
        Command.NAV_TAKEOFF, Frame.GLOBAL, 10.0, lat_e7=home.lat_e7, lon_e7=home.lon_e7, alt_m=home.alt_m + 30.0
    )
    return Plan(Mission((home, takeoff, *items)), FENCE, rally_items([(home.lat_e7, home.lon_e7, 300.0)]))


def places(rally: tuple[MissionItem, ...]) -> list[tuple[int, int, int, float]]:
    """Autocontinue is all that MAVSDK has otherwise."""
    return [(item.frame, item.lat_e7, item.lon_e7, item.alt_m) for item in rally]


@pytest.mark.parametrize(("autopilot", "altitude"), DIALECTS)
def test_a_plan_is_imported_as_the_items_on_the_wire(
    raw_missions: MakeMissions, plan: Plan, tmp_path: Path, autopilot: Autopilot, altitude: AltitudeFrame
) -> None:
    written = in_dialect(plan, autopilot, altitude, lambda *_: 900.0)
    write_plan(written, tmp_path / "one.plan", cruise_speed_m_s=25.0, autopilot=autopilot)
    imported = raw_missions(autopilot).import_qgroundcontrol_mission(str(tmp_path / "one.plan"))
    assert from_raw_items(imported.mission_items) == wire_items(written.mission, autopilot)
    assert parse_fence(from_raw_items(imported.geofence_items)) == written.fence
    assert places(from_raw_items(imported.rally_items)) == places(written.rally)


@pytest.mark.parametrize("autopilot", Autopilot)
def test_waypoints_are_imported_but_their_home_as_an_item(
    raw_missions: MakeMissions, plan: Plan, tmp_path: Path, autopilot: Autopilot
) -> None:
    """MAVSDK knows no home in this format: to an ArduPilot it adds another. docs/export.md says to use .plan."""
    written = in_dialect(plan, autopilot, AltitudeFrame.relative, lambda *_: 900.0)
    write_waypoints(written.mission, tmp_path / "one.waypoints")
    imported = raw_missions(autopilot).import_mission_planner_mission(str(tmp_path / "one.waypoints"))
    added = (plan.mission.home,) if autopilot is Autopilot.ardupilot else ()
    assert from_raw_items(imported.mission_items) == (*added, *written.mission)
