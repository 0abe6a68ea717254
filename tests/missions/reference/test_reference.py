"""The reference is built from what the wire carries, and keeps path, altitude and schedule together."""

import math

import numpy as np
import pytest

from missions.commands import Command, Frame
from missions.errors import InputError
from missions.mission import Mission, MissionItem
from missions.reference import Reference, build_reference
from missions.reference.reference import fillet_radius_m
from missions.scenario import load_scenario

SCENARIO = load_scenario("radars")
FRAME, AIRFRAME = SCENARIO.frame, SCENARIO.airframe.airframe()


def item(x: float, y: float, z: float, command: int = Command.NAV_WAYPOINT, **rest: float) -> MissionItem:
    lat_e7, lon_e7 = FRAME.to_e7(x, y)
    return MissionItem(command, Frame.GLOBAL, lat_e7=lat_e7, lon_e7=lon_e7, alt_m=z + FRAME.alt_m, **rest)


def speed(value: float, kind: int = 0) -> MissionItem:
    return MissionItem(Command.DO_CHANGE_SPEED, Frame.MISSION, kind, value, -1)


HOME = item(0, 0, 0)
DOGLEG = (HOME, speed(25), item(4000, 0, 300), speed(30), item(4000, 4000, 300), item(8000, 8000, 500))


def reference(*items: MissionItem, wind: tuple[float, float] = (0.0, 0.0)) -> Reference:
    return build_reference(Mission(items), FRAME, AIRFRAME, wind)


def test_it_starts_at_home_and_arrives_at_the_target_on_time() -> None:
    ref = reference(*DOGLEG)
    ends = ref.positions(np.array([0.0, ref.duration_s]))
    assert ends[0] == pytest.approx((0, 0, 0), abs=0.01)
    assert ends[1] == pytest.approx((8000, 8000, 500), abs=0.02)


def test_speed_items_hold_from_their_leg_on() -> None:
    ref = reference(*DOGLEG)
    assert ref.leg_airspeed_m_s.tolist() == [25, 30, 30]
    moving = np.diff(ref.arc_lengths(np.arange(0.0, ref.duration_s, 0.1))) / 0.1
    assert moving[:1000].mean() == pytest.approx(25 / math.hypot(1, 300 / ref.path.corner_s_m[1]), rel=1e-3)
    assert np.abs(np.diff(moving)).max() < 0.1, "speed steps are smoothed over 8 s"


def test_the_forecast_turns_airspeed_into_ground_speed() -> None:
    ref = reference(HOME, speed(25), item(4000, 0, 0), item(8000, 0, 0), wind=(-5, 0))
    assert ref.leg_ground_speed_m_s == pytest.approx([20, 20])


def test_ground_speed_items_need_no_forecast() -> None:
    ref = reference(HOME, speed(22, kind=1), item(4000, 0, 0), wind=(-5, 0))
    assert ref.leg_ground_speed_m_s == pytest.approx([22])


def test_fillets_are_flown_at_25_degrees_by_the_fastest_leg() -> None:
    ref = reference(*DOGLEG)
    wanted = fillet_radius_m(float(ref.leg_ground_speed_m_s.max()))
    assert ref.path.corner_radius_m[1:-1] == pytest.approx([wanted, wanted])


def test_velocity_is_continuous() -> None:
    ref = reference(*DOGLEG)
    t = np.arange(0.0, ref.duration_s, 0.02)
    velocity = np.diff(ref.positions(t), axis=0) / 0.02
    assert np.abs(np.diff(velocity, axis=0)).max() < 0.15


def test_a_loiter_over_the_target_ends_the_path_there_and_sets_the_circle() -> None:
    ref = reference(*DOGLEG, item(8000, 8000, 580, Command.NAV_LOITER_UNLIM, param3=-300))
    assert ref.corner_seq == (0, 2, 4, 5)
    assert ref.loiter_z_m == pytest.approx(580, abs=0.01)
    assert ref.loiter_radius_m == -300


def test_what_comes_after_a_loiter_is_not_flown() -> None:
    ref = reference(HOME, item(3000, 0, 100, Command.NAV_LOITER_UNLIM), item(9000, 0, 100))
    assert ref.target_m[0] == pytest.approx(3000, abs=0.02)


def test_relative_altitudes_count_from_home() -> None:
    home = item(0, 0, 150)
    lat_e7, lon_e7 = FRAME.to_e7(3000, 0)
    above = MissionItem(16, Frame.GLOBAL_RELATIVE_ALT, lat_e7=lat_e7, lon_e7=lon_e7, alt_m=100)
    assert reference(home, above).target_m[2] == pytest.approx(250, abs=0.01)


def test_the_tables_of_an_endpoint_say_the_same() -> None:
    ref = reference(*DOGLEG)
    tables = ref.tables()
    assert np.array(tables.segments).tolist() == ref.path.segments.tolist()
    assert tables.airspeeds[1] == (ref.path.corner_s_m[1], 30.0)


@pytest.mark.parametrize("items", [(HOME,), (HOME, speed(25)), (HOME, item(0, 0, 100))])
def test_a_mission_that_goes_nowhere_is_refused(items: tuple[MissionItem, ...]) -> None:
    with pytest.raises(InputError, match="NAV_WAYPOINT"):
        reference(*items)


def test_a_leg_that_cannot_be_flown_against_the_wind_is_named() -> None:
    with pytest.raises(InputError, match="mission item 2"):
        reference(HOME, speed(20), item(4000, 0, 0), wind=(-25, 0))


@pytest.mark.parametrize("change", [speed(5), speed(100), speed(3, kind=2), speed(0), speed(float("nan"))])
def test_speeds_that_cannot_be_flown_are_ignored(change: MissionItem) -> None:
    assert reference(HOME, speed(25), change, item(4000, 0, 0)).leg_airspeed_m_s.tolist() == [25]


def test_a_ground_speed_gives_the_airspeed_that_a_plain_autopilot_holds() -> None:
    ref = reference(HOME, speed(25, kind=1), item(4000, 0, 0), wind=(-6, 0))
    assert ref.leg_airspeed_m_s == pytest.approx([31])


def test_a_ground_speed_that_takes_too_much_airspeed_is_ignored() -> None:
    ref = reference(HOME, speed(35, kind=1), item(4000, 0, 0), wind=(-6, 0))
    assert ref.leg_airspeed_m_s == pytest.approx([AIRFRAME.airspeed_cruise_m_s])


def test_the_speed_goes_back_to_cruise_when_asked() -> None:
    ref = reference(HOME, speed(25), item(4000, 0, 0), speed(-2), item(8000, 0, 0))
    assert ref.leg_airspeed_m_s.tolist() == [25, AIRFRAME.airspeed_cruise_m_s]


def test_a_turn_on_the_spot_is_refused_by_name() -> None:
    with pytest.raises(InputError, match=r"mission item 1: a turn of 180 degrees"):
        reference(HOME, item(4000, 0, 100), item(1000, 0, 100))


def test_of_two_altitudes_in_one_place_the_last_is_kept() -> None:
    ref = reference(HOME, item(3000, 0, 100), item(3000, 0, 300), item(6000, 0, 300))
    assert ref.points(np.array([4500.0]))[0, 2] == pytest.approx(300, abs=0.1)


def test_latitude_and_longitude_0_mean_where_it_is() -> None:
    here = MissionItem(Command.NAV_LOITER_UNLIM, Frame.GLOBAL, alt_m=600)
    ref = reference(HOME, item(3000, 0, 100), here)
    assert ref.target_m[0] == pytest.approx(3000, abs=0.02)
    assert ref.loiter_z_m == pytest.approx(200, abs=0.01)


def test_the_other_side_of_the_world_is_refused() -> None:
    far = MissionItem(Command.NAV_WAYPOINT, Frame.GLOBAL, lat_e7=-470_000_000, lon_e7=-1_720_000_000, alt_m=500)
    with pytest.raises(InputError, match=r"mission item 1: more than 1000 km"):
        reference(HOME, far)
