"""Streams of normal draws that depend on their key alone, never on who asks first."""

from collections.abc import Iterator
from enum import IntEnum

import numpy as np

BLOCK = 512
"""Draws are made this many ticks at a time; the values do not depend on it."""


class Stream(IntEnum):
    """What a stream of draws is for."""

    GUSTS = 1
    CHANNEL = 2
    INTENTS = 3
    DISTURBANCES = 4


def generator(seed: int, sysid: int, stream: Stream) -> np.random.Generator:
    """numpy's Philox keyed by all three."""
    return np.random.Generator(np.random.Philox(key=[seed, (sysid << 32) | stream]))


def link_generator(seed: int, sender: int, receiver: int, stream: Stream = Stream.CHANNEL) -> np.random.Generator:
    """The same for what becomes of a link's samples, keyed by both its ends."""
    return generator(seed, (receiver << 8) | sender, stream)


def normals(seed: int, sysid: int, stream: Stream, per_tick: int) -> Iterator[tuple[float, ...]]:
    """An endless stream of `per_tick` standard normal draws a tick, of a generator keyed by the rest."""
    draws = generator(seed, sysid, stream)
    while True:
        for row in draws.standard_normal((BLOCK, per_tick)).tolist():
            yield tuple(row)


def uniforms(
    seed: int, sender: int, receiver: int, per_sample: int, stream: Stream = Stream.CHANNEL
) -> Iterator[tuple[float, ...]]:
    """An endless stream of `per_sample` draws from [0, 1) for each sample of a link."""
    draws = link_generator(seed, sender, receiver, stream)
    while True:
        for row in draws.random((BLOCK, per_sample)).tolist():
            yield tuple(row)
