"""Where the vehicles of a simulated swarm stand."""

import itertools
import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from missions.environment import ground_height_m
from missions.errors import InputError
from missions.scenario import Scenario, load_scenario
from sitl.stands import SPACING_LEAST_M, stands

SCENARIOS = {name: load_scenario(name) for name in ("vee", "radars", "ridge")}


@settings(max_examples=20, deadline=None)
@given(st.sampled_from(sorted(SCENARIOS)), st.integers(1, 120))
def test_stand_apart_on_the_ground_inside_the_area_and_off_the_obstacles(name: str, count: int) -> None:
    scenario = SCENARIOS[name]
    everyone = stands(scenario, count)
    own = [scenario.origin_m(of) for of in scenario.vehicles[:count]]
    assert [stand.home_m for stand in everyone[: len(own)]] == own
    assert [stand.sysid for stand in everyone] == list(range(1, count + 1))
    assert len({stand.name for stand in everyone}) == count
    area, spacing_m = scenario.environment.area, max(scenario.limits.separation_m, SPACING_LEAST_M)
    for stand in everyone[len(own) :]:
        x_m, y_m, z_m = stand.home_m
        assert area.x_min_m <= x_m <= area.x_max_m
        assert area.y_min_m <= y_m <= area.y_max_m
        assert z_m == ground_height_m(x_m, y_m, scenario.environment.terrain)
        for obstacle in scenario.environment.obstacles:
            assert math.dist((x_m, y_m), (obstacle.x_m, obstacle.y_m)) > obstacle.radius_m or z_m > obstacle.top_m
    for one, other in itertools.combinations(everyone, 2):
        if other.home_m not in own:
            assert math.dist(one.home_m[:2], other.home_m[:2]) >= spacing_m - 1e-6


def test_a_smaller_swarm_is_the_beginning_of_a_larger_one() -> None:
    vee = SCENARIOS["vee"]
    assert stands(vee, 20) == stands(vee, 40)[:20]
    assert stands(vee) == stands(vee, 9)


def test_system_ids_shift_together(vee: Scenario) -> None:
    assert [stand.sysid for stand in stands(vee, 3, 101)] == [101, 102, 103]


@pytest.mark.parametrize(("count", "base"), [(251, None), (10, 245)])
def test_ids_of_ground_stations_are_given_to_no_vehicle(vee: Scenario, count: int, base: int | None) -> None:
    with pytest.raises(InputError, match="there are 1 to 250; choose a smaller --count or another --sysid-base"):
        stands(vee, count, base)


def test_a_full_area_is_named(vee: Scenario) -> None:
    here = vee.area.model_copy(update={"x_m": (-400.0, 400.0), "y_m": (-400.0, 400.0)})
    small = vee.model_copy(update={"area": here})
    small.__dict__.pop("environment", None)
    with pytest.raises(InputError, match=r"--count 100: there is room for \d+ vehicles in vee"):
        stands(small, 100)
