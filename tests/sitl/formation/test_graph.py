"""Graphs: who hears whom, and the laws of their Laplacians."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from sitl.formation.graph import edges, laplacian, neighbour_weights

kinds = st.sampled_from(["ring", "line", "star", "complete"])
swarms = st.sets(st.integers(1, 250), min_size=2, max_size=12).map(sorted)


@given(kinds, swarms)
def test_weights_are_symmetric_and_every_graph_is_connected(kind: str, sysids: list[int]) -> None:
    matrix = laplacian(sysids, edges(kind, sysids))
    modes = np.linalg.eigvalsh(matrix)
    assert (matrix == matrix.T).all()
    assert np.abs(matrix.sum(axis=1)).max() < 1e-12
    assert modes[0] == pytest.approx(0, abs=1e-9)
    assert modes[1] > 1e-9, "connected"
    assert modes[-1] <= 2 + 1e-9


def test_the_shipped_ring_goes_round_in_order_of_sysid() -> None:
    assert edges("ring", [3, 1, 2, 4]) == ((1, 2), (1, 4), (2, 3), (3, 4))
    assert neighbour_weights(1, edges("ring", [1, 2, 3, 4])) == {2: 0.5, 4: 0.5}


def test_two_in_a_ring_share_one_edge_and_one_alone_has_none() -> None:
    assert edges("ring", [1, 2]) == ((1, 2),)
    assert edges("ring", [7]) == ()
    assert neighbour_weights(7, ()) == {}


def test_a_list_of_edges_is_a_graph_of_the_vehicles_that_there_are() -> None:
    assert edges([(3, 1), (2, 3), (3, 9)], [1, 2, 3]) == ((1, 3), (2, 3))


def test_unit_weights() -> None:
    graph = edges("star", [1, 2, 3, 4])
    assert np.linalg.eigvalsh(laplacian([1, 2, 3, 4], graph, unit_weights=True)) == pytest.approx([0, 1, 1, 4])


def test_an_unknown_graph_is_an_error() -> None:
    with pytest.raises(ValueError, match="ring, line, star and complete"):
        edges("tree", [1, 2])
