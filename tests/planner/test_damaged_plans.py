"""Sound plans that are damaged on purpose: the verifier catches every one, wherever and however small the place is."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from missions.commands import Command
from missions.mission import Mission, MissionItem
from missions.scenario import Scenario, load_scenario
from missions.scenario.places import ObstacleModel, PeakModel, TerrainModel
from missions.scenario.vehicles import SlotModel
from planner.formation_plan import FormationPlan
from planner.loiter import Circle
from planner.plan import plan
from planner.schedule import timed_schedule
from planner.verify import verify
from planner.write_mission import write_mission

VEE = load_scenario("vee")


def column(scenario: Scenario, spacing_m: float) -> Scenario:
    """Two of the scenario's vehicles, one behind the other."""
    slots = (SlotModel(behind_m=0.0, left_m=0.0), SlotModel(behind_m=spacing_m, left_m=0.0))
    pairs = zip(scenario.vehicles[:2], slots, strict=True)
    return scenario.model_copy(
        update={"vehicles": tuple(vehicle.model_copy(update={"slot": slot}) for vehicle, slot in pairs)}
    )


def surrounded(**changes: object) -> Scenario:
    """The V with other surroundings; made anew, since a copy would keep what was derived from the old ones."""
    return Scenario.model_validate({**{name: getattr(VEE, name) for name in Scenario.model_fields}, **changes})


PAIR = column(VEE, 200.0)
SOUND, SOUND_PAIR = plan(VEE), plan(PAIR)
CORNERS = 3
"""Waypoints of a path of `VEE` after its origin; the last is its target."""


def damaged(of: FormationPlan, uav: int, change: Callable[[list[MissionItem]], None]) -> FormationPlan:
    """The plan with one UAV's mission changed in place."""
    items = list(of.uavs[uav].mission)
    change(items)
    uavs = list(of.uavs)
    uavs[uav] = replace(uavs[uav], mission=Mission(tuple(items)))
    return replace(of, uavs=tuple(uavs))


def waypoint(items: list[MissionItem], corner: int) -> int:
    """Which item a corner is, from 0 for the first after the origin."""
    return [i for i, item in enumerate(items) if i and item.command == Command.NAV_WAYPOINT][corner]


def faults(of: FormationPlan, uav: int, scenario: Scenario = VEE) -> list[str]:
    """What the verifier says of one UAV."""
    sysid = of.uavs[uav].sysid
    return [violation.text for violation in verify(of, scenario).violations if violation.sysid == sysid]


uavs = st.integers(0, 8)
corners = st.integers(0, CORNERS - 2)


def test_the_plans_are_sound_before_they_are_damaged() -> None:
    assert verify(SOUND, VEE).violations == ()
    assert verify(SOUND_PAIR, PAIR).violations == ()


@settings(max_examples=15, deadline=None)
@given(uav=uavs, along=st.floats(0.15, 0.98), decline=st.floats(0.2, 300.0), depth=st.floats(0.2, 100.0))
def test_a_hill_that_reaches_into_the_clearance_is_caught(uav: int, along: float, decline: float, depth: float) -> None:
    reference = SOUND.references(VEE)[SOUND.uavs[uav].sysid]
    s = along * reference.length_m
    x, y, z = reference.points(np.array(s)).tolist()
    wanted = VEE.limits.clearance_m * min(1.0, s / VEE.limits.climb_out_m)
    hill = PeakModel(height_m=z - wanted + depth, x_m=x, y_m=y, decline_x_m=decline, decline_y_m=decline)
    found = faults(SOUND, uav, surrounded(terrain=TerrainModel(peaks=(hill,))))
    assert any("m less than limits.clearance_m asks for" in fault for fault in found), found


@settings(max_examples=10, deadline=None)
@given(uav=uavs, corner=corners, height=st.floats(-50.0, 55.0))
def test_a_waypoint_pushed_towards_the_ground_is_caught(uav: int, corner: int, height: float) -> None:
    def push(items: list[MissionItem]) -> None:
        k = waypoint(items, corner)
        items[k] = replace(items[k], alt_m=VEE.origin.alt_m + height)

    assert any("above ground at" in fault for fault in faults(damaged(SOUND, uav, push), uav))


@settings(max_examples=15, deadline=None)
@given(uav=uavs, along=st.floats(0.05, 0.95), radius=st.floats(0.05, 200.0), gap=st.floats(0.0, 99.5))
def test_a_tower_beside_the_path_is_caught(uav: int, along: float, radius: float, gap: float) -> None:
    reference = SOUND.references(VEE)[SOUND.uavs[uav].sysid]
    x, y, heading, _ = reference.path.at(np.array(along * reference.length_m))
    aside = radius + gap
    tower = ObstacleModel(
        x_m=float(x - aside * np.sin(heading)), y_m=float(y + aside * np.cos(heading)), radius_m=radius, height_m=590.0
    )
    found = faults(SOUND, uav, surrounded(obstacles=(tower,)))
    assert any("from obstacles[0] at" in fault for fault in found), found


@settings(max_examples=15, deadline=None)
@given(uav=uavs, corner=corners, part=st.floats(0.1, 1.0), scale=st.sampled_from([0.6, 1.3]))
def test_a_wrong_speed_is_caught(uav: int, corner: int, part: float, scale: float) -> None:
    def change(items: list[MissionItem]) -> None:
        k = [i for i, item in enumerate(items) if item.command == Command.DO_CHANGE_SPEED][corner]
        limit = 20.0 * 0.99 if scale < 1.0 else 34.0 * 1.01
        items[k] = replace(items[k], param2=limit + part * ((18.01 if scale < 1.0 else 35.99) - limit))

    assert any("airspeed" in fault for fault in faults(damaged(SOUND, uav, change), uav))


@settings(max_examples=15, deadline=None)
@given(uav=uavs, corner=corners, room=st.floats(1.0, 60.0))
def test_a_corner_too_tight_for_the_speed_is_caught(uav: int, corner: int, room: float) -> None:
    """A waypoint more, just after the corner, takes the room for its arc away."""

    def tighten(items: list[MissionItem]) -> None:
        here, ahead = items[waypoint(items, corner)], items[waypoint(items, corner + 1)]
        (x, y), (x1, y1) = (VEE.frame.from_e7(item.lat_e7, item.lon_e7) for item in (here, ahead))
        part = room / np.hypot(x1 - x, y1 - y)
        lat_e7, lon_e7 = VEE.frame.to_e7(x + part * (x1 - x), y + part * (y1 - y))
        items.insert(waypoint(items, corner) + 1, replace(here, lat_e7=lat_e7, lon_e7=lon_e7))

    found = faults(damaged(SOUND, uav, tighten), uav)
    assert any("only room for a radius of" in fault for fault in found), found


@settings(max_examples=10, deadline=None)
@given(uav=uavs, degrees=st.floats(61.0, 140.0))
def test_a_turn_too_sharp_is_caught(uav: int, degrees: float) -> None:
    def sharpen(items: list[MissionItem]) -> None:
        k = [waypoint(items, corner) for corner in range(CORNERS)]
        (x0, y0), (x1, y1) = (VEE.frame.from_e7(items[i].lat_e7, items[i].lon_e7) for i in k[:2])
        heading = np.arctan2(y1 - y0, x1 - x0) + np.radians(degrees)
        lat_e7, lon_e7 = VEE.frame.to_e7(x1 + 4000.0 * np.cos(heading), y1 + 4000.0 * np.sin(heading))
        for i in (k[2], len(items) - 1):  # the target and the loiter there
            items[i] = replace(items[i], lat_e7=lat_e7, lon_e7=lon_e7)

    assert any("limits.turn_max_deg is 60" in fault for fault in faults(damaged(SOUND, uav, sharpen), uav))


@settings(max_examples=10, deadline=None)
@given(spacing=st.floats(100.0, 600.0), late=st.sampled_from([0, 1]))
def test_two_uavs_swapped_in_time_are_caught(spacing: float, late: int) -> None:
    """Each passes a corner when the other should: on a line that they share, they meet on the way there."""
    scenario = column(VEE, spacing)
    sound = plan(scenario)
    times = [reference.corner_time_s[: CORNERS + 1] for reference in sound.references(scenario).values()]
    times[0][1 + late], times[1][1 + late] = times[1][1 + late], times[0][1 + late]
    swapped = []
    for uav, at in zip(sound.uavs, times, strict=True):
        schedule = timed_schedule(uav.waypoints_m, at, scenario.wind.forecast_m_s)
        end = Circle(*uav.waypoints_m[-1].tolist(), 200.0)
        swapped.append(replace(uav, mission=write_mission(uav.waypoints_m, schedule, end, scenario.frame)))
    assert any("m from lead after" in fault for fault in faults(replace(sound, uavs=tuple(swapped)), 1, scenario))


def test_a_loiter_at_the_altitude_of_its_neighbours_is_caught() -> None:
    altitude = SOUND.uavs[0].mission.items[-1].alt_m

    def lower(items: list[MissionItem]) -> None:
        items[-1] = replace(items[-1], alt_m=altitude)

    found = faults(damaged(SOUND, 1, lower), 1)
    assert found == ["left1: loiters as high as lead beside it, less than 40 m apart"]


@settings(max_examples=5, deadline=None)
@given(pair=st.tuples(uavs, uavs).filter(lambda pair: pair[0] != pair[1]))
def test_two_uavs_with_each_others_missions_are_caught(pair: tuple[int, int]) -> None:
    missions = [SOUND.uavs[uav].mission for uav in pair]

    def fly(mission: Mission) -> Callable[[list[MissionItem]], None]:
        def change(items: list[MissionItem]) -> None:
            items[:] = mission

        return change

    swapped = damaged(damaged(SOUND, pair[0], fly(missions[1])), pair[1], fly(missions[0]))
    for uav in pair:
        assert any("from where the scenario has it" in fault for fault in faults(swapped, uav))


@settings(max_examples=20, deadline=None)
@given(seed=st.integers(0, 2**32), wanted=st.floats(20.0, 160.0))
def test_the_verdict_on_separation_is_that_of_samples_every_hundredth_of_a_second(seed: int, wanted: float) -> None:
    """Missions with waypoints moved at random, some still sound and some not."""
    rng = np.random.default_rng(seed)
    moved = SOUND_PAIR
    for uav in (0, 1):

        def shift(items: list[MissionItem]) -> None:
            for corner in range(CORNERS - 1):
                k = waypoint(items, corner)
                x, y = VEE.frame.from_e7(items[k].lat_e7, items[k].lon_e7)
                lat_e7, lon_e7 = VEE.frame.to_e7(*(np.array([x, y]) + rng.uniform(-100.0, 100.0, 2)))
                items[k] = replace(items[k], lat_e7=lat_e7, lon_e7=lon_e7)

        moved = damaged(moved, uav, shift)
    scenario = PAIR.model_copy(update={"limits": PAIR.limits.model_copy(update={"separation_m": wanted})})
    one, two = moved.references(scenario).values()
    t = np.arange(0.0, min(one.duration_s, two.duration_s), 0.01)
    truth = float(np.linalg.norm(one.positions(t) - two.positions(t), axis=1).min())
    found = [fault for fault in faults(moved, 1, scenario) if "limits.separation_m" in fault]
    if abs(truth - wanted) > 0.3:
        assert bool(found) == (truth < wanted)
