"""What losses lead to is safe, leaves no gap, and depends on nothing but them."""

from itertools import combinations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from missions.reassignment import Loss, Move, Reassigned
from missions.reference import Reference
from missions.scenario import Scenario, load_scenario
from missions.scenario.network import FailureModel
from missions.scenario.places import ObstacleModel
from planner.formation_plan import FormationPlan
from planner.plan import plan
from planner.reassign import Reassigner, reassigner_of
from planner.reassign.reassigner import LEAD_S, NOTICE_S

SYSIDS = range(1, 10)


@pytest.fixture(scope="module")
def vee() -> Scenario:
    return load_scenario("vee")


@pytest.fixture(scope="module")
def vee_plan(vee: Scenario) -> FormationPlan:
    return plan(vee)


@pytest.fixture(scope="module")
def planned(vee: Scenario, vee_plan: FormationPlan) -> dict[int, Reference]:
    return vee_plan.references(vee)


losses = st.lists(
    st.builds(
        Loss,
        st.floats(5.0, 400.0).map(lambda t_s: round(t_s, 2)),
        st.frozensets(st.sampled_from(SYSIDS), min_size=1, max_size=2),
    ),
    min_size=1,
    max_size=3,
).map(lambda some: sorted(some, key=lambda loss: loss.t_s))


def survivors(some: list[Loss]) -> set[int]:
    return set(SYSIDS).difference(*(loss.gone for loss in some))


@settings(max_examples=20, derandomize=True)
@given(some=losses)
def test_whoever_is_lost_those_who_are_left_keep_apart_and_no_two_have_one_place(
    some: list[Loss], vee: Scenario, vee_plan: FormationPlan, planned: dict[int, Reference]
) -> None:
    found = Reassigner(vee, vee_plan)(some)
    left = sorted(survivors(some))
    flown = found.references(planned)
    assert len({found.place_of(sysid) for sysid in left}) == len(left)
    until_s = min(flown[sysid].duration_s for sysid in left)
    positions = {sysid: flown[sysid].positions(np.arange(0.0, until_s, 0.25)) for sysid in left}
    for p, q in combinations(left, 2):
        apart = np.linalg.norm(positions[p] - positions[q], axis=1).min()
        assert apart >= vee.limits.separation_m - 0.1, (p, q)


@settings(max_examples=10, derandomize=True)
@given(some=losses)
def test_nothing_changes_before_all_can_know_and_later_losses_change_nothing_of_the_first(
    some: list[Loss], vee: Scenario, vee_plan: FormationPlan, planned: dict[int, Reference]
) -> None:
    reassign = Reassigner(vee, vee_plan)
    found = reassign(some)
    first = Reassigner(vee, vee_plan)(some[:1])
    assert list(map(outline, found.moves))[: len(first.moves)] == list(map(outline, first.moves))
    for move in first.moves:
        assert move.from_s >= some[0].t_s + NOTICE_S - 1e-9
        assert move.start_s == pytest.approx(move.from_s + LEAD_S)
        t_s = np.arange(0.0, move.from_s, 1.0)
        assert np.array_equal(move.reference.positions(t_s), planned[move.sysid].positions(t_s))
        t_s = np.arange(move.end_s + 10.0, planned[move.place].duration_s, 1.0)
        assert move.reference.positions(t_s) == pytest.approx(planned[move.place].positions(t_s), abs=1e-6)


def outline(move: Move) -> tuple[int, int, float, float]:
    return move.sysid, move.place, move.start_s, move.end_s


def places_after(vee: Scenario, vee_plan: FormationPlan, *gone: int) -> dict[int, int]:
    found = Reassigner(vee, vee_plan)([Loss(20.0, frozenset(gone))])
    return {move.sysid: move.place for move in found.moves}


def test_the_rear_closes_up_and_a_loss_at_the_end_moves_nobody(vee: Scenario, vee_plan: FormationPlan) -> None:
    assert places_after(vee, vee_plan, 3) == {5: 3, 7: 5, 9: 7}
    assert places_after(vee, vee_plan, 1) in ({2: 1, 4: 2, 6: 4, 8: 6}, {3: 1, 5: 3, 7: 5, 9: 7})
    assert places_after(vee, vee_plan, 9) == places_after(vee, vee_plan, 8, 9) == {}


def gaps(found: Reassigned) -> list[tuple[int, str]]:
    assert found.moves == ()
    return [(gap.place, gap.why) for gap in found.gaps]


def test_where_no_way_is_safe_the_gap_stays_and_it_is_said_why(vee: Scenario, vee_plan: FormationPlan) -> None:
    crowded = vee.model_copy(update={"limits": vee.limits.model_copy(update={"separation_m": 149.0})})
    ((place, why),) = gaps(Reassigner(crowded, vee_plan)([Loss(310.0, frozenset({3}))]))
    assert place == 3
    assert " m from " in why
    walls = tuple(
        ObstacleModel(x_m=8500.0 + 300.0 * k, y_m=3064.2 + side, radius_m=10.0, height_m=400.0)
        for k in range(6)
        for side in (-53.0, -159.0, -265.0, -371.0, 53.0, 159.0, 265.0, 371.0)
    )
    walled = vee.model_copy(update={"obstacles": walls})
    walled.__dict__.pop("environment", None)
    ((place, why),) = gaps(Reassigner(walled, vee_plan)([Loss(310.0, frozenset({3}))]))
    assert place == 3
    assert "obstacle" in why


def test_nobody_moves_while_someone_is_frozen(vee: Scenario, vee_plan: FormationPlan) -> None:
    frozen = FailureModel(what="freeze", at_s=20.0, for_s=30.0, vehicles=(6,))
    calm = Reassigner(vee, vee_plan)([Loss(20.0, frozenset({3}))])
    found = Reassigner(vee.model_copy(update={"failures": (frozen,)}), vee_plan)([Loss(20.0, frozenset({3}))])
    assert {move.start_s for move in calm.moves} == {32.0}
    assert min(move.from_s for move in found.moves) >= 50.0


def test_it_is_there_where_the_scenario_wants_it(vee: Scenario, vee_plan: FormationPlan) -> None:
    assert reassigner_of(vee, vee_plan) is None
    wanted = vee.model_copy(update={"formation": vee.formation.model_copy(update={"reassign": True})})
    assert reassigner_of(wanted, vee_plan) is not None
