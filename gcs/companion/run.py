"""Companions at work: one vehicle's, with its neighbours over Zenoh, or those of all vehicles in one station."""

import asyncio
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from gcs.companion.companion import Companion
from gcs.flight_modes import custom_mode
from gcs.transfers.command import command_long, send_command
from gcs.transfers.errors import TransferError
from gcs.transfers.message_interval import set_message_interval
from gcs.vehicle_link import VehicleLink
from missions.reference import Reference
from missions.scenario import Scenario
from planner.formation_plan import FormationPlan
from sitl.formation.correction import Correction
from sitl.formation.graph import edges, neighbour_weights
from sitl.modes import Mode

TELEMETRY_HZ = 5
TELEMETRY = (mavlink.MAVLINK_MSG_ID_GLOBAL_POSITION_INT, mavlink.MAVLINK_MSG_ID_VFR_HUD)
PERIOD_S = 0.1
"""How often it is looked whether a flight is over."""
UNCHANGED = -1.0
"""DO_CHANGE_SPEED's throttle."""

Announce = Callable[[str], None]


@dataclass(frozen=True)
class Companionship:
    """What all companions of a plan share.

    Attributes:
        scenario, plan: that is flown.
    """

    scenario: Scenario
    plan: FormationPlan

    @property
    def slots(self) -> list[int]:
        """System ids in the plan."""
        return [uav.sysid for uav in self.plan.uavs]

    @cached_property
    def references(self) -> dict[int, Reference]:
        """What each vehicle is to fly."""
        return dict(self.plan.references(self.scenario))

    @property
    def planned_s(self) -> dict[int, float]:
        """How long each is to fly."""
        return {slot: reference.duration_s for slot, reference in self.references.items()}

    def weights(self, slot: int) -> dict[int, float]:
        """a_pq of a slot's neighbours."""
        return neighbour_weights(slot, edges(self.scenario.formation.graph, self.slots))

    def companion(
        self,
        slot: int,
        say: Callable[[Correction], None],
        heard: Callable[[], Mapping[int, Correction]],
        command: Callable[[float], None],
    ) -> Companion:
        """A companion for the vehicle in a slot."""
        scenario = self.scenario
        return Companion(
            slot,
            self.references[slot],
            scenario.frame,
            scenario.airframe.airframe(),
            self.weights(slot),
            scenario.formation.stale_s,
            say,
            heard,
            command,
        )


async def accompany(
    vehicle: VehicleLink,
    make: Callable[[Callable[[float], None]], Companion],
    announce: Announce,
) -> Companion:
    """Accompany a vehicle until its path is over; it is left alone while it is in another mode than AUTO.

    Args:
        vehicle: who is accompanied.
        make: makes the companion, given what commands an airspeed.
        announce: called with what goes wrong, and with its launch, for people to read.

    Returns:
        The companion, as it ended.
    """
    orders = _SpeedOrders(vehicle, announce)
    companion = make(orders.ask)
    launched = False
    with vehicle.listening(companion.on_message):
        await _request_telemetry(vehicle, announce)
        while not companion.done:
            if companion.fix is not None and not launched:
                launched = True
                late = f", {companion.late_start_m:.0f} m along its path" if companion.late_start_m > 500.0 else ""
                announce(f"{vehicle}: in the air{late}")
            await asyncio.sleep(PERIOD_S)
    await orders.finish()
    return companion


class _SpeedOrders:
    """Sends the newest airspeed asked for, one command at a time.

    Args:
        vehicle: who is told.
        announce: called with refusals, each once.
    """

    def __init__(self, vehicle: VehicleLink, announce: Announce) -> None:
        self._vehicle = vehicle
        self._announce = announce
        self._wanted: float | None = None
        self._task: asyncio.Task[None] | None = None
        self._said: set[str] = set()

    def ask(self, airspeed_m_s: float) -> None:
        """Have the vehicle fly at an airspeed, if it flies its mission."""
        if not _in_auto(self._vehicle):
            return
        self._wanted = airspeed_m_s
        if self._task is None or self._task.done():
            self._task = asyncio.create_task(self._send())

    async def finish(self) -> None:
        """Wait for what is on its way."""
        if self._task is not None:
            await self._task

    async def _send(self) -> None:
        while (airspeed := self._wanted) is not None:
            self._wanted = None
            order = command_long(mavlink.MAV_CMD_DO_CHANGE_SPEED, mavlink.SPEED_TYPE_AIRSPEED, airspeed, UNCHANGED)
            try:
                result = await send_command(self._vehicle, order)
            except TransferError as error:
                self._complain(str(error))
                return
            if result != mavlink.MAV_RESULT_ACCEPTED:
                self._complain(f"{self._vehicle}: refuses DO_CHANGE_SPEED with result {result}")

    def _complain(self, line: str) -> None:
        if line not in self._said:
            self._said.add(line)
            self._announce(line)


def _in_auto(vehicle: VehicleLink) -> bool:
    """Whether a vehicle flies its mission, as far as its mode says."""
    heartbeat = vehicle.latest.get("HEARTBEAT")
    return heartbeat is not None and heartbeat.custom_mode == custom_mode(Mode.AUTO, vehicle.autopilot)


async def _request_telemetry(vehicle: VehicleLink, announce: Announce) -> None:
    for message_id in TELEMETRY:
        if not await set_message_interval(vehicle, message_id, 1.0 / TELEMETRY_HZ):
            announce(f"{vehicle}: sends message {message_id} at its own rate, not {TELEMETRY_HZ} times a second")
