"""Mending a graph that has lost vehicles."""

from hypothesis import given
from hypothesis import strategies as st

from sitl.formation.graph import edges
from sitl.formation.topology import parts, repaired

kinds = st.sampled_from(["ring", "line", "star", "complete"])
swarms = st.sets(st.integers(1, 250), min_size=2, max_size=12).map(sorted)


@given(kinds, swarms, st.data())
def test_whoever_is_lost_those_who_are_left_stay_connected(kind: str, sysids: list[int], data: st.DataObject) -> None:
    gone = data.draw(st.sets(st.sampled_from(sysids)))
    left = set(sysids) - gone
    mended = repaired(edges(kind, sysids), gone)
    assert {sysid for edge in mended for sysid in edge} <= left
    assert len(parts(left, mended)) == min(1, len(left))


@given(kinds, swarms, st.data())
def test_edges_between_those_who_are_left_stay(kind: str, sysids: list[int], data: st.DataObject) -> None:
    gone = data.draw(st.sets(st.sampled_from(sysids)))
    kept = {edge for edge in edges(kind, sysids) if not gone & set(edge)}
    new = set(repaired(edges(kind, sysids), gone)) - kept
    assert kept <= set(repaired(edges(kind, sysids), gone))
    assert len(new) < max(1, len(parts(set(sysids) - gone, kept))), "no more new edges than parts to be joined"


def test_a_line_closes_its_gap_and_a_ring_needs_nothing() -> None:
    assert repaired(edges("line", [1, 2, 3, 4]), {2}) == ((1, 3), (3, 4))
    assert repaired(edges("ring", [1, 2, 3, 4]), {2}) == ((1, 4), (3, 4))


def test_a_star_without_its_centre_becomes_a_line() -> None:
    assert repaired(edges("star", [1, 2, 3, 4]), {1}) == ((2, 3), (3, 4))


def test_what_was_in_parts_before_stays_so() -> None:
    assert repaired([(1, 2), (3, 4), (4, 5)], {4}) == ((1, 2), (3, 5))
    assert parts([1, 2, 3, 5, 9], [(1, 2), (3, 5)]) == [[1, 2], [3, 5], [9]]


def test_parts_are_one_where_lambda_2_is_positive() -> None:
    sysids = [1, 2, 3, 5, 8]
    assert parts(sysids, edges("line", sysids)) == [sysids]
    assert parts(sysids, [(1, 5), (2, 8), (3, 5)]) == [[1, 3, 5], [2, 8]]
    assert parts([4, 2], []) == [[2], [4]]
