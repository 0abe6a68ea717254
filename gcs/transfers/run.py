"""Driving transfers over a vehicle's link, in asyncio."""

import asyncio
import logging
from collections.abc import Callable
from typing import TypeAlias, TypeVar

from gcs.transfers.acquaintance import Acquaintance
from gcs.transfers.errors import TransferError
from gcs.transfers.transfer import Transfer
from gcs.vehicle_link import VehicleLink
from sitl.services.peer import Message

_log = logging.getLogger(__name__)

Result = TypeVar("Result")
Make: TypeAlias = Callable[[int, int, Callable[[Message], None], Callable[[], float], Acquaintance], Transfer[Result]]
"""Makes a transfer from `sysid`, `compid`, `send`, `now` and `known`, as Transfer wants them."""


async def run(vehicle: VehicleLink, make: "Make[Result]") -> Result:
    """Run one transfer to its end; a caller who is cancelled leaves the vehicle told.

    The one transfer at a time that a vehicle takes is the caller's business: VehicleLink.transfer_lock.

    Raises:
        TransferError: it failed; the vehicle's own words are added.
    """
    loop = asyncio.get_running_loop()
    said = len(vehicle.texts)
    transfer = make(vehicle.sysid, vehicle.compid, vehicle.send, loop.time, vehicle.known)
    over = loop.create_future()
    began_s = loop.time()
    _log.debug("%s: %s begins", vehicle, type(transfer).__name__)
    timer: asyncio.TimerHandle

    def fail(error: Exception) -> None:
        """Let the caller have it: asyncio and the fleet would only log it, and he would wait for ever."""
        if not over.done():
            over.set_exception(error)

    def on_message(message: Message) -> None:
        try:
            transfer.on_message(message)
            look()
        except Exception as error:
            fail(error)

    def look() -> None:
        """See whether it is over, or due earlier than the timer thinks."""
        nonlocal timer
        if transfer.outcome is not None:
            timer.cancel()
            if not over.done():
                over.set_result(None)
        elif transfer.deadline_s < timer.when():
            timer.cancel()
            timer = loop.call_at(transfer.deadline_s, on_timer)

    def on_timer() -> None:
        nonlocal timer
        try:
            transfer.on_tick()
            timer = loop.call_at(transfer.deadline_s, on_timer)
            look()
        except Exception as error:
            fail(error)

    timer = loop.call_at(transfer.deadline_s, on_timer)
    try:
        with vehicle.listening(on_message):
            transfer.start()
            look()
            await over
    except asyncio.CancelledError:
        transfer.cancel()
        raise
    finally:
        timer.cancel()
    came = "failed" if isinstance(transfer.outcome, TransferError) else "done"
    _log.info("%s: %s %s, %.3f s", vehicle, type(transfer).__name__, came, loop.time() - began_s)
    if isinstance(transfer.outcome, TransferError):
        words = "; ".join(dict.fromkeys(vehicle.texts[said:]))
        raise TransferError(f"{transfer.outcome}; it says: {words}") if words else transfer.outcome
    assert transfer.outcome is not None
    return transfer.outcome
