"""The same work with many vehicles at once, where the failure of one is no reason to stop the others."""

import asyncio
from collections.abc import Awaitable, Callable, Iterable
from typing import TypeVar

from gcs.transfers.errors import TransferError
from gcs.vehicle_link import VehicleLink

Result = TypeVar("Result")


async def for_all(
    vehicles: Iterable[VehicleLink], work: Callable[[VehicleLink], Awaitable[Result]]
) -> dict[int, Result | TransferError]:
    """Do the work with all vehicles at once; returns each one's result or error by system id, in the order given."""

    async def one(vehicle: VehicleLink) -> Result | TransferError:
        try:
            return await work(vehicle)
        except TransferError as error:
            return error

    chosen = list(vehicles)
    results = await asyncio.gather(*(one(vehicle) for vehicle in chosen))
    return {vehicle.sysid: result for vehicle, result in zip(chosen, results, strict=True)}
