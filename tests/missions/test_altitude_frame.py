"""What is true of a mission whose altitudes go from one frame to another."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from missions.altitude_frame import AltitudeFrame, altitudes_amsl_m, in_altitude_frame
from missions.commands import PLACES, Command, Frame
from missions.errors import InputError
from missions.mission import Mission, MissionItem

TENTH_M = 0.1
E7 = st.integers(-(2**31) + 1, 2**31 - 1)
ALTITUDES = st.floats(-400.0, 9000.0, width=32)
FRAMES = st.sampled_from([Frame.GLOBAL, Frame.GLOBAL_RELATIVE_ALT, Frame.GLOBAL_TERRAIN_ALT])
PLACED = st.builds(
    lambda command, frame, lat, lon, alt: MissionItem(command, frame, 1.0, 2.0, lat_e7=lat, lon_e7=lon, alt_m=alt),
    st.sampled_from(sorted(PLACES)),
    FRAMES,
    E7,
    E7,
    ALTITUDES,
)
SPEEDS = st.builds(lambda speed: MissionItem(Command.DO_CHANGE_SPEED, Frame.MISSION, 0.0, speed), st.floats(10.0, 40.0))
HOMES = st.builds(
    lambda lat, lon, alt: MissionItem(Command.NAV_WAYPOINT, lat_e7=lat, lon_e7=lon, alt_m=alt), E7, E7, ALTITUDES
)
MISSIONS = st.builds(lambda home, items: Mission((home, *items)), HOMES, st.lists(PLACED | SPEEDS, max_size=12))
ANY_FRAME = st.sampled_from(list(AltitudeFrame))


def hills_m(lat_e7: int, lon_e7: int) -> float:
    return 1500.0 + 1400.0 * math.sin(lat_e7 * 1e-6) * math.cos(lon_e7 * 1e-6)


@given(MISSIONS, ANY_FRAME, ANY_FRAME)
def test_altitudes_survive_any_two_conversions_to_a_tenth_of_a_metre(
    mission: Mission, first: AltitudeFrame, second: AltitudeFrame
) -> None:
    twice = in_altitude_frame(in_altitude_frame(mission, first, hills_m), second, hills_m)
    was, now = altitudes_amsl_m(mission, hills_m), altitudes_amsl_m(twice, hills_m)
    for before, after in zip(was, now, strict=True):
        assert (math.isnan(before) and math.isnan(after)) or abs(before - after) < TENTH_M


@given(MISSIONS, ANY_FRAME)
def test_nothing_but_frames_and_altitudes_changes_and_home_not_even_there(
    mission: Mission, altitude: AltitudeFrame
) -> None:
    changed = in_altitude_frame(mission, altitude, hills_m)
    assert changed.home == mission.home

    def rest(item: MissionItem) -> tuple[object, ...]:
        return item.command, item.params, item.lat_e7, item.lon_e7, item.autocontinue

    assert [rest(item) for item in changed] == [rest(item) for item in mission]
    assert [item for item in changed if item.command not in PLACES] == [
        item for item in mission if item.command not in PLACES
    ]


HOME = MissionItem(Command.NAV_WAYPOINT, Frame.GLOBAL, lat_e7=465_000_000, lon_e7=113_000_000, alt_m=1200.0)
AT = {"lat_e7": 465_100_000, "lon_e7": 113_100_000}


@pytest.mark.parametrize(
    ("altitude", "frame", "alt_m"),
    [(AltitudeFrame.amsl, 0, 1500.0), (AltitudeFrame.relative, 3, 300.0), (AltitudeFrame.terrain, 10, 600.0)],
)
def test_an_altitude_counts_from_the_sea_home_or_the_ground(altitude: AltitudeFrame, frame: int, alt_m: float) -> None:
    mission = Mission((HOME, MissionItem(Command.NAV_WAYPOINT, Frame.GLOBAL, alt_m=1500.0, **AT)))
    item = in_altitude_frame(mission, altitude, lambda *_: 900.0)[1]
    assert (item.frame, item.alt_m) == (frame, alt_m)


@pytest.mark.parametrize("command", [Command.NAV_TAKEOFF, Command.NAV_LOITER_TO_ALT, Command.NAV_LAND])
def test_take_off_and_landing_stay_above_home_where_the_rest_is_above_the_ground(command: Command) -> None:
    mission = Mission((HOME, MissionItem(command, Frame.GLOBAL, alt_m=1230.0, **AT)))
    item = in_altitude_frame(mission, AltitudeFrame.terrain, lambda *_: 900.0)[1]
    assert (item.frame, item.alt_m) == (Frame.GLOBAL_RELATIVE_ALT, 30.0)


def test_a_frame_without_an_altitude_is_refused_by_its_item() -> None:
    with pytest.raises(InputError, match="mission item 1: frame 1 has no altitude"):
        in_altitude_frame(Mission((HOME, MissionItem(Command.NAV_WAYPOINT, 1))), AltitudeFrame.amsl, hills_m)
