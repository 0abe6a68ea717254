"""Who heard whom, from the changes that each receiver tells of."""

from gcs.metrics.graph_used import GraphUsed, graph_used
from sitl.ticks import TICK_S


def test_an_edge_counts_while_both_hear_each_other() -> None:
    changes = [
        (5, 1, 2, True),
        (5, 2, 1, True),
        (9, 2, 3, True),
        (20, 1, 2, False),
        (21, 2, 1, False),
        (30, 3, 2, True),
    ]
    assert graph_used(changes) == (
        GraphUsed(5 * TICK_S, ((1, 2),)),
        GraphUsed(20 * TICK_S, ()),
        GraphUsed(30 * TICK_S, ((2, 3),)),
    )


def test_the_order_in_which_it_is_told_does_not_matter_and_nothing_comes_of_nothing() -> None:
    changes = [(7, 3, 1, True), (5, 1, 3, True), (6, 3, 2, True), (7, 2, 3, True)]
    assert graph_used(changes) == graph_used(reversed(changes))
    assert graph_used([]) == ()


def test_of_who_told_nothing_the_others_use_is_enough() -> None:
    assert graph_used([(5, 9, 1, True), (8, 9, 1, False)]) == (
        GraphUsed(5 * TICK_S, ((1, 9),)),
        GraphUsed(8 * TICK_S, ()),
    )
