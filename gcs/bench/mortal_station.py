"""A station on a socket of its own that stops after so many messages of a transfer, wherever that is."""

import os
import signal
import socket
import time
from collections.abc import Callable, Sequence
from multiprocessing import get_context
from multiprocessing.connection import wait
from typing import Any

from gcs import station
from gcs.bench.peers import LOOPBACK
from gcs.transfers.acquaintance import Acquaintance
from gcs.transfers.plan_upload import PlanUpload
from gcs.transfers.transfer import Transfer
from missions.mission import MissionItem
from missions.plan_type import PlanType
from sitl.services.codec import Codec
from sitl.services.peer import Message

_COUNTED = frozenset({
    "MISSION_COUNT", "MISSION_REQUEST", "MISSION_REQUEST_INT", "MISSION_ITEM", "MISSION_ITEM_INT", "MISSION_ACK"
})  # fmt: skip
"""What a step is: one of these, sent or received."""


class MortalStation:
    """A station that runs transfers with one endpoint over UDP.

    Args:
        udp_port: of the endpoint.
        sysid: of its vehicle.
        end: the socket that it speaks from, so that another can go on at the same address; None for one of its own.
    """

    def __init__(self, udp_port: int, sysid: int, end: socket.socket | None = None) -> None:
        self._end = end or socket_for_a_station()
        self._address = (LOOPBACK, udp_port)
        self._sysid = sysid
        self._codec = Codec(station.SYSID, station.COMPID)
        self._left: int | None = None

    def run(
        self,
        make: Callable[..., Transfer[Any]],
        steps: int | None = None,
        endpoint: int | None = None,
    ) -> Any:
        """Run a transfer to its outcome, or for so many steps.

        Args:
            make: makes it from the last arguments of Transfer.
            steps: messages after which it stops; None for no end.
            endpoint: the sentinel of the endpoint's process, with which it stops too; None where that lives.

        Returns:
            The outcome; None when it has stopped before.
        """
        self._left = steps
        transfer = make(self._sysid, 1, self._send, time.monotonic, Acquaintance())
        transfer.start()
        waited_for: list[socket.socket | int] = [self._end] if endpoint is None else [self._end, endpoint]
        while transfer.outcome is None and self._left != 0:
            ready = wait(waited_for, max(0.0, transfer.deadline_s - time.monotonic()))
            if self._end in ready:
                self._hear(transfer)
            elif ready:
                return None
            transfer.on_tick()
        return None if self._left == 0 else transfer.outcome

    def close(self) -> None:
        """Close its socket."""
        self._end.close()

    def _send(self, message: Message) -> None:
        if self._left == 0:
            return
        self._end.sendto(self._codec.pack(message), self._address)
        self._count(message)

    def _hear(self, transfer: Transfer[Any]) -> None:
        for message in self._codec.feed(self._end.recv(65536)):
            self._count(message)
            if self._left == 0:
                return
            transfer.on_message(message)

    def _count(self, message: Message) -> None:
        if self._left and message.get_type() in _COUNTED:
            self._left -= 1


def socket_for_a_station() -> socket.socket:
    """A UDP socket of the loopback."""
    end = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    end.bind((LOOPBACK, 0))
    return end


def upload_and_die(
    udp_port: int, sysid: int, end: socket.socket, plan: PlanType, items: Sequence[MissionItem], steps: int
) -> bool:
    """Upload in a process of its own, which is killed after so many steps; whether it was, or had come to its end."""
    arguments = (udp_port, sysid, end, plan, tuple(items), steps)
    process = get_context("forkserver").Process(target=_upload_and_die, args=arguments, daemon=True)
    process.start()
    process.join()
    return process.exitcode == -signal.SIGKILL


def _upload_and_die(
    udp_port: int, sysid: int, end: socket.socket, plan: PlanType, items: Sequence[MissionItem], steps: int
) -> None:
    if MortalStation(udp_port, sysid, end).run(lambda *link: PlanUpload(plan, items, *link), steps) is None:
        os.kill(os.getpid(), signal.SIGKILL)
