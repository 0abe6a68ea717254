"""The colour of a link says how old its corrections are."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gcs.console.link_colour import FRESH, LATE, STALE, UNKNOWN, link_colour


@pytest.mark.parametrize(("age_s", "colour"), [(None, UNKNOWN), (0.0, FRESH), (0.6, LATE), (3.0, STALE), (60.0, STALE)])
def test_its_marks(age_s: float | None, colour: tuple[int, int, int]) -> None:
    assert link_colour(age_s, margin_s=0.6, stale_s=3.0) == colour


@given(st.floats(0.0, 10.0), st.floats(0.0, 5.0), st.floats(0.0, 5.0))
def test_every_age_has_a_colour_whatever_the_limits(age_s: float, margin_s: float, more_s: float) -> None:
    assert all(0 <= part <= 255 for part in link_colour(age_s, margin_s, margin_s + more_s))


@given(st.floats(0.0, 4.0), st.floats(0.0, 4.0))
def test_the_older_the_redder(one_s: float, other_s: float) -> None:
    younger, older = (link_colour(age_s, 0.6, 3.0) for age_s in sorted((one_s, other_s)))
    assert younger[2] >= older[2] or older[1] < LATE[1], "less blue up to the margin"
    assert younger[0] <= older[0] or older[1] < LATE[1], "more red up to it"
    if sorted((one_s, other_s))[0] >= 0.6:
        assert younger[1] >= older[1], "less yellow after it"
