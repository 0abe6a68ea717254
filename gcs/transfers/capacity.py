"""How many items a vehicle takes: it says so when it is offered more than any of them has room for.

No parameter tells. A MISSION_COUNT of 65535 is refused with NO_SPACE before anything is touched, by ArduPilot, PX4 and
Skein's endpoints; ArduPilot and endpoints say the limit in a STATUSTEXT, before or after that.
"""

import asyncio
import re

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from gcs.transfers.errors import TransferError
from gcs.transfers.plan_transfer import NOUNS, PlanTransfer
from gcs.transfers.run import run
from gcs.vehicle_link import VehicleLink
from missions.plan_type import PlanType
from sitl.services.peer import Message

OFFERED = 0xFFFF
TEXT_S = 1.0
"""For the text that follows the refusal."""
_LIMIT = re.compile(r"\b(?:only|at most) (\d+) items", re.IGNORECASE)


class PlanOffer(PlanTransfer[int]):
    """Offers more items than a vehicle takes; its outcome is the MAV_MISSION_RESULT. Who takes them is told to stop.

    Args:
        plan_type, sysid, compid, send, now, known: as of PlanTransfer.
    """

    what = "offer"

    def _begin(self) -> None:
        self._ask(mavlink.MAVLink_mission_count_message(*self._target, OFFERED, self._plan_type))

    def _take_plan_message(self, kind: str, message: Message) -> None:
        if kind == "MISSION_ACK":
            self._answered(message)
            self.outcome = int(message.type)
        elif kind in ("MISSION_REQUEST", "MISSION_REQUEST_INT"):
            self.cancel()
            self.outcome = int(mavlink.MAV_MISSION_ACCEPTED)

    def _give_up(self) -> "int | TransferError":
        return self._stopped()

    def _where(self) -> str:
        return f"MISSION_COUNT {OFFERED}"


async def capacity(vehicle: VehicleLink, plan_type: PlanType) -> int | None:
    """How many items a vehicle takes of a plan; None when it does not say, or not now: when it is not ready, or flies.

    Raises:
        TransferError: no answer comes.
    """
    said = len(vehicle.texts)
    news = asyncio.Event()

    def limit() -> int | None:
        found = [_LIMIT.search(text) for text in vehicle.texts[said:]]
        return next((int(match[1]) for match in found if match), None)

    with vehicle.listening(lambda _: news.set()):
        async with vehicle.transfer_lock:
            result = await run(vehicle, lambda *link: PlanOffer(plan_type, *link))
        if result != mavlink.MAV_MISSION_NO_SPACE:
            return None
        try:
            async with asyncio.timeout(TEXT_S):
                while limit() is None:
                    news.clear()
                    await news.wait()
        except TimeoutError:
            return None
    return limit() or None


async def capacities(vehicle: VehicleLink) -> dict[PlanType, int]:
    """How many items a vehicle takes of each plan of which it says so. Raises TransferError."""
    found = {plan_type: await capacity(vehicle, plan_type) for plan_type in NOUNS}
    return {plan_type: count for plan_type, count in found.items() if count is not None}
