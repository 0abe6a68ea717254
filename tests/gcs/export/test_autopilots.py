"""Files for autopilots: in all scenarios that ship, for both autopilots and all altitudes, they hold what was planned
and others' readers read it."""

import math
from collections.abc import Callable
from pathlib import Path

import pytest

from gcs.export import Exported, ExportOptions, export
from gcs.vehicle_plans import vehicle_plans
from missions.altitude_frame import AltitudeFrame
from missions.autopilot import Autopilot
from missions.commands import PLACES, Command
from missions.errors import InputError
from missions.fence import FenceCircle, FencePolygon
from missions.formats.qgc_plan_reader import read_plan
from missions.formats.waypoints_reader import read_waypoints
from missions.mission import MissionItem, as_float32
from missions.scenario import Scenario
from planner.formation_plan import FormationPlan

TENTH_M = 0.1
DIALECTS = [
    *((Autopilot.ardupilot, altitude) for altitude in AltitudeFrame),
    *((Autopilot.px4, altitude) for altitude in (AltitudeFrame.amsl, AltitudeFrame.relative)),
]
Write = Callable[..., Exported]
AmslM = Callable[[MissionItem, MissionItem, Scenario], float]


@pytest.fixture
def write(scenario: Scenario, formation: FormationPlan, tmp_path: Path) -> Write:
    return lambda *options, **more: export(scenario, formation, ExportOptions(*options, **more), tmp_path)


@pytest.mark.parametrize(("autopilot", "altitude"), DIALECTS)
def test_both_formats_hold_the_mission_that_was_planned(
    write: Write,
    scenario: Scenario,
    formation: FormationPlan,
    amsl_m: AmslM,
    autopilot: Autopilot,
    altitude: AltitudeFrame,
) -> None:
    plans = write("plan", autopilot, altitude).files
    waypoints = write("waypoints", autopilot, altitude).files
    for uav, plan, rows in zip(formation.uavs, plans, waypoints, strict=True):
        read = read_plan(plan).mission
        assert read == read_waypoints(rows)
        assert read.home == uav.mission.home
        for planned, item in zip(uav.mission, read, strict=True):
            assert (item.command, item.params) == (planned.command, planned.params)
            if item.command not in PLACES:
                assert item == planned
                continue
            assert abs(amsl_m(item, read.home, scenario) - planned.alt_m) < TENTH_M
            if (autopilot, item.command) != (Autopilot.px4, Command.NAV_TAKEOFF):
                assert (item.lat_e7, item.lon_e7) == (planned.lat_e7, planned.lon_e7)


@pytest.mark.parametrize(("autopilot", "altitude"), DIALECTS)
def test_pymavlink_s_loader_reads_the_same(write: Write, autopilot: Autopilot, altitude: AltitudeFrame) -> None:
    mavwp = pytest.importorskip("pymavlink.mavwp")
    for path in write("waypoints", autopilot, altitude).files[:3]:
        mission = read_waypoints(path)
        loader = mavwp.MAVWPLoader()
        assert loader.load(str(path)) == len(mission)
        for seq, item in enumerate(mission):
            row = loader.wp(seq)
            assert (row.command, row.frame, row.current, row.autocontinue) == (item.command, item.frame, seq == 0, 1)
            assert tuple(map(as_float32, (row.param1, row.param2, row.param3, row.param4))) == item.params
            assert (round(row.x * 1e7), round(row.y * 1e7), as_float32(row.z)) == (item.lat_e7, item.lon_e7, item.alt_m)


def test_fences_and_rally_points_read_back_as_they_were_made(
    write: Write, scenario: Scenario, formation: FormationPlan
) -> None:
    for vehicle, path in zip(vehicle_plans(scenario, formation), write("plan").files, strict=True):
        assert read_plan(path) == vehicle.plan


def test_no_vehicle_is_planned_to_leave_its_fence_and_every_place_around_it_is_in_it_or_told_of(
    scenario: Scenario, formation: FormationPlan
) -> None:
    places = len(scenario.radars) + len(scenario.obstacles)
    for vehicle in vehicle_plans(scenario, formation):
        polygon, *circles = vehicle.plan.fence.areas
        assert isinstance(polygon, FencePolygon)
        assert len(circles) + len(vehicle.unfenced) == places
        corners = [scenario.frame.from_e7(*corner) for corner in polygon.vertices]
        for item in vehicle.plan.mission:
            if item.command in PLACES:
                x, y = scenario.frame.from_e7(item.lat_e7, item.lon_e7)
                assert min(c[0] for c in corners) < x < max(c[0] for c in corners)
                assert min(c[1] for c in corners) < y < max(c[1] for c in corners)
                for circle in circles:
                    assert isinstance(circle, FenceCircle)
                    assert math.dist((x, y), scenario.frame.from_e7(*circle.center)) > circle.radius_m


def test_a_rally_point_is_home_high_above_it(scenario: Scenario, formation: FormationPlan) -> None:
    for vehicle in vehicle_plans(scenario, formation):
        (rally,) = vehicle.plan.rally
        home = vehicle.plan.mission.home
        assert (rally.lat_e7, rally.lon_e7, rally.alt_m) == (home.lat_e7, home.lon_e7, vehicle.return_height_m)
        assert vehicle.return_height_m >= scenario.limits.clearance_m


def test_notes_say_how_far_rally_points_must_count(write: Write, scenario: Scenario, formation: FormationPlan) -> None:
    straight_m = max(math.dist(uav.waypoints_m[0][:2], uav.waypoints_m[-1][:2]) for uav in formation.uavs)
    (note,) = (note for note in write("plan").notes if "RALLY_LIMIT_KM" in note)
    told_km = int(note.split("set it to ")[1].split()[0])
    assert straight_m / 1000.0 <= told_km <= straight_m / 1000.0 + 2.0


def test_terrain_is_refused_for_px4_by_vehicle(write: Write) -> None:
    with pytest.raises(InputError, match="vehicle 1: terrain: PX4 refuses altitudes above terrain"):
        write("plan", Autopilot.px4, AltitudeFrame.terrain)


def test_notes_say_whose_ground_an_altitude_above_terrain_counts_from(write: Write, scenario: Scenario) -> None:
    notes = write("plan", altitude=AltitudeFrame.terrain).notes
    synthetic = scenario.raster is None
    assert any("the scenario's ground is synthetic" in note for note in notes) == synthetic
    assert any(note.startswith("terrain: ") for note in notes)


def test_notes_name_what_is_in_no_fence(write: Write, scenario: Scenario, formation: FormationPlan) -> None:
    missing = {name for vehicle in vehicle_plans(scenario, formation) for name in vehicle.unfenced}
    notes = write("plan").notes
    assert {note.split(":")[0] for note in notes if "is in no fence of" in note} == missing


def test_waypoints_say_that_they_have_no_fence(write: Write) -> None:
    assert any(note.startswith("waypoints: the format has no fence") for note in write("waypoints").notes)
