"""A swarm's network, as the kernel reads it."""

from collections.abc import Iterable, Sequence
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from sitl.formation.channel import DRAWS
from sitl.formation.failures import FOR_EVER, Interval
from sitl.formation.network import Network
from sitl.noise import link_generator

FloatArray = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.int64]


class Wiring(NamedTuple):
    """Who hears whom. Links into vehicle p are [first_link[p], first_link[p + 1]), in order of the senders' sysids.

    Attributes:
        sender: (links,) row of the vehicle that is heard.
        delay_ticks, jitter_ticks: (links,).
        chances: (links, 4) of a `Channel`: loss, enter, leave, burst_loss.
        certain: (links,) whether no draws are needed.
        trust: (links,) at the beginning.
        epoch: (epochs,) tick at which each graph begins.
        weight: (epochs, links) a_pq; 0 where there is no such edge.
        silence, first_silence: (k, 2) intervals, those of each link from its first on; `first_*` has one more.
        freeze, first_freeze: the same of each vehicle.
        death: (n,) tick.
        stale_ticks, lookahead_ticks: as in `Network`.
    """

    first_link: IntArray
    sender: IntArray
    delay_ticks: IntArray
    jitter_ticks: IntArray
    chances: FloatArray
    certain: npt.NDArray[np.bool_]
    trust: FloatArray
    epoch: IntArray
    weight: FloatArray
    silence: IntArray
    first_silence: IntArray
    freeze: IntArray
    first_freeze: IntArray
    death: IntArray
    stale_ticks: int
    lookahead_ticks: int


def wiring_of(network: Network) -> Wiring:
    """The tables of a network; vehicles stand in order of sysid."""
    row = {sysid: p for p, sysid in enumerate(network.sysids)}
    links = links_of(network)
    channels = [network.channel_of(sender, receiver) for sender, receiver in links]
    weights = [{sysid: network.weights(sysid, gone) for sysid in network.sysids} for _, gone in network.epochs]
    weight = np.array([[of[receiver].get(sender, 0.0) for sender, receiver in links] for of in weights])
    silence, first_silence = stacked(network.silences(sender, receiver) for sender, receiver in links)
    freeze, first_freeze = stacked(network.frozen(sysid) for sysid in network.sysids)
    return Wiring(
        first_link=_firsts(len(network.neighbours(sysid)) for sysid in network.sysids),
        sender=integers(row[sender] for sender, _ in links),
        delay_ticks=integers(channel.delay_ticks for channel in channels),
        jitter_ticks=integers(channel.jitter_ticks for channel in channels),
        chances=np.array([channel[2:] for channel in channels], dtype=np.float64).reshape(-1, 4),
        certain=np.array([channel.certain for channel in channels], dtype=np.bool_),
        trust=(weight[0] > 0.0).astype(np.float64),
        epoch=integers(start for start, _ in network.epochs),
        weight=weight,
        silence=silence,
        first_silence=first_silence,
        freeze=freeze,
        first_freeze=first_freeze,
        death=integers(network.deaths.get(sysid, FOR_EVER) for sysid in network.sysids),
        stale_ticks=network.stale_ticks,
        lookahead_ticks=network.lookahead_ticks,
    )


def links_of(network: Network) -> list[tuple[int, int]]:
    """(sender, receiver) of each link, in the order of the tables."""
    return [(sender, receiver) for receiver in network.sysids for sender in network.neighbours(receiver)]


def draws_of(network: Network, seed: int, ticks: int) -> FloatArray:
    """What becomes of each sample: (links, ticks, DRAWS) uniform draws; no ticks where no link needs any."""
    links = links_of(network)
    if all(network.channel_of(*link).certain for link in links):
        return np.empty((len(links), 0, DRAWS))
    draws = np.empty((len(links), ticks, DRAWS))
    for i, link in enumerate(links):
        if not network.channel_of(*link).certain:
            link_generator(seed, *link).random(out=draws[i])
    return draws


def integers(values: Iterable[int]) -> IntArray:
    """A column of a table."""
    return np.array(list(values), dtype=np.int64)


def _firsts(counts: Iterable[int]) -> IntArray:
    return np.concatenate([[0], np.cumsum(list(counts))]).astype(np.int64)


def stacked(intervals: Iterable[Sequence[Interval]]) -> tuple[IntArray, IntArray]:
    """Lists of intervals one below the other, (m, 2), and at which row each begins, with the end of the last."""
    lists = list(intervals)
    flat = [pair for pairs in lists for pair in pairs]
    return np.array(flat, dtype=np.int64).reshape(-1, 2), _firsts(len(pairs) for pairs in lists)
