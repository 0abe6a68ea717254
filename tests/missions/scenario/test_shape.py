"""Patterns of formations, and the slots that a scenario's vehicles take from them."""

import math
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from missions.errors import InputError
from missions.scenario import Scenario, parse_scenario, read_scenario_text
from missions.scenario.shape import PATTERNS, Pattern, pattern_slots, width_of

VEE, _ = read_scenario_text("vee")
VEHICLES = VEE[VEE.index("[[vehicles]]") : VEE.index("# Aerosonde class.")]


def shaped(shape: str, vehicles: str = "", route: str | None = None) -> Scenario:
    """The shipped V with a shape, and other vehicles or another route."""
    text = VEE.replace(VEHICLES, f"{vehicles}\n[shape]\n{shape}\n")
    if route is not None:
        text = text.replace(text[text.index("points = [") : text.index("]\n\n", text.index("points = [")) + 2], route)
    return parse_scenario(text, "vee.toml")


@settings(max_examples=60, deadline=None)
@given(pattern=st.sampled_from([name for name in PATTERNS if name != "custom"]), count=st.integers(1, 40))
def test_neighbours_are_one_apart_and_the_leader_is_ahead(pattern: Pattern, count: int) -> None:
    slots = pattern_slots(pattern, count)
    assert len(slots) == count
    assert slots[0] == (0.0, 0.0)
    assert min(behind for behind, _ in slots) == 0.0
    for i, place in enumerate(slots[1:], start=1):
        nearest = min(math.dist(place, other) for j, other in enumerate(slots) if j != i)
        assert nearest >= 1.0 - 1e-9
        assert min(math.dist(place, other) for other in slots[:i]) <= math.sqrt(2) + 1e-9


def test_patterns_look_as_they_are_called() -> None:
    half = math.sqrt(0.5)
    assert pattern_slots("vee", 4) == [(0, 0), (half, half), (half, -half), (2 * half, 2 * half)]
    assert pattern_slots("line_abreast", 4) == [(0, 0), (0, 1), (0, -1), (0, 2)]
    assert pattern_slots("echelon_left", 3) == [(0, 0), (half, half), (2 * half, 2 * half)]
    assert pattern_slots("echelon_right", 3) == [(0, 0), (half, -half), (2 * half, -2 * half)]
    assert pattern_slots("column", 3) == [(0, 0), (1, 0), (2, 0)]
    diamond = [(0, 0), (1, 1), (1, -1), (2, 0), (2, 2), (2, -2), (3, 1), (3, -1), (4, 0)]
    assert np.array(pattern_slots("diamond", 9)) == pytest.approx(half * np.array(diamond))


def test_a_shape_makes_the_vehicles_that_are_not_listed() -> None:
    scenario = shaped('pattern = "vee"\ncount = 9\nspacing_m = 150.0')
    listed = parse_scenario(VEE, "vee.toml")
    assert [vehicle.sysid for vehicle in scenario.vehicles] == list(range(1, 10))
    assert [vehicle.name for vehicle in scenario.vehicles][:3] == ["lead", "wing1", "wing2"]
    for made, own in zip(scenario.vehicles, listed.vehicles, strict=True):
        assert scenario.origin_m(made) == pytest.approx(listed.origin_m(own), abs=0.01)
        assert scenario.target_m(made) == pytest.approx(listed.target_m(own), abs=0.01)


@pytest.mark.parametrize("pattern", [name for name in PATTERNS if name not in ("custom", "column")])
@pytest.mark.parametrize("width_m", [1000.0, 2000.0])
def test_the_width_is_that_of_the_whole(pattern: str, width_m: float) -> None:
    scenario = shaped(f'pattern = "{pattern}"\ncount = 5\nwidth_m = {width_m}')
    left = [vehicle.slot.left_m for vehicle in scenario.vehicles if vehicle.slot]
    assert max(left) - min(left) == pytest.approx(width_m)
    assert width_of([(0.0, place) for place in left]) == pytest.approx(width_m)


def test_listed_vehicles_take_the_slots_in_order_and_keep_their_own() -> None:
    two = '[[vehicles]]\nname = "alpha"\nsysid = 7\n[[vehicles]]\nname = "bravo"\nsysid = 9\n'
    scenario = shaped('pattern = "column"\nspacing_m = 200.0', two)
    assert [(vehicle.name, vehicle.sysid) for vehicle in scenario.vehicles] == [("alpha", 7), ("bravo", 9)]
    assert [vehicle.slot.behind_m for vehicle in scenario.vehicles if vehicle.slot] == [0.0, 200.0]
    own = shaped('pattern = "custom"', VEHICLES)
    assert own.vehicles == parse_scenario(VEE, "vee.toml").vehicles


def test_a_scenario_with_a_shape_survives_being_made_anew() -> None:
    scenario = shaped('pattern = "diamond"\ncount = 4\nspacing_m = 150.0')
    again = Scenario.model_validate({name: getattr(scenario, name) for name in Scenario.model_fields})
    assert again == scenario


def test_a_route_of_which_the_ends_are_given_is_straight_until_one_is_searched() -> None:
    shape = 'pattern = "vee"\ncount = 3\nspacing_m = 150.0'
    scenario = shaped(shape, route="origin = [0.0, 0.0, 0.0]\ntarget = [10000.0, 0.0, 300.0]\n")
    assert scenario.route is not None
    assert scenario.route.is_searched
    assert scenario.route.points == ((0.0, 0.0, 0.0), (10000.0, 0.0, 300.0))
    assert not parse_scenario(VEE, "vee.toml").route.is_searched  # type: ignore[union-attr]
    again = Scenario.model_validate({name: getattr(scenario, name) for name in Scenario.model_fields})
    assert again.route == scenario.route


@pytest.mark.parametrize(
    ("shape", "vehicles", "message"),
    [
        ('pattern = "wedge"\ncount = 3\nspacing_m = 150.0', "", "shape.pattern: must be one of 'vee'"),
        ('pattern = "vee"\ncount = 3', "", "shape: give either spacing_m"),
        ('pattern = "vee"\ncount = 3\nspacing_m = 9.0\nwidth_m = 9.0', "", "shape: give either spacing_m"),
        ('pattern = "column"\ncount = 3\nwidth_m = 100.0', "", "shape: a column has no width; give spacing_m"),
        ('pattern = "custom"\nspacing_m = 100.0', VEHICLES, "shape: a custom shape's slots stand at the vehicles"),
        ('pattern = "vee"\nspacing_m = 150.0', "", "vehicles: is missing"),
        ('pattern = "vee"\ncount = 3\nspacing_m = 150.0', VEHICLES, "shape.count: 3, but 9 vehicles are listed"),
        ('pattern = "vee"\ncount = 3\nspacing_m = 50.0', "", "50 m from vehicles[0]'s, and both start together"),
        ('pattern = "vee"\ncount = 300\nspacing_m = 50.0', "", "shape.count: "),
    ],
)
def test_what_is_wrong_with_a_shape_is_said(shape: str, vehicles: str, message: str) -> None:
    with pytest.raises(InputError) as caught:
        shaped(shape, vehicles)
    assert message in str(caught.value)


def test_points_and_ends_of_a_route_exclude_each_other() -> None:
    text = VEE.replace("[route]\n", "[route]\norigin = [0.0, 0.0, 0.0]\ntarget = [9000.0, 0.0, 300.0]\n")
    with pytest.raises(InputError, match="route: takes either points, or origin and target"):
        parse_scenario(text, "vee.toml")


def test_a_shape_needs_a_route() -> None:
    shipped, _ = read_scenario_text("radars")
    with pytest.raises(InputError, match=r"shape: there is no \[route\] for it"):
        parse_scenario(shipped + '\n[shape]\npattern = "custom"\n', "radars.toml")


def test_successive_slots_of_an_arm_follow_each_other() -> None:
    slots = pattern_slots("echelon_left", 5)
    assert all(math.dist(a, b) == pytest.approx(1.0) for a, b in pairwise(slots))
