"""Driving transfers over a vehicle's link, in asyncio."""

import asyncio
import contextlib
import time
from collections.abc import Callable
from typing import TypeAlias, TypeVar

from gcs.transfers.compare import differences
from gcs.transfers.errors import TransferError
from gcs.transfers.mission_download import MissionDownload
from gcs.transfers.mission_upload import MissionUpload
from gcs.transfers.transfer import Transfer
from gcs.vehicle_link import VehicleLink
from missions.mission import Mission
from sitl.services.peer import Message

Result = TypeVar("Result")
Make: TypeAlias = Callable[[Callable[[Message], None], Callable[[], float]], Transfer[Result]]
"""Makes a transfer from its `send` and `now`."""


async def run(vehicle: VehicleLink, make: "Make[Result]") -> Result:
    """Run one transfer to its end; one at a time per vehicle.

    Raises:
        TransferError: it failed; the vehicle's own words are added.
    """
    async with vehicle.transfer_lock:
        said = len(vehicle.texts)
        transfer = make(vehicle.send, time.monotonic)
        news = asyncio.Event()

        def on_message(message: Message) -> None:
            transfer.on_message(message)
            news.set()

        with vehicle.listening(on_message):
            transfer.start()
            while transfer.outcome is None:
                with contextlib.suppress(TimeoutError):
                    async with asyncio.timeout(max(0.0, transfer.deadline_s - time.monotonic())):
                        await news.wait()
                news.clear()
                transfer.on_tick()
    if isinstance(transfer.outcome, TransferError):
        words = "; ".join(vehicle.texts[said:])
        raise TransferError(f"{transfer.outcome}; it says: {words}") if words else transfer.outcome
    return transfer.outcome


async def upload(vehicle: VehicleLink, mission: Mission) -> bool:
    """Upload a mission; returns whether the vehicle confirmed it. Raises TransferError."""
    uploaded = await run(vehicle, lambda send, now: MissionUpload(mission, vehicle.sysid, vehicle.compid, send, now))
    return uploaded.confirmed


async def download(vehicle: VehicleLink) -> Mission:
    """Download the mission that the vehicle holds. Raises TransferError."""
    return await run(vehicle, lambda send, now: MissionDownload(vehicle.sysid, vehicle.compid, send, now))


async def upload_and_verify(vehicle: VehicleLink, mission: Mission) -> int:
    """Upload a mission, read it back and compare.

    Returns:
        The number of items that the vehicle holds as sent; home, which is its own, counts as one of them.

    Raises:
        TransferError: the transfer failed, or the vehicle holds something else.
    """
    await upload(vehicle, mission)
    held = await download(vehicle)
    lines = differences(mission, held)
    if lines:
        raise TransferError(f"{vehicle}: holds another mission than was sent: {'; '.join(lines)}")
    return len(held)
