"""A delay line: each sample so much later, in order; the same samples lost by the same seed."""

from collections.abc import Iterable

from hypothesis import given
from hypothesis import strategies as st

from sitl.formation.channel import Channel
from sitl.formation.correction import Correction
from sitl.formation.disturbance import DISTURBANCE_DRAWS, DelayLine, Disturbance
from sitl.formation.law import Gains
from sitl.formation.link import Link
from sitl.noise import Stream, uniforms

GAINS = Gains(0.2, 0.8, 0.4, 0.01)
SAID_TICKS = 200


def sample(tick: int) -> Correction:
    return Correction(2, tick, tick, True, 0.1 * tick, -0.2)


def line(disturbance: Disturbance, seed: int = 7) -> DelayLine:
    made = DelayLine(uniforms(seed, 2, 1, DISTURBANCE_DRAWS, Stream.DISTURBANCES))
    made.disturbance = disturbance
    return made


def carried(through: DelayLine, said: Iterable[int], ticks: int) -> dict[int, int]:
    """By tick, the stamp of what came out, of samples that went in at the tick of their stamp."""
    said = set(said)
    out = {tick: through.carry(tick, sample(tick) if tick in said else None) for tick in range(ticks)}
    return {tick: came.tick for tick, came in out.items() if came is not None}


@given(st.integers(0, 1500), st.sets(st.integers(0, SAID_TICKS)))
def test_without_loss_every_sample_comes_exactly_so_many_ticks_later(delay_ticks: int, said: set[int]) -> None:
    out = carried(line(Disturbance(delay_ticks)), said, SAID_TICKS + delay_ticks + 1)
    assert out == {stamp + delay_ticks: stamp for stamp in said}
    assert list(out.values()) == sorted(said)


@given(st.floats(0.0, 1.0), st.integers(0, 30), st.integers(0, 2**32))
def test_the_same_seed_loses_the_same_samples_whatever_the_delay(loss: float, delay_ticks: int, seed: int) -> None:
    def heard(delay_ticks: int) -> list[int]:
        out = carried(line(Disturbance(delay_ticks, loss), seed), range(SAID_TICKS), SAID_TICKS + delay_ticks)
        return list(out.values())

    assert heard(delay_ticks) == heard(0) == heard(0)


def test_so_many_are_lost_as_were_asked_for() -> None:
    for loss, least, most in ((0.0, 5000, 5000), (0.3, 3400, 3600), (1.0, 0, 0)):
        assert least <= len(carried(line(Disturbance(0, loss)), range(5000), 5000)) <= most


def test_draws_are_not_those_of_the_channel() -> None:
    assert next(uniforms(7, 2, 1, 1, Stream.DISTURBANCES)) != next(uniforms(7, 2, 1, 1))


@given(st.lists(st.tuples(st.integers(1, 20), st.integers(0, 40)), max_size=6))
def test_whatever_the_changes_a_link_knows_the_newest_that_has_come(changes: list[tuple[int, int]]) -> None:
    """Samples under way keep their delay: later ones overtake them, and what comes late changes nothing."""
    link = Link(Channel(1), None, (), 5000, 1.0)
    link.line = line(Disturbance())
    delays = [delay for ticks, delay in changes for _ in range(ticks)] + [0] * 50
    due = [tick + 1 + delay for tick, delay in enumerate(delays)]
    link.hear(0, None)
    for tick, delay in enumerate(delays, start=1):
        link.line.disturbance = Disturbance(delay)
        link.hear(tick, sample(tick - 1))
        come = [stamp for stamp in range(tick) if due[stamp] <= tick]
        assert link.age_ticks(tick) == (tick - max(come) if come else None)
    assert link.age_ticks(tick) == 1


def test_a_delay_beyond_all_memory_drops_the_edge_and_nothing_more() -> None:
    link, own = Link(Channel(5), None, (), 50, 1.0, clocked=True), [sample(0)._replace(sysid=1)]
    link.line = line(Disturbance(250))
    for tick in range(1000):
        own = [*own, sample(tick)._replace(sysid=1)][-56:]
        link.hear(tick, sample(tick - 5) if tick >= 5 else None)
        assert link.part(tick, own, 1.0, GAINS) == 0.0
        assert (link.used, link.needs) == (False, (0.0, 0.0))
    assert link.age_ticks(999) == 255
