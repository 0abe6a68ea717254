"""One flight of a swarm, rehearsed."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from missions.compiled import compile_shared
from missions.mission import Mission
from sitl.aircraft.gusts import NORMALS_PER_TICK
from sitl.config import VehicleConfig
from sitl.flight import make_aircraft
from sitl.noise import Stream, generator
from sitl.rehearsal.kernel import Law, Record, fly_swarm
from sitl.rehearsal.network import network_of
from sitl.rehearsal.routes import routes_of
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
    """

    truth: dict[int, FloatArray]
    arrived: dict[int, int | None]


def rehearse(vehicles: Sequence[VehicleConfig], missions: Mapping[int, Mission]) -> Flown:
    """Fly a swarm's missions from a held start, as its endpoints would.

    Args:
        vehicles: of the swarm, in order of sysid; one airframe, terrain, wind, law and delay for all.
        missions: by sysid, waypoints and speeds with a loiter at the end.

    Raises:
        InputError: a mission cannot be flown, or is more than that.
    """
    first = vehicles[0]
    routes = routes_of(vehicles, missions)
    aircraft = make_aircraft(first.airframe, first.terrain.as_array(), first.gusts, first.steady_wind_m_s)
    gains = first.gains if first.arm == "full" else first.gains._replace(k1=0.0, k2=0.0)
    law = Law(gains, first.arm == "plain")
    network = network_of(vehicles)
    n, ticks = len(vehicles), int((routes.duration_s.max() + OVERTIME_S) / TICK_S)
    normals = np.empty((n, ticks, NORMALS_PER_TICK))
    for p, vehicle in enumerate(vehicles):
        generator(vehicle.seed, vehicle.sysid, Stream.GUSTS).standard_normal(out=normals[p])
    record = Record(
        truth=np.empty((n, ticks, 6)),
        in_formation=np.zeros((n, ticks), dtype=np.bool_),
        along_m=np.empty((n, ticks)),
        along_rate_m_s=np.empty((n, ticks)),
        arrived=np.full(n, -1),
    )
    flown = compile_shared(fly_swarm)(routes, aircraft, network, law, normals, record)
    return Flown(
        {vehicle.sysid: record.truth[p, :flown] for p, vehicle in enumerate(vehicles)},
        {
            vehicle.sysid: int(tick) if tick >= 0 else None
            for vehicle, tick in zip(vehicles, record.arrived, strict=True)
        },
    )
