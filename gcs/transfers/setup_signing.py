"""Giving a vehicle a signing key: SETUP_SIGNING, repeated until it signs with the new key."""

import asyncio
import contextlib
import time

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from gcs.transfers.errors import TransferError
from gcs.vehicle_link import VehicleLink
from sitl.services.peer import Message
from sitl.services.received import SIGNED
from sitl.services.round_trip import TRIES
from sitl.services.signing import NO_KEY, Signer, Signing, Verdict

PATIENCE_S = 1.5
"""How long a vehicle has to say something signed with the new key: a heartbeat comes each second."""


async def setup_signing(vehicle: VehicleLink, signing: Signing) -> None:
    """Give a vehicle the key of `signing`, or take its key away when that has none; the station follows it.

    The key goes over the link in clear, so that had better be a cable.

    Raises:
        TransferError: it does not sign with the key; the station keeps the old one.
    """
    old = vehicle.signing
    change = _Rekeying(old, signing)
    vehicle.signing = change
    said = len(vehicle.texts)
    news = asyncio.Event()

    def on_message(message: Message) -> None:
        if change.confirmed:
            news.set()

    async with vehicle.transfer_lock:
        with vehicle.listening(on_message):
            for _ in range(TRIES):
                if change.confirmed:
                    break
                vehicle.send(_setup(vehicle, signing.key))
                with contextlib.suppress(TimeoutError):
                    async with asyncio.timeout(PATIENCE_S):
                        await news.wait()
    vehicle.signing = signing if change.confirmed else old
    if not change.confirmed:
        words = "; ".join(vehicle.texts[said:])
        wanted = "sign with the new key" if signing.key is not None else "stop signing"
        raise TransferError(f"{vehicle}: does not {wanted}" + (f"; it says: {words}" if words else ""))


def _setup(vehicle: VehicleLink, key: bytes | None) -> Message:
    timestamp = 0 if key is None else Signing.timestamp_at(time.time())
    return mavlink.MAVLink_setup_signing_message(vehicle.sysid, vehicle.compid, key or NO_KEY, timestamp)


class _Rekeying:
    """Between two keys: the old one is used until the vehicle is heard with the new one."""

    def __init__(self, old: Signer, new: Signing) -> None:
        self.confirmed = False
        self._old = old
        self._new = new

    def sign(self, frame: bytes, link_id: int) -> bytes:
        return (self._new if self.confirmed else self._old).sign(frame, link_id)

    def judge(self, frame: bytes) -> Verdict:
        as_told = bool(frame[2] & SIGNED) == (self._new.key is not None)
        if as_told and self._new.judge(frame) is Verdict.GOOD:
            self.confirmed = True
            return Verdict.GOOD
        return Verdict.WRONG if self.confirmed else self._old.judge(frame)
