"""One flight of a swarm, rehearsed."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from missions.compiled import compile_shared
from missions.mission import Mission
from sitl.aircraft.gusts import NORMALS_PER_TICK
from sitl.avoidance.yielding import Yielding
from sitl.config import VehicleConfig
from sitl.flight import make_aircraft
from sitl.formation.graph import EdgeChange
from sitl.formation.network import Network
from sitl.formation.swarm_clock import longest_s
from sitl.noise import Stream, generator
from sitl.rehearsal.intents import avoiding_of, yieldings_of
from sitl.rehearsal.kernel import Law, fly_swarm
from sitl.rehearsal.record import Record, empty_record
from sitl.rehearsal.routes import routes_of
from sitl.rehearsal.wiring import draws_of, links_of, wiring_of
from sitl.ticks import TICK_S

FloatArray = npt.NDArray[np.float64]

OVERTIME_S = 120.0
"""A vehicle that has not arrived so long after its plan is waited for no longer."""


@dataclass(frozen=True)
class Flown:
    """What became of a flight.

    Attributes:
        truth: by sysid: (ticks, 6) rows of x, y, h, V, gamma, chi, one a tick from tick 0.
        arrived: by sysid: the tick at which the end of the path was passed; None for who did not come so far.
        edges: changes of who makes use of whose corrections, in order.
        along_rate_m_s: by sysid: (ticks,) e', how much faster than the schedule; NaN off the path.
        thrust_n: by sysid: (ticks,) that the engine gave.
        shifts: by sysid: (ticks, 2) seconds that its schedule had been slowed and hurried; empty without a swarm clock.
        yieldings: by sysid, who was given way to.
    """

    truth: dict[int, FloatArray]
    arrived: dict[int, int | None]
    edges: list[EdgeChange]
    along_rate_m_s: dict[int, FloatArray]
    thrust_n: dict[int, FloatArray]
    shifts: dict[int, FloatArray]
    yieldings: dict[int, tuple[Yielding, ...]]


def rehearse(vehicles: Sequence[VehicleConfig], missions: Mapping[int, Mission]) -> Flown:
    """Fly a swarm's missions from a held start, as its endpoints would.

    Args:
        vehicles: of the swarm, in order of sysid; all have one airframe, terrain, wind, arm and network.
        missions: by sysid, waypoints and speeds with a loiter at the end.

    Raises:
        InputError: a mission cannot be flown, or is more than that.
    """
    first = vehicles[0]
    routes = routes_of(vehicles, missions)
    aircraft = make_aircraft(first.airframe, first.terrain.as_array(), first.gusts, first.steady_wind_m_s)
    law = Law(gains_of(vehicles), first.arm == "plain", first.swarm_clock)
    longest = routes.duration_s.max()
    if first.swarm_clock:
        longest = longest_s(longest)
    n, ticks = len(vehicles), int((longest + OVERTIME_S) / TICK_S)
    normals = np.empty((n, ticks, NORMALS_PER_TICK))
    for p, vehicle in enumerate(vehicles):
        generator(vehicle.seed, vehicle.sysid, Stream.GUSTS).standard_normal(out=normals[p])
    draws = draws_of(first.network, first.seed, ticks)
    wiring = wiring_of(first.network)
    record = empty_record(n, len(wiring.sender), ticks)
    avoiding = avoiding_of(first, ticks)
    flown = compile_shared(fly_swarm)(routes, aircraft, wiring, law, normals, draws, avoiding, record)
    rows = {vehicle.sysid: (p, slice(min(flown, wiring.death[p]))) for p, vehicle in enumerate(vehicles)}
    return Flown(
        {sysid: record.truth[row] for sysid, row in rows.items()},
        {
            vehicle.sysid: int(tick) if tick >= 0 else None
            for vehicle, tick in zip(vehicles, record.arrived, strict=True)
        },
        edge_changes(record, first.network),
        {sysid: record.along_rate_m_s[row] for sysid, row in rows.items()},
        {sysid: record.thrust_n[row] for sysid, row in rows.items()},
        {sysid: record.shifts[row][:, ::2] for sysid, row in rows.items()} if first.swarm_clock else {},
        {sysid: yieldings_of(avoiding, p, ticks, first.network) for sysid, (p, ticks) in rows.items()},
    )


def gains_of(vehicles: Sequence[VehicleConfig]) -> FloatArray:
    """(n, 4) gains that each flies with: those of corrections are none in the arms that hear nobody."""
    deaf = vehicles[0].arm != "full"
    return np.array([vehicle.gains._replace(k1=0.0, k2=0.0) if deaf else vehicle.gains for vehicle in vehicles])


def edge_changes(record: Record, network: Network) -> list[EdgeChange]:
    """Each change of an edge, in order."""
    changes = []
    for used, (sender, receiver) in zip(record.used, links_of(network), strict=True):
        heard = used[: network.deaths.get(receiver)]
        for tick in np.flatnonzero(np.diff(heard, prepend=False)).tolist():
            changes.append((tick, sender, receiver, bool(used[tick])))
    return sorted(changes)
