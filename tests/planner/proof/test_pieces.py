"""One table for many UAVs answers as each one's own would."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from planner.proof.pieces import TOUCH, Largest, Pieces


@settings(max_examples=50, deadline=None)
@given(seed=st.integers(0, 2**32), sizes=st.lists(st.integers(1, 9), min_size=1, max_size=5))
def test_index_and_largest_agree_with_one_uav_after_the_other(seed: int, sizes: list[int]) -> None:
    rng = np.random.default_rng(seed)
    tables = [
        np.column_stack([np.sort(rng.choice(1000, size, replace=False) - 100.0), rng.normal(size=size)])
        for size in sizes
    ]
    pieces = Pieces(tables)
    largest = Largest(pieces, pieces.table[:, 1])
    row = rng.integers(0, len(tables), 200)
    a = rng.uniform(-300.0, 1200.0, 200)
    b = a + rng.exponential(100.0, 200)
    index, over = pieces.index(row, a), largest.over(row, a, b)
    for i, r in enumerate(row):
        starts, figures = tables[r].T
        mine = max(0, int(np.searchsorted(starts, a[i], side="right")) - 1)
        assert np.array_equal(pieces.table[index[i]], tables[r][mine])
        first = max(0, int(np.searchsorted(starts, a[i] - TOUCH, side="right")) - 1)
        last = max(0, int(np.searchsorted(starts, b[i] + TOUCH, side="right")) - 1)
        assert over[i] == figures[first : last + 1].max()


def test_lengths_are_those_of_each_table_and_zero_for_its_last_piece() -> None:
    pieces = Pieces([np.array([[0.0], [3.0], [7.0]]), np.array([[-2.0], [1.0]])])
    assert pieces.lengths.tolist() == [3.0, 4.0, 0.0, 3.0, 0.0]
