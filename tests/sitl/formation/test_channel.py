"""What becomes of samples: the laws of delay, jitter, loss and bursts."""

import numpy as np
import pytest

from sitl.formation.channel import DRAWS, LOST, Channel, carried
from sitl.noise import link_generator

SAMPLES = 40_000


def delays(channel: Channel, seed: int = 1) -> np.ndarray:
    """Of many samples, LOST among them."""
    in_burst, found = False, []
    for jitter, loss, change in link_generator(seed, 1, 2).random((SAMPLES, DRAWS)).tolist():
        in_burst, delay = carried(in_burst, (jitter, loss, change), channel)
        found.append(delay)
    return np.array(found)


def test_a_certain_channel_delays_and_loses_nothing() -> None:
    assert Channel(5).certain
    assert set(delays(Channel(5)).tolist()) == {5}


def test_jitter_is_spread_evenly_from_nothing_to_its_greatest() -> None:
    found, counts = np.unique(delays(Channel(3, jitter_ticks=4)), return_counts=True)
    assert found.tolist() == [3, 4, 5, 6, 7]
    assert counts / SAMPLES == pytest.approx(0.2, abs=0.01)


def test_losses_alone_are_as_many_as_asked_for_and_independent() -> None:
    lost = delays(Channel(1, loss=0.3)) == LOST
    assert lost.mean() == pytest.approx(0.3, abs=0.01)
    assert (lost[1:] & lost[:-1]).mean() == pytest.approx(0.09, abs=0.01)


def test_bursts_come_and_last_as_asked_for() -> None:
    lost = delays(Channel(1, enter=0.01, leave=0.05)) == LOST
    starts = np.count_nonzero(lost[1:] & ~lost[:-1])
    assert lost.mean() == pytest.approx(0.01 / 0.06, abs=0.02), "share of the time in a burst"
    assert lost.sum() / starts == pytest.approx(20.0, rel=0.15), "mean length"


def test_each_link_has_draws_of_its_own() -> None:
    draws = {pair: link_generator(1, *pair).random(4).tobytes() for pair in ((1, 2), (2, 1), (1, 3))}
    assert len(set(draws.values())) == 3
    assert link_generator(2, 1, 2).random(4).tobytes() != draws[1, 2]
