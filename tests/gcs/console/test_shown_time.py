"""The time that is shown goes evenly, though what is heard comes in steps."""

import itertools
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gcs.console.shown_time import ShownTime

FRAME_S = 1.0 / 30.0


def steps(rate: float, step_s: float, until_s: float) -> list[tuple[float, float]]:
    """Frames of a vehicle that tells its time each `step_s`, at a rate: (shown, newest)."""
    shown = ShownTime()
    frames = []
    for frame in range(int(until_s / FRAME_S)):
        newest_s = step_s * math.floor(rate * frame * FRAME_S / step_s)
        frames.append((shown.advance(FRAME_S, newest_s, step_s), newest_s))
    return frames


@pytest.mark.parametrize(("rate", "step_s"), [(1.0, 0.25), (1.0, 1.0), (10.0, 1.0), (0.2, 0.05)])
def test_it_goes_evenly_though_samples_come_in_steps(rate: float, step_s: float) -> None:
    times = np.array([shown_s for shown_s, _ in steps(rate, step_s, 30.0)])
    frames = np.diff(times[len(times) // 2 :])
    assert frames.mean() == pytest.approx(rate * FRAME_S, rel=0.1)
    assert frames.min() >= 0.0, "never goes back"
    assert frames.max() < 3.0 * rate * FRAME_S, "never leaps"


@given(st.lists(st.tuples(st.floats(0.001, 3.0), st.floats(0.0, 30.0)), min_size=1, max_size=60), st.floats(0.02, 1.0))
def test_it_is_never_ahead_of_what_all_have_told(frames: list[tuple[float, float]], step_s: float) -> None:
    shown = ShownTime()
    newest = itertools.accumulate(heard_s for _, heard_s in frames)
    for (passed_s, _), newest_s in zip(frames, newest, strict=True):
        assert shown.advance(passed_s, newest_s, step_s) <= newest_s


def test_it_keeps_close_behind() -> None:
    for shown_s, newest_s in steps(10.0, 1.0, 30.0)[300:]:
        assert newest_s - shown_s < 4.0


def test_when_the_clock_stands_it_comes_to_what_was_heard_last_and_stays() -> None:
    shown = ShownTime()
    for frame in range(300):
        shown.advance(FRAME_S, 0.25 * math.floor(frame * FRAME_S / 0.25), 0.25)
    times = [shown.advance(FRAME_S, 9.75, 0.25) for _ in range(300)]
    assert times[-1] == pytest.approx(9.75, abs=0.01)
    assert shown.rate == 0.0
    assert max(times) <= 9.75


@pytest.mark.parametrize("heard_s", [500.0, -500.0], ids=["after a pause", "begun anew"])
def test_what_is_far_off_is_gone_to_at_once(heard_s: float) -> None:
    shown = ShownTime()
    for frame in range(300):
        shown.advance(FRAME_S, 1000.0 + frame * FRAME_S, 0.25)
    assert shown.advance(FRAME_S, 1010.0 + heard_s, 0.25) == pytest.approx(1010.0 + heard_s, abs=300.0)


def test_the_rate_is_that_of_the_last_seconds() -> None:
    shown = ShownTime()
    t_s = 0.0
    for rate in (1.0, 5.0):
        for _ in range(90):
            t_s += rate * FRAME_S
            shown.advance(FRAME_S, t_s, 0.04)
        assert shown.rate == pytest.approx(rate)
