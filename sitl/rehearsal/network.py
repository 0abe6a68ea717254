"""Who hears whom in a swarm, as the kernel reads it."""

from collections.abc import Sequence

import numpy as np

from sitl.config import VehicleConfig
from sitl.rehearsal.kernel import Network


def network_of(vehicles: Sequence[VehicleConfig]) -> Network:
    """The links into each vehicle, neighbours in the order in which its pilot sums up their corrections."""
    row = {vehicle.sysid: p for p, vehicle in enumerate(vehicles)}
    counts = [len(vehicle.weights) for vehicle in vehicles]
    return Network(
        first_link=np.concatenate([[0], np.cumsum(counts)]).astype(np.int64),
        sender=np.array([row[sysid] for vehicle in vehicles for sysid in vehicle.weights], dtype=np.int64),
        weight=np.array([weight for vehicle in vehicles for weight in vehicle.weights.values()], dtype=np.float64),
        delay_ticks=vehicles[0].delay_ticks,
    )
