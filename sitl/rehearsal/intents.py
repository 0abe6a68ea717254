"""What vehicles hear of each other's intents, as the kernel reads it; and what came of that."""

import numpy as np
import numpy.typing as npt

from missions.compiled import compile_shared
from sitl.avoidance.intent import PERIOD_TICKS
from sitl.avoidance.intent_link import channel_of_intents
from sitl.avoidance.yielding import Yielding
from sitl.config import VehicleConfig
from sitl.formation.channel import DRAWS
from sitl.formation.failures import FOR_EVER
from sitl.formation.network import Network
from sitl.noise import Stream, link_generator
from sitl.rehearsal.avoiding import Avoiding, IntentWiring, empty_avoiding, let_intents_through
from sitl.rehearsal.wiring import integers, stacked

Link = tuple[int, int]


def avoiding_of(vehicle: VehicleConfig, ticks: int) -> Avoiding | None:
    """As a flight of so many ticks begins, of a swarm that this vehicle is one of; None where nobody gives way."""
    if vehicle.avoid_m is None:
        return None
    network = vehicle.network
    avoiding = empty_avoiding(vehicle.avoid_m, len(network.sysids), ticks)
    freeze, first_freeze = stacked(network.frozen(sysid) for sysid in network.sysids)
    links = [(sender, receiver) for receiver in network.sysids for sender in network.sysids if sender != receiver]
    draws = _draws(network, links, vehicle.seed, avoiding.heard.shape[2])
    compile_shared(let_intents_through)(_wiring(network, links), freeze, first_freeze, draws, avoiding.heard)
    return avoiding


def yieldings_of(avoiding: Avoiding | None, row: int, ticks: slice, network: Network) -> tuple[Yielding, ...]:
    """Who a vehicle has given way to, as its endpoint tells it."""
    if avoiding is None:
        return ()
    others = avoiding.other[row, ticks]
    found = []
    for tick in np.flatnonzero(np.diff(others, prepend=-1)).tolist():
        if others[tick] < 0:
            found.append(Yielding(tick, network.sysids[others[tick - 1]]))
        else:
            distance_m, in_s = avoiding.foreseen[row, (tick - 1) // PERIOD_TICKS].tolist()
            found.append(Yielding(tick, network.sysids[others[tick]], distance_m, in_s))
    return tuple(found)


def _wiring(network: Network, links: list[Link]) -> IntentWiring:
    row = {sysid: p for p, sysid in enumerate(network.sysids)}
    channels = [channel_of_intents(network.channel_of(*link)) for link in links]
    silence, first_silence = stacked(network.silences(*link) for link in links)
    known = {sysid: start for start, gone in reversed(network.epochs) for sysid in gone}
    return IntentWiring(
        sender=integers(row[sender] for sender, _ in links),
        receiver=integers(row[receiver] for _, receiver in links),
        channel=np.array(channels, dtype=np.float64).reshape(-1, 6),
        certain=np.array([channel.certain for channel in channels], dtype=np.bool_),
        silence=silence,
        first_silence=first_silence,
        gone=integers(known.get(sysid, FOR_EVER) for sysid in network.sysids),
    )


def _draws(network: Network, links: list[Link], seed: int, periods: int) -> npt.NDArray[np.float64]:
    """(links, periods, DRAWS) uniform draws; no periods where no link needs any."""
    if all(network.channel_of(*link).certain for link in links):
        return np.empty((len(links), 0, DRAWS))
    draws = np.empty((len(links), periods, DRAWS))
    for i, link in enumerate(links):
        link_generator(seed, *link, Stream.INTENTS).random(out=draws[i])
    return draws
