"""The verifier finds each kind of fault, each built by hand into a plan that is sound otherwise."""

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest

from missions.commands import Command
from missions.errors import InputError
from missions.mission import Mission
from missions.scenario import Scenario, parse_scenario, read_scenario_text
from planner.formation_plan import FitnessTerms, FormationPlan, UavPlan
from planner.loiter import Circle
from planner.schedule import even_schedule
from planner.verify import UavReport, require, verify
from planner.write_mission import write_mission

Path = Sequence[tuple[float, float, float]]

SCENARIO = """
name = "bench"
origin = { lat_deg = 47.0, lon_deg = 8.0, alt_m = 400.0 }
area = { x_m = [-1000.0, 21000.0], y_m = [-6000.0, 6000.0], z_m = [0.0, 1500.0] }
limits = { altitude_max_m = 1200.0, separation_m = 200.0, clearance_m = 100.0 }

[[terrain.peaks]]
height_m = 600.0
x_m = 10000.0
y_m = 3000.0
decline_x_m = 400.0
decline_y_m = 400.0

[[obstacles]]
x_m = 10000.0
y_m = -3000.0
radius_m = 300.0
height_m = 900.0

[[radars]]
x_m = 5000.0
y_m = 0.0
z_m = 300.0
radius_m = 500.0

[[vehicles]]
name = "one"
sysid = 7
origin = [0.0, 0.0, 0.0]
target = [20000.0, 0.0, 600.0]

[[vehicles]]
name = "two"
sysid = 3
origin = [0.0, 1000.0, 0.0]
target = [20000.0, 1000.0, 600.0]
"""

SOUND: Path = [(0, 0, 0), (5000, 0, 300), (10000, 0, 500), (15000, 0, 600), (20000, 0, 600)]
BESIDE: Path = [(x, y + 1000, z) for x, y, z in SOUND]
DURATION_S = 20000 / 27.0


@pytest.fixture(scope="module")
def scenario() -> Scenario:
    shipped, _ = read_scenario_text("radars")
    start = shipped.index("[airframe]")
    return parse_scenario(SCENARIO + shipped[start : shipped.index("[formation]")], "bench.toml")


def planned(
    scenario: Scenario,
    first: Path = SOUND,
    second: Path = BESIDE,
    *,
    duration_s: float = DURATION_S,
    loiter_z_m: float = 600.0,
) -> FormationPlan:
    """A plan of two given paths."""
    uavs = []
    for vehicle, path in zip(scenario.vehicles, (first, second), strict=True):
        corners = np.array(path, dtype=np.float64)
        schedule = even_schedule(corners, duration_s, scenario.wind.forecast_m_s)
        circle = Circle(float(corners[-1, 0]), float(corners[-1, 1]), loiter_z_m, 200.0)
        uavs.append(
            UavPlan(
                sysid=vehicle.sysid,
                name=vehicle.name,
                waypoints_m=corners,
                terms=FitnessTerms(0.0, 0.0, 0.0, 0.0, 0.0),
                straight_line_m=0.0,
                length_m=0.0,
                evaluations=0,
                history=(),
                mission=write_mission(corners, schedule, circle, scenario.frame),
            )
        )
    return FormationPlan("bench", 1, "by hand", tuple(uavs), 0.0, 0.0)


def faults(scenario: Scenario, plan: FormationPlan) -> list[str]:
    return [violation.text for violation in verify(plan, scenario).violations]


def through(*points: tuple[float, float, float]) -> Path:
    """The sound path with other points in its middle."""
    return [SOUND[0], SOUND[1], *points, SOUND[3], SOUND[4]]


def test_a_sound_plan_passes_and_its_figures_are_right(scenario: Scenario) -> None:
    report = verify(planned(scenario), scenario)
    assert report.violations == ()
    require(report)
    one = report.uavs[0]
    assert (one.sysid, one.name) == (7, "one")
    assert one.arrival_s == pytest.approx(DURATION_S, abs=0.01)
    assert one.clearance_m == pytest.approx(30.0, abs=0.5)
    assert one.wall_m == pytest.approx(2700.0, abs=0.1)
    assert one.separation_m == pytest.approx(1000.0, abs=0.1)
    assert one.turn_deg == pytest.approx(0.0, abs=1e-3)
    assert one.bank_deg <= 25.001
    assert one.climb_deg == pytest.approx(math.degrees(math.atan(0.06)), abs=0.01)
    assert one.descent_deg == pytest.approx(0.0, abs=1e-6)
    assert (one.leg_min_m, one.leg_max_m) == pytest.approx((5000.0, 5009.0), abs=0.1)
    assert one.airspeed_min_m_s == pytest.approx(27.0, abs=0.01)
    assert one.altitude_max_m == pytest.approx(600.0, abs=0.01)
    assert one.radar_exposure_s == pytest.approx(1000 / 27.0, abs=1.0)
    assert report.radar_exposure_s == one.radar_exposure_s


@pytest.mark.parametrize(
    ("path", "text"),
    [
        (through((8000, 1500, 400), (10000, 3000, 500), (12000, 1500, 500)), "above ground at (99"),
        (through((10000, 0, 60)), "less than limits.clearance_m asks for"),
        (through((8000, -1500, 400), (10000, -2700, 500), (12000, -1500, 500)), "30 m from obstacles[0] at (10000"),
        (through((8000, -2650, 400), (10000, -2650, 500), (12000, -2650, 500)), "limits.obstacle_margin_m is 100"),
        (through((7000, 3000, 400), (9000, -500, 500)), "limits.turn_max_deg is 60"),
        (through((6500, 0, 600), (10000, 0, 600)), "limits.climb_max_deg is 8"),
        (through((10000, 0, 500), (10250, 0, 500)), "limits.leg_min_m and leg_max_m are 300 and 8000"),
        ([SOUND[0], (2000, 0, 120), (11000, 0, 500), SOUND[3], SOUND[4]], "9008 m long"),
        (through((10000, 0, 1230)), "above the highest altitude at (100"),
        (through((7500, -4000, 400), (10000, -6100, 500), (12500, -4000, 500)), "outside the area"),
        (through((10000, 0, 500), (10100, 0, 500), (10170, 70, 500), (10270, 70, 500)), "only room for a radius of"),
    ],
)
def test_each_fault_of_a_path_is_found(scenario: Scenario, path: Path, text: str) -> None:
    found = [fault for fault in faults(scenario, planned(scenario, path)) if text in fault]
    assert found
    assert all(fault.startswith("one: ") for fault in found)


@pytest.mark.parametrize(
    ("duration_s", "text"),
    [
        (20000 / 19.0, "airspeed 19.0 m/s on leg"),
        (20000 / 35.0, "airspeed 35.1 m/s on leg"),
        (20000 / 33.5, "of the power there is on leg 1"),
    ],
)
def test_speeds_and_power_outside_their_limits_are_found(scenario: Scenario, duration_s: float, text: str) -> None:
    assert any(text in fault for fault in faults(scenario, planned(scenario, duration_s=duration_s)))


def test_a_descent_too_fast_is_found(scenario: Scenario) -> None:
    down = through((9000, 0, 700), (10000, 0, 560))
    assert any(
        "outside the airframe's climb rates" in f
        for f in faults(scenario, planned(scenario, down, duration_s=20000 / 30.0))
    )


def test_an_airspeed_that_is_too_low_only_in_the_middle_of_turns_is_found(scenario: Scenario) -> None:
    """30 degrees either side of a strong tail wind each leg is fast enough; straight before it is not."""
    wind = scenario.wind.model_copy(update={"forecast_m_s": (14.0, 0.0)})
    windy = scenario.model_copy(update={"wind": wind})
    zigzag: Path = [(5000.0 * k, -2886.75 * (k % 2), 150.0 * k) for k in range(5)]
    found = faults(windy, planned(windy, zigzag, duration_s=23094.0 / 31.0))
    assert not [fault for fault in found if fault.startswith("one: airspeed") and "on leg" in fault]
    assert [fault for fault in found if fault.startswith("one: airspeed 1.1 m/s beyond the airframe's 18 after")], found


def test_a_bank_beyond_the_airframes_is_found(scenario: Scenario) -> None:
    assert not [fault for fault in faults(scenario, planned(scenario, through((10000, 800, 500)))) if "banks" in fault]
    airframe = scenario.airframe.model_copy(update={"bank_max_deg": 20.0})
    stiff = scenario.model_copy(update={"airframe": airframe})
    found = [fault for fault in faults(stiff, planned(stiff, through((10000, 800, 500)))) if "banks" in fault]
    assert any(fault.startswith("one: banks by 25.0 deg at (99") for fault in found)
    assert all(fault.endswith("at most 20.0 are planned") for fault in found)


def test_the_ground_before_becoming_airborne_counts_too(scenario: Scenario) -> None:
    dug = [SOUND[0], (500, 0, -20), (900, 0, 60), *SOUND[1:]]
    assert any("m above ground at (4" in fault for fault in faults(scenario, planned(scenario, dug)))


def test_a_loiter_above_the_highest_altitude_is_found(scenario: Scenario) -> None:
    assert any("loiters at 1240 m" in fault for fault in faults(scenario, planned(scenario, loiter_z_m=1240.0)))


@pytest.mark.parametrize(
    ("end", "text"),
    [
        ((10000, -2300, 600), "loiters 200 m from obstacles[0], not 300"),
        ((10000, 2700, 600), "loiters 36 m above ground, limits.clearance_m is 100"),
        ((20900, 0, 600), "with a radius of 200 m, partly outside the area"),
    ],
)
def test_a_loiter_too_close_to_something_is_found(
    scenario: Scenario, end: tuple[float, float, float], text: str
) -> None:
    wide = scenario.model_copy(update={"limits": scenario.limits.model_copy(update={"obstacle_margin_m": 300.0})})
    path = [SOUND[0], (5000, end[1] / 2, 300), end]
    found = faults(wide, planned(wide, path))
    assert any(text in fault for fault in found), found


def test_a_mission_that_ends_elsewhere_than_the_scenario_says_is_found(scenario: Scenario) -> None:
    elsewhere = planned(scenario, [*SOUND[:-1], (19700, 0, 600)], [(0, 1040, 0), *BESIDE[1:]])
    found = faults(scenario, elsewhere)
    assert "one: ends at (19700, 0, 600), 300 m from where the scenario has it" in found
    assert "two: starts at (0, 1040, 0), 40 m from where the scenario has it" in found


def test_a_plan_for_other_vehicles_is_refused(scenario: Scenario) -> None:
    plan = planned(scenario)
    with pytest.raises(InputError, match=r"plan: is for vehicles \[7\], scenario bench has \[3, 7\]; plan it again"):
        verify(replace(plan, uavs=plan.uavs[:1]), scenario)


def test_crossing_at_the_same_time_is_found_and_blamed_on_the_later(scenario: Scenario) -> None:
    north: Path = [(0, 0, 0), (5000, 0, 300), (10000, 500, 500), (15000, 0, 600), (20000, 0, 600)]
    south: Path = [(x, 1000 - y, z) for x, y, z in north]
    report = verify(planned(scenario, north, south), scenario)
    assert [violation.sysid for violation in report.violations] == [3]
    assert "two: 2 m from one after" in report.violations[0].text
    assert report.at_fault == {3}
    with pytest.raises(InputError, match="plan: two: 2 m from one"):
        require(report)


def test_crossing_a_path_at_another_time_is_none(scenario: Scenario) -> None:
    late: Path = [
        (0, 1000, 0),
        (1500, 4000, 200),
        (5000, 4000, 300),
        (9000, 1000, 500),
        (12000, -1500, 550),
        (16000, 0, 600),
        (20000, 1000, 600),
    ]
    report = verify(planned(scenario, SOUND, late), scenario)
    assert not [violation for violation in report.violations if "from one after" in violation.text]
    assert report.uavs[1].separation_m < 1000.0


def test_the_mission_is_what_counts_not_the_waypoints_beside_it(scenario: Scenario) -> None:
    plan = planned(scenario)
    items = list(plan.uavs[0].mission)
    k = [i for i, item in enumerate(items) if item.command == Command.NAV_WAYPOINT][2]
    items[k] = replace(items[k], alt_m=401.0)
    broken = replace(plan, uavs=(replace(plan.uavs[0], mission=Mission(tuple(items))), plan.uavs[1]))
    assert any("less than limits.clearance_m" in fault for fault in faults(scenario, broken))


def test_every_figure_of_the_report_is_a_number(scenario: Scenario) -> None:
    for uav in verify(planned(scenario), scenario).uavs:
        assert isinstance(uav, UavReport)
        assert not any(math.isnan(value) for value in vars(uav).values() if isinstance(value, float))
