"""The geometry of slot formations, on the shipped V."""

from dataclasses import replace
from itertools import combinations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from missions.errors import InputError
from missions.scenario import VehicleModel, load_scenario
from missions.scenario.vehicles import SlotModel
from planner.plan import plan
from planner.slots import SINGLE_FILE, full_width, route_of, slot_path_m, slot_schedule, staggered_behind_m
from planner.verify import verify

VEE = load_scenario("vee")


def test_neighbours_leave_and_arrive_150_m_apart_and_come_no_nearer_than_119_m() -> None:
    result = plan(VEE)
    references = result.references(VEE)
    duration = references[1].duration_s
    t = np.linspace(0.0, duration, 1000)
    positions = {sysid: reference.positions(t) for sysid, reference in references.items()}
    for ahead, behind in [(1, 2), (1, 3), (2, 4), (3, 5), (4, 6), (5, 7), (6, 8), (7, 9)]:
        apart = np.linalg.norm(positions[ahead] - positions[behind], axis=1)
        assert apart[[0, -1]] == pytest.approx([150.0, 150.0], abs=1.0)
    nearest = min(uav.separation_m for uav in verify(result, VEE).uavs)
    assert nearest == pytest.approx(119.0, abs=2.0)


def test_ground_speeds_stay_within_what_the_model_says() -> None:
    speeds = np.concatenate(
        [slot_schedule(VEE, vehicle, slot_path_m(VEE, vehicle)).ground_m_s for vehicle in VEE.vehicles]
    )
    assert speeds.min() == pytest.approx(26.4, abs=0.1)
    assert speeds.max() == pytest.approx(29.6, abs=0.1)


def test_corners_are_passed_as_long_after_the_leader_as_the_slot_lies_behind() -> None:
    schedules = [slot_schedule(VEE, vehicle, slot_path_m(VEE, vehicle)) for vehicle in VEE.vehicles]
    times = np.array([np.cumsum(schedule.arcs_m / schedule.ground_m_s) for schedule in schedules])
    behind = np.array([vehicle.slot.behind_m for vehicle in VEE.vehicles if vehicle.slot])
    assert times[:, :2] - times[0, :2] == pytest.approx(np.tile(behind / 28.0, (2, 1)).T, abs=1e-6)
    assert times[:, 2] == pytest.approx(np.full(9, times[0, 2]), abs=1e-6)


def test_offset_legs_are_parallel_to_the_route_at_the_slots_distance() -> None:
    assert VEE.route is not None
    route = np.array(VEE.route.points)[:, :2]
    for vehicle in VEE.vehicles:
        assert vehicle.slot is not None
        path = slot_path_m(VEE, vehicle)[:, :2]
        for k in range(3):
            along = (route[k + 1] - route[k]) / np.linalg.norm(route[k + 1] - route[k])
            left = np.array([-along[1], along[0]])
            assert (path[k : k + 2] - route[k]) @ left == pytest.approx([vehicle.slot.left_m] * 2, abs=0.01)


def test_a_slot_further_behind_than_a_leg_is_long_is_refused() -> None:
    far = VEE.vehicles[1].model_copy(update={"slot": VEE.vehicles[1].slot.model_copy(update={"behind_m": 4500.0})})  # type: ignore[union-attr]
    with pytest.raises(InputError, match="left1: its slot lies further ahead or behind"):
        slot_schedule(VEE, far, slot_path_m(VEE, far))


@settings(max_examples=40, deadline=None)
@given(seed=st.integers(0, 2**32), count=st.integers(1, 9), scale=st.floats(0.0, 1.0), apart=st.floats(10.0, 200.0))
def test_staggered_slots_are_as_far_apart_as_asked_and_none_moves_ahead(
    seed: int, count: int, scale: float, apart: float
) -> None:
    places = np.random.default_rng(seed).uniform([0.0, -300.0], [300.0, 300.0], (count, 2))
    vehicles = [
        VehicleModel(name=f"v{k}", sysid=k + 1, slot=SlotModel(behind_m=behind, left_m=left))
        for k, (behind, left) in enumerate(places.tolist())
    ]
    behind = staggered_behind_m(vehicles, scale, apart)
    staggered = np.column_stack([[behind[k + 1] for k in range(count)], scale * places[:, 1]])
    assert np.all(staggered[:, 0] >= places[:, 0])
    for i, j in combinations(range(count), 2):
        assert np.linalg.norm(staggered[i] - staggered[j]) >= apart - 1e-6
    first = int(np.argmin(places[:, 0]))
    assert staggered[first, 0] == places[first, 0]


def test_a_narrowed_corner_lies_nearer_to_the_route_and_a_staggered_one_is_passed_later() -> None:
    full = full_width(route_of(VEE))
    narrow = replace(full, scale=np.array([1.0, 0.5, 1.0, 1.0]))
    file = replace(full, stagger=np.array([0, SINGLE_FILE, 0, 0]))
    for vehicle in VEE.vehicles:
        wide, half = slot_path_m(VEE, vehicle, full), slot_path_m(VEE, vehicle, narrow)
        assert half[1] - full.route_m[1] == pytest.approx((wide[1] - full.route_m[1]) / 2, abs=1e-9)
        assert np.array_equal(half[[0, 2, 3]], wide[[0, 2, 3]])
    times = []
    for vehicle in VEE.vehicles:
        schedule = slot_schedule(VEE, vehicle, slot_path_m(VEE, vehicle, file), file)
        times.append(float(schedule.arcs_m[0] / schedule.ground_m_s[0]))
    assert np.all(np.diff(sorted(times)) * 28.0 >= 1.25 * 75.0 - 1e-6)
