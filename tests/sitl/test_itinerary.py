"""A mission as stages: what can be flown and what cannot, and jumps that end."""

from collections.abc import Callable
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from missions.commands import Command
from missions.errors import InputError
from missions.mission import Mission, MissionItem
from missions.plan_type import PlanType
from missions.scenario import load_scenario
from sitl.itinerary import Start
from sitl.stages.path import PathStage
from sitl.swarm import SwarmOptions, vehicle_configs
from sitl.truth import TruthWriter
from sitl.vehicle import Vehicle

Place = Callable[..., MissionItem]


def test_a_plain_mission_is_one_path_to_a_loiter(make_flown: Any, straight_mission: Mission) -> None:
    vehicle = make_flown().vehicle
    vehicle.load(PlanType.MISSION, straight_mission.items)
    itinerary = vehicle._captain.itinerary
    stage, reached, after = itinerary.stage(itinerary.first(), Start((0.0, 0.0, 0.0)))
    assert isinstance(stage, PathStage)
    assert (stage.loiter_seq, reached, after.seq) == (5, [], 6)
    assert stage.reference.corner_seq == (0, 3, 4)


@pytest.mark.parametrize(
    ("items", "reason"),
    [
        ([("NAV_WAYPOINT", 1000, 0, 300, {}), ("NAV_LAND", 2000, 0, 0, {})], "item 2: LAND: 300 m to lose over 1000 m"),
        ([("NAV_LAND", 2000, 0, 0, {})], "item 1: LAND needs a waypoint before it"),
        ([("NAV_WAYPOINT", 1000, 0, 50, {}), ("DO_JUMP", 0, 0, 0, {"param1": 3})], "item 2: DO_JUMP to item 3"),
        ([("NAV_WAYPOINT", 1000, 0, 50, {}), ("DO_JUMP", 0, 0, 0, {"param1": 2})], "item 2: DO_JUMP to item 2"),
        (
            [("NAV_WAYPOINT", 1000, 0, 50, {}), ("DO_JUMP", 0, 0, 0, {"param1": 1, "param2": -3})],
            "item 2: DO_JUMP -3 times",
        ),
        ([("NAV_WAYPOINT", 0, 0, 50, {})], "no waypoint away from home"),
        ([("NAV_WAYPOINT", 2e6, 0, 50, {})], "item 1: more than 1000 km"),
        ([("NAV_RALLY_POINT", 0, 0, 50, {})], "item 1: command 5100 cannot be flown"),
    ],
)
def test_what_cannot_be_flown_is_refused_by_item(make_flown: Any, place: Place, items: Any, reason: str) -> None:
    vehicle = make_flown().vehicle
    mission = [vehicle.home] + [place(Command[name], east, north, z, **p) for name, east, north, z, p in items]
    with pytest.raises(InputError, match=reason):
        vehicle.load(PlanType.MISSION, mission)
    assert len(vehicle.mission) == 1


def test_an_approach_into_the_hill_is_refused() -> None:
    config = vehicle_configs(load_scenario("mountains"), SwarmOptions(seed=1, delay_s=0.2))[0]
    vehicle = Vehicle(config, TruthWriter(None))

    def item(command: int, x: float, y: float, z: float) -> MissionItem:
        lat_e7, lon_e7 = config.frame.to_e7(x, y)
        return MissionItem(command, 3, lat_e7=lat_e7, lon_e7=lon_e7, alt_m=z)

    over_the_peak = [
        vehicle.home,
        item(Command.NAV_WAYPOINT, 10000, 27000, 700),
        item(Command.NAV_LAND, 10000, 36000, 0),
    ]
    with pytest.raises(InputError, match=r"item 2: LAND: the approach is -.* m above the ground"):
        vehicle.load(PlanType.MISSION, over_the_peak)


CONFIG = vehicle_configs(load_scenario("vee"), SwarmOptions(seed=1, delay_s=0.2))[0]
JUMPS = st.builds(lambda target, n: (Command.DO_JUMP, target, n), st.integers(1, 6), st.integers(-1, 3))


@settings(max_examples=60, deadline=None)
@given(
    st.lists(
        JUMPS | st.just((Command.DO_LAND_START, 0, 0)) | st.just((Command.NAV_WAYPOINT, 0, 0)), min_size=6, max_size=6
    )
)
def test_no_loop_of_jumps_hangs(steps: list[tuple[int, int, int]]) -> None:
    vehicle = Vehicle(CONFIG, TruthWriter(None))
    lat_e7, lon_e7 = CONFIG.frame.to_e7(900.0, 100.0)
    items = [vehicle.home]
    for seq, (command, target, times) in enumerate(steps, start=1):
        at = (lat_e7 + 20_000 * seq, lon_e7) if command == Command.NAV_WAYPOINT else (0, 0)
        target += target == seq and (1 if seq < 6 else -1)
        items.append(MissionItem(command, 3, target, times, lat_e7=at[0], lon_e7=at[1], alt_m=80.0))
    try:
        vehicle.load(PlanType.MISSION, items)
    except InputError:
        return
    itinerary = vehicle._captain.itinerary
    mark, start = itinerary.first(), Start((0.0, 0.0, 60.0), 0.0)
    for _ in range(20):
        stage, _, mark = itinerary.stage(mark, start)
        assert stage is None or len(stage.reference.corner_seq) <= 61
