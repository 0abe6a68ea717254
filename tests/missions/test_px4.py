"""PX4's own rules hold for all that is written for it; what cannot be made to keep them is refused."""

import math
from dataclasses import replace

import pytest
from hypothesis import event, given
from hypothesis import strategies as st
from pyproj import Geod

from missions.commands import PLACES, Command, Frame
from missions.errors import InputError
from missions.mission import Mission, MissionItem
from missions.px4 import TAKEOFF_AHEAD_M, mission_of_px4, px4_items, px4_kept, px4_mission

GLOBE = Geod(ellps="WGS84")
HOME = MissionItem(Command.NAV_WAYPOINT, Frame.GLOBAL, lat_e7=465_000_000, lon_e7=113_000_000, alt_m=1200.0)


def place(command: Command, north_e7: int = 0, east_e7: int = 0, alt_m: float = 1500.0, **values: float) -> MissionItem:
    lat_e7, lon_e7 = HOME.lat_e7 + north_e7, HOME.lon_e7 + east_e7
    return MissionItem(command, Frame.GLOBAL, lat_e7=lat_e7, lon_e7=lon_e7, alt_m=alt_m, **values)


TAKEOFF = place(Command.NAV_TAKEOFF, alt_m=1230.0, param1=10.0)
FAR = place(Command.NAV_WAYPOINT, 100_000, 50_000)
OFFSETS = st.sampled_from([0, 20_000, -70_000, 250_000])
PLACED = st.builds(
    place,
    st.sampled_from([Command.NAV_WAYPOINT] * 9 + sorted(PLACES - {Command.NAV_TAKEOFF})),
    OFFSETS,
    OFFSETS,
    st.sampled_from([1200.0, 1210.0, 1240.0, 1900.0]),
    param2=st.sampled_from([0.0, 80.0, -80.0]),
    param3=st.sampled_from([0.0, 80.0, -80.0]),
)
ABOVE_HOME = PLACED.map(lambda item: replace(item, frame=Frame.GLOBAL_RELATIVE_ALT, alt_m=item.alt_m - 1200.0))
PLACELESS = st.builds(
    MissionItem,
    st.sampled_from([Command.DO_CHANGE_SPEED, Command.DO_LAND_START, Command.NAV_RETURN_TO_LAUNCH]),
    st.sampled_from([Frame.GLOBAL, Frame.MISSION, Frame.GLOBAL_RELATIVE_ALT]),
    st.just(0.0),
    st.floats(15.0, 35.0),
)
TAKEOFFS = st.builds(lambda alt_m: replace(TAKEOFF, alt_m=alt_m), st.sampled_from([1230.0] * 5 + [1200.0, 1100.0]))
APPROACHES = st.builds(
    place,
    st.sampled_from([Command.NAV_WAYPOINT, Command.NAV_LOITER_TO_ALT]),
    st.just(-100_000),
    st.just(0),
    st.floats(1200.0, 1260.0),
    param2=st.sampled_from([90.0, -90.0]),
)
LANDS = st.builds(place, st.just(Command.NAV_LAND), st.integers(-98_000, 0), st.just(0), st.just(1200.0))
LANDINGS = st.lists(st.tuples(APPROACHES, LANDS), max_size=1).map(
    lambda pairs: [item for pair in pairs for item in pair]
)
ITEMS = st.lists(PLACED | ABOVE_HOME | PLACELESS, max_size=6)
MISSIONS = st.builds(
    lambda first, takeoff, items, landing: Mission((HOME, *first, *takeoff, *items, *landing)),
    st.lists(PLACELESS | PLACED, max_size=1),
    st.lists(TAKEOFFS, max_size=1),
    ITEMS,
    LANDINGS,
)


def rejections(items: tuple[MissionItem, ...], home_amsl_m: float) -> list[str]:
    """What PX4's navigator says of a mission (FeasibilityChecker, FW_LND_ANG = 5), written down anew from its rules."""
    said = []
    placed_before = False
    for i, item in enumerate(items):
        placed = item.command in PLACES
        if item.frame not in ((0, 3) if placed else (2,)):
            said.append(f"{i}: frame")
        if item.command == Command.NAV_LOITER_TURNS:
            said.append(f"{i}: command")
        if item.command == Command.NAV_TAKEOFF and (placed_before or amsl(item, home_amsl_m) - home_amsl_m < 1e-6):
            said.append(f"{i}: take-off")
        if item.command == Command.NAV_LAND:
            said += landing_rejections(i, items[i - 1] if i else None, item, home_amsl_m)
        placed_before |= placed
    return said


def landing_rejections(i: int, before: MissionItem | None, land: MissionItem, home_amsl_m: float) -> list[str]:
    if before is None or before.command not in (Command.NAV_WAYPOINT, Command.NAV_LOITER_TO_ALT):
        return [f"{i}: approach"]
    height_m = amsl(before, home_amsl_m) - amsl(land, home_amsl_m)
    distance_m = apart_m(before, land)
    if before.command == Command.NAV_LOITER_TO_ALT:
        if distance_m <= abs(before.param2):
            return [f"{i}: inside the orbit"]
        distance_m = math.sqrt(distance_m**2 - before.param2**2)
    if height_m < 1e-6:
        return [f"{i}: approach below"]
    return [f"{i}: too steep"] if height_m > distance_m * math.tan(math.radians(5.1)) else []


def amsl(item: MissionItem, home_amsl_m: float) -> float:
    return item.alt_m + (home_amsl_m if item.frame == Frame.GLOBAL_RELATIVE_ALT else 0.0)


def apart_m(a: MissionItem, b: MissionItem) -> float:
    return float(GLOBE.inv(a.lon_deg, a.lat_deg, b.lon_deg, b.lat_deg)[2])


@given(MISSIONS)
def test_px4_has_no_word_against_a_mission_that_was_made_for_it(mission: Mission) -> None:
    try:
        made = px4_mission(mission)
    except InputError as error:
        event("refused: " + str(error).split(": ", 1)[1][:25])
        return
    event("taken")
    assert rejections(px4_items(made), HOME.alt_m) == []
    assert made.home == HOME
    assert len(made) == len(mission)


@given(
    st.sampled_from([Command.NAV_WAYPOINT, Command.NAV_LOITER_TO_ALT]),
    st.floats(3.0, 8.0),
    st.floats(10.0, 90.0),
    st.sampled_from([90.0, -90.0]),
)
def test_a_landing_is_taken_up_to_five_degrees(
    command: Command, slope_deg: float, height_m: float, radius_m: float
) -> None:
    final_m = height_m / math.tan(math.radians(slope_deg))
    centre_m = final_m if command == Command.NAV_WAYPOINT else math.hypot(final_m, radius_m)
    lon_deg, lat_deg, _ = GLOBE.fwd(FAR.lon_deg, FAR.lat_deg, 30.0, centre_m)
    approach = replace(FAR, command=command, param2=radius_m, alt_m=1200.0 + height_m)
    land = MissionItem(
        Command.NAV_LAND, Frame.GLOBAL, lat_e7=round(lat_deg * 1e7), lon_e7=round(lon_deg * 1e7), alt_m=1200.0
    )
    mission = Mission((HOME, TAKEOFF, approach, land))
    if slope_deg > 5.01:
        with pytest.raises(InputError, match=r"mission item 3: .* is steeper than PX4's 5 degrees"):
            px4_mission(mission)
    elif slope_deg < 4.99:
        assert rejections(px4_items(px4_mission(mission)), HOME.alt_m) == []


def test_the_take_off_lies_ahead_on_the_first_leg() -> None:
    made = px4_mission(Mission((HOME, TAKEOFF, FAR)))
    azimuth = [GLOBE.inv(HOME.lon_deg, HOME.lat_deg, item.lon_deg, item.lat_deg)[0] for item in made.items[1:]]
    assert azimuth[0] == pytest.approx(azimuth[1], abs=0.01)
    assert apart_m(HOME, made[1]) == pytest.approx(TAKEOFF_AHEAD_M, abs=0.1)
    assert replace(made[1], lat_e7=TAKEOFF.lat_e7, lon_e7=TAKEOFF.lon_e7) == TAKEOFF


def test_on_a_short_first_leg_the_take_off_lies_halfway() -> None:
    near = place(Command.NAV_WAYPOINT, 20_000)
    made = px4_mission(Mission((HOME, TAKEOFF, near)))
    assert apart_m(HOME, made[1]) == pytest.approx(apart_m(HOME, near) / 2, abs=0.1)


def test_a_take_off_that_has_its_own_place_keeps_it() -> None:
    own = place(Command.NAV_TAKEOFF, -30_000, alt_m=1230.0)
    assert px4_mission(Mission((HOME, own, FAR)))[1] == own


def test_speeds_go_into_the_frame_without_a_place() -> None:
    speed = MissionItem(Command.DO_CHANGE_SPEED, Frame.GLOBAL_RELATIVE_ALT, 0.0, 25.0, -1.0)
    assert px4_mission(Mission((HOME, TAKEOFF, speed, FAR)))[2] == replace(speed, frame=Frame.MISSION)


def test_home_is_not_sent_and_jumps_count_without_it() -> None:
    jump = MissionItem(Command.DO_JUMP, Frame.MISSION, 2.0, 5.0)
    items = px4_items(px4_mission(Mission((HOME, TAKEOFF, FAR, jump))))
    assert [item.command for item in items] == [Command.NAV_TAKEOFF, Command.NAV_WAYPOINT, Command.DO_JUMP]
    assert items[2].params == (1.0, 5.0, 0.0, 0.0)


@given(MISSIONS, st.integers(1, 9))
def test_what_is_held_without_home_is_the_mission_again_with_it(mission: Mission, target: int) -> None:
    jumping = Mission((*mission.items, MissionItem(Command.DO_JUMP, Frame.MISSION, float(target), 5.0)))
    assert mission_of_px4(px4_items(jumping), jumping.home) == jumping


HEADED = place(Command.NAV_WAYPOINT, param1=3.0, param2=80.0, param3=7.0, param4=-90.0)


@pytest.mark.parametrize(
    ("item", "kept"),
    [
        (HEADED, replace(HEADED, param3=0.0, param4=270.0)),
        (replace(HEADED, param4=math.nan), replace(HEADED, param3=0.0, param4=math.nan)),
        (TAKEOFF, replace(TAKEOFF, param1=0.0)),
        (
            place(Command.NAV_LOITER_TO_ALT, param1=2.0, param2=-90.0, param4=0.5),
            place(Command.NAV_LOITER_TO_ALT, param1=1.0, param2=-90.0, param4=1.0),
        ),
        (place(Command.NAV_LOITER_UNLIM, param1=1.0, param3=-90.0), place(Command.NAV_LOITER_UNLIM, param3=-90.0)),
    ],
)
def test_px4_gives_back_what_has_a_meaning_to_it(item: MissionItem, kept: MissionItem) -> None:
    assert repr(px4_kept(item)) == repr(kept)  # NaN is no equal of itself
    assert repr(px4_kept(kept)) == repr(kept)


def test_what_has_no_place_px4_keeps_whole() -> None:
    speed = MissionItem(Command.DO_CHANGE_SPEED, Frame.MISSION, 0.0, 25.0, -1.0, 1.0)
    assert px4_kept(speed) == speed


CIRCLE = place(Command.NAV_LOITER_TO_ALT, 100_000, 0, 1250.0, param2=-90.0)


@pytest.mark.parametrize(
    ("items", "reason"),
    [
        ((FAR, TAKEOFF), "mission item 2: to PX4 the take-off is the first item with a place"),
        ((TAKEOFF, FAR, TAKEOFF), "mission item 3: to PX4 the take-off is the first"),
        ((replace(TAKEOFF, alt_m=1200.0), FAR), "mission item 1: the take-off must end above home"),
        ((replace(FAR, frame=Frame.GLOBAL_TERRAIN_ALT),), "mission item 1: PX4 has no altitudes above terrain"),
        ((replace(FAR, lat_e7=0, lon_e7=0),), "mission item 1: latitude and longitude 0 is a place to PX4"),
        ((replace(FAR, command=Command.NAV_LOITER_TURNS),), "mission item 1: PX4 has no command 18"),
        ((TAKEOFF, place(Command.NAV_LAND)), "mission item 2: PX4 lands only after a waypoint"),
        ((CIRCLE, place(Command.NAV_LAND, 104_000, 0, 1200.0)), "mission item 2: lands inside the circle"),
        ((CIRCLE, place(Command.NAV_LAND, 150_000, 0, 1250.0)), "mission item 1: the landing's approach must be above"),
        ((CIRCLE, place(Command.NAV_LAND, 140_000, 0, 1200.0)), "mission item 2: 50 m down in 435 m is steeper"),
    ],
)
def test_what_px4_would_reject_is_refused_by_its_item(items: tuple[MissionItem, ...], reason: str) -> None:
    with pytest.raises(InputError) as error:
        px4_mission(Mission((HOME, *items)))
    assert str(error.value).startswith(reason)


def test_a_landing_from_a_circle_may_be_as_steep_as_five_degrees() -> None:
    px4_mission(Mission((HOME, CIRCLE, place(Command.NAV_LAND, 155_000, 0, 1200.0))))
