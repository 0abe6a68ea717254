"""A small PX4 plane over UDP: its mission protocol, modes and commands, as its sources have them. It flies on rails."""

import contextlib
import math
import socket
import threading
from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from pymavlink.dialects.v20 import ardupilotmega as mavlink

from gcs.bench.peers import LOOPBACK
from missions.commands import Frame
from missions.frame import LocalFrame
from missions.mission import MissionItem
from missions.reference import Reference
from sitl.services.codec import Codec
from sitl.services.mission_items import decode_item

TURN_S = 0.02
STEP_S = 0.1
HEARTBEAT_S = 0.2
CAPACITY = 500
HOLD, MISSION_MODE, RTL = 4 << 16 | 3 << 24, 4 << 16 | 4 << 24, 4 << 16 | 5 << 24
STATION = (255, 190)
PARAMS_KEPT = {16: (1, 2, 4), 17: (3, 4), 21: (2, 4), 22: (4,), 31: (2,)}
"""By command; items in frame MISSION keep all. Others with a place are unsupported here."""


class FakePx4:
    """One PX4, in a thread of its own until it is closed; it talks to the station that was heard last.

    Args:
        sysid: its system id.
        home: where it stands, latitude and longitude in 1e-7 degrees, altitude AMSL in metres; None for no fix yet.
        reference, frame: what it flies on once it is armed in Mission.
        speed: simulated seconds a second.

    Attributes:
        url: for a station to call it.
        plans: items held, by mission_type.
        begins_at: the item that a flight begins with.
        custom_mode, armed: as in its heartbeats.
        flown_s: how long it has been in the air, simulated time.
        commands: MAV_CMD numbers that it was sent, in order.
        airspeeds_m_s: that it was told in flight.
    """

    def __init__(
        self,
        sysid: int,
        home: tuple[int, int, float] | None = None,
        reference: Reference | None = None,
        frame: LocalFrame | None = None,
        speed: float = 80.0,
    ) -> None:
        self.plans: dict[int, tuple[MissionItem, ...]] = {0: (), 1: (), 2: ()}
        self.begins_at = 0
        self.custom_mode, self.armed = HOLD, False
        self.commands: list[int] = []
        self.airspeeds_m_s: list[float] = []
        self._home, self._reference, self._frame, self._speed = home, reference, frame, speed
        self.flown_s = self._time_s = 0.0
        self._upload: list[MissionItem] | None = None
        self._count = self._type = self._marked = 0
        self._sending: int | None = None
        self._codec = Codec(sysid, 1)
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._socket.bind((LOOPBACK, 0))
        self._socket.settimeout(TURN_S)
        self.url = f"udpout://{LOOPBACK}:{self._socket.getsockname()[1]}"
        self._station: tuple[str, int] | None = None
        self._stopped = threading.Event()
        self._thread = threading.Thread(target=self._run)
        self._thread.start()

    def close(self) -> None:
        self._stopped.set()
        self._thread.join()
        self._socket.close()

    def _run(self) -> None:
        turn = 0
        while not self._stopped.is_set():
            with contextlib.suppress(TimeoutError, ConnectionRefusedError):
                while True:
                    data, self._station = self._socket.recvfrom(65536)
                    for message in self._codec.feed(data):
                        self._take(message)
            if turn % round(HEARTBEAT_S / TURN_S) == 0:
                self._say_how_it_is()
            turn += 1
            self._fly()

    def _send(self, message: Any) -> None:
        if self._station is not None:
            with contextlib.suppress(ConnectionRefusedError):
                self._socket.sendto(self._codec.pack(message), self._station)

    def _say_how_it_is(self) -> None:
        armed = mavlink.MAV_MODE_FLAG_SAFETY_ARMED if self.armed else 0
        state = mavlink.MAV_STATE_ACTIVE if self.armed else mavlink.MAV_STATE_STANDBY
        kind, px4 = mavlink.MAV_TYPE_FIXED_WING, mavlink.MAV_AUTOPILOT_PX4
        self._send(mavlink.MAVLink_heartbeat_message(kind, px4, armed | 1, self.custom_mode, state, 3))

    def _fly(self) -> None:
        """A turn's worth of the reference, and where that is."""
        self._time_s += TURN_S * self._speed
        if not (self.armed and self.custom_mode == MISSION_MODE and self.plans[0] and self._reference and self._frame):
            return
        self.flown_s += TURN_S * self._speed
        here, soon = self._reference.positions(np.array([self.flown_s, self.flown_s + STEP_S]))
        (x, y, z), (east, north, _) = here.tolist(), ((soon - here) / STEP_S).tolist()
        lat_e7, lon_e7 = self._frame.to_e7(x, y)
        alt_mm = round((z + self._frame.alt_m) * 1e3)
        now_ms = round(self._time_s * 1e3)
        self._send(mavlink.MAVLink_vfr_hud_message(math.hypot(east, north), 0.0, 0, 0, 0.0, 0.0))
        self._send(
            mavlink.MAVLink_global_position_int_message(
                now_ms, lat_e7, lon_e7, alt_mm, 0, round(north * 100), round(east * 100), 0, 0
            )
        )

    def _take(self, message: Any) -> None:
        kind = message.get_type()
        if kind == "COMMAND_LONG":
            self._send(mavlink.MAVLink_command_ack_message(message.command, self._obey(message)))
        elif kind == "MISSION_COUNT":
            self._begin(message)
        elif kind == "MISSION_ITEM_INT":
            self._receive(message)
        elif kind == "MISSION_REQUEST_LIST":
            self._type, self._sending = message.mission_type, 0
            held = len(self.plans[self._type])
            self._send(mavlink.MAVLink_mission_count_message(*STATION, held, self._type))
        elif kind == "MISSION_REQUEST_INT":
            self._give(message.seq)
        elif kind == "MISSION_CLEAR_ALL":
            self.plans[message.mission_type] = ()
            self._ack(mavlink.MAV_MISSION_ACCEPTED, message.mission_type)

    def _obey(self, message: Any) -> int:
        """Do what a command says; its MAV_RESULT."""
        self.commands.append(message.command)
        if message.command == mavlink.MAV_CMD_DO_SET_MODE:
            self.custom_mode = int(message.param2) << 16 | int(message.param3) << 24
        elif message.command == mavlink.MAV_CMD_COMPONENT_ARM_DISARM:
            if not message.param1 and self.flown_s:
                return int(mavlink.MAV_RESULT_DENIED)
            self.armed = bool(message.param1)
        elif message.command == mavlink.MAV_CMD_DO_CHANGE_SPEED:
            self.airspeeds_m_s.append(message.param2)
        elif message.command == mavlink.MAV_CMD_REQUEST_MESSAGE:
            return self._tell(int(message.param1))
        elif message.command != mavlink.MAV_CMD_SET_MESSAGE_INTERVAL:
            return int(mavlink.MAV_RESULT_UNSUPPORTED)
        self._say_how_it_is()
        return int(mavlink.MAV_RESULT_ACCEPTED)

    def _tell(self, message_id: int) -> int:
        if message_id == mavlink.MAVLINK_MSG_ID_SYS_STATUS:
            ready = mavlink.MAV_SYS_STATUS_PREARM_CHECK if self.plans[0] else 0
            self._send(mavlink.MAVLink_sys_status_message(*[ready] * 3, *[0] * 10))
        elif message_id == mavlink.MAVLINK_MSG_ID_EXTENDED_SYS_STATE:
            landed = mavlink.MAV_LANDED_STATE_IN_AIR if self.flown_s else mavlink.MAV_LANDED_STATE_ON_GROUND
            self._send(mavlink.MAVLink_extended_sys_state_message(0, landed))
        elif message_id == mavlink.MAVLINK_MSG_ID_HOME_POSITION and self._home is not None:
            lat_e7, lon_e7, alt_m = self._home
            rest = (*[0.0] * 3, [1.0, 0.0, 0.0, 0.0], *[0.0] * 3)
            self._send(mavlink.MAVLink_home_position_message(lat_e7, lon_e7, round(alt_m * 1e3), *rest))
        else:
            return int(mavlink.MAV_RESULT_DENIED)
        return int(mavlink.MAV_RESULT_ACCEPTED)

    def _begin(self, message: Any) -> None:
        if message.count > CAPACITY:
            self._ack(mavlink.MAV_MISSION_NO_SPACE, message.mission_type)
            return
        self._upload, self._count, self._type, self._marked = [], message.count, message.mission_type, 0
        self._send(mavlink.MAVLink_mission_request_int_message(*STATION, 0, self._type))

    def _receive(self, message: Any) -> None:
        """The next item of an upload; any other is ignored."""
        if self._upload is None or message.seq != len(self._upload):
            return
        item = decode_item(message)
        if item.frame != Frame.MISSION and self._type == 0:
            if item.command not in PARAMS_KEPT or item.frame not in (0, 3):
                self._upload = None
                self._ack(mavlink.MAV_MISSION_UNSUPPORTED, self._type)
                return
            lost = {f"param{n}": 0.0 for n in range(1, 5) if n not in PARAMS_KEPT[item.command]}
            item = replace(item, **lost)  # type: ignore[arg-type]
        if message.current:
            self._marked = message.seq
        self._upload.append(item)
        if len(self._upload) < self._count:
            self._send(mavlink.MAVLink_mission_request_int_message(*STATION, len(self._upload), self._type))
            return
        self.plans[self._type] = tuple(self._upload)
        self._upload = None
        if self._type == 0:
            self.begins_at = self._marked
        self._ack(mavlink.MAV_MISSION_ACCEPTED, self._type)

    def _give(self, seq: int) -> None:
        """An item in its turn, or the last once more; anything else ends a download."""
        items = self.plans[self._type]
        if self._sending is None:
            return
        if seq not in (self._sending, self._sending - 1) or seq >= len(items):
            self._sending = None
            self._ack(mavlink.MAV_MISSION_ERROR, self._type)
            return
        self._sending = seq + 1
        item = items[seq]
        frame = {0: 5, 3: 6}.get(item.frame, item.frame)
        place = (item.lat_e7, item.lon_e7, item.alt_m)
        self._send(
            mavlink.MAVLink_mission_item_int_message(
                *STATION, seq, frame, item.command, 0, int(item.autocontinue), *item.params, *place, self._type
            )
        )

    def _ack(self, result: int, plan: int) -> None:
        self._send(mavlink.MAVLink_mission_ack_message(*STATION, result, plan))


@pytest.fixture
def make_px4() -> Iterator[Callable[..., FakePx4]]:
    """PX4s that end with the test."""
    with contextlib.ExitStack() as stack:
        yield lambda *arguments, **more: stack.enter_context(contextlib.closing(FakePx4(*arguments, **more)))
