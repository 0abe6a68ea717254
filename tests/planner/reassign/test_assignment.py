"""Who takes which place: front places first, and nobody crosses anybody's way."""

import itertools
import math
from typing import Any

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from missions.scenario import load_scenario
from planner.reassign.assignment import assigned, kept, ranks

coordinates = st.floats(-1e3, 1e3).map(lambda value: round(value, 3))
points = st.tuples(coordinates, coordinates, coordinates)


def formations(count: int) -> Any:
    return st.lists(points, min_size=count, max_size=count, unique=True)


@settings(max_examples=60)
@given(st.integers(2, 7).flatmap(lambda count: st.tuples(formations(count), formations(count))))
def test_flown_straight_and_together_no_two_come_nearer_than_the_lesser_of_their_distances_over_root_two(
    ends: tuple[list[Any], list[Any]],
) -> None:
    start, end = np.array(ends[0]), np.array(ends[1])
    end = end[assigned(start, end, len(end))]
    part = np.linspace(0.0, 1.0, 101)[:, None, None]
    flown = (1.0 - part) * start + part * end
    for p, q in itertools.combinations(range(len(start)), 2):
        least = min(math.dist(start[p], start[q]), math.dist(end[p], end[q])) / math.sqrt(2.0)
        assert np.linalg.norm(flown[:, p] - flown[:, q], axis=1).min() >= least - 1e-3


@settings(max_examples=40)
@given(st.integers(2, 4).flatmap(lambda count: st.tuples(formations(count), formations(count + 2))))
def test_no_other_assignment_is_shorter_and_certain_places_are_taken(ends: tuple[list[Any], list[Any]]) -> None:
    start, places = np.array(ends[0]), np.array(ends[1])
    certain = len(start) - 1
    chosen = assigned(start, places, certain).tolist()
    assert set(range(certain)) <= set(chosen)

    def cost(order: tuple[int, ...]) -> float:
        return float(np.sum((start - places[list(order)]) ** 2))

    others = (
        order for order in itertools.permutations(range(len(places)), len(start)) if set(range(certain)) <= set(order)
    )
    assert cost(tuple(chosen)) <= min(map(cost, others)) + 1e-3


def test_a_v_keeps_its_front_and_one_of_the_two_last() -> None:
    rank_of = ranks(load_scenario("vee"))
    assert kept(rank_of, 9) == ([1, 2, 3, 4, 5, 6, 7], [8, 9])
    assert kept(rank_of, 8) == ([1, 2, 3, 4, 5, 6, 7], [8, 9])
    assert kept(rank_of, 7) == ([1, 2, 3, 4, 5], [6, 7])
    assert kept(rank_of, 1) == ([], [1])
    assert kept(rank_of, 0) == ([], [])


def test_without_slots_the_order_of_priority_says_which_targets_are_kept() -> None:
    assert kept(ranks(load_scenario("radars")), 7) == ([1, 2, 3, 4, 5, 6], [7])
