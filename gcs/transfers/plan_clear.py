"""Clearing a plan: MISSION_CLEAR_ALL."""

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from gcs.transfers.errors import TransferError
from gcs.transfers.plan_transfer import PlanTransfer
from sitl.services.peer import Message


class PlanClear(PlanTransfer[bool]):
    """Has one plan of a vehicle removed; of a mission home remains.

    The outcome is whether the vehicle has confirmed it; when it has not, only reading back can tell.
    """

    what = "clear"

    def _begin(self) -> None:
        self._ask(mavlink.MAVLink_mission_clear_all_message(*self._target, self._plan_type))

    def _take_plan_message(self, kind: str, message: Message) -> None:
        if kind != "MISSION_ACK":
            return
        if message.type == mavlink.MAV_MISSION_ACCEPTED:
            self._answered(message)
            self.outcome = True
        else:
            self._take_refusal(int(message.type))

    def _give_up(self) -> "bool | TransferError":
        return self._stopped() if self._last_heard is None else False

    def _where(self) -> str:
        return "MISSION_CLEAR_ALL"
