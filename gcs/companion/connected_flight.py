"""Flying a plan on vehicles that are there already, whatever simulates or flies them: a station with a companion each.

Wait until all are ready, upload and verify, change to AUTO, arm all in one second, and keep them together by the
airspeeds that `gcs.companion` commands.
"""

import asyncio
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from gcs.companion.companion import Companion
from gcs.companion.run import Announce, Companionship, accompany
from gcs.fleet import Fleet
from gcs.operations import change_mode, upload_plan
from gcs.transfers.command import arm, command, disarm
from gcs.transfers.errors import TransferError
from gcs.transfers.for_all import for_all
from gcs.vehicle_link import VehicleLink
from gcs.watch import Display, VehicleStatus
from missions.errors import InputError
from missions.vehicle_plan import Plan
from sitl.formation.correction import Correction
from sitl.modes import Mode

PERIOD_S = 0.1
HEARD_S = 30.0
"""For the first heartbeats."""
READY_S = 180.0
"""For pre-arm checks to pass: a receiver that has just been switched on looks for its satellites."""
SILENT_S = 10.0
"""A vehicle that is silent for longer, while others are heard, is flown on without."""


@dataclass(frozen=True)
class Arrival:
    """How one vehicle's flight ended.

    Attributes:
        planned_s: since the launch.
        arrived_s: the same, by its own clock; None when it did not arrive.
        along_rms_m, along_max_m: deviation from its schedule, over the flight.
        started_s: when it was armed, seconds after the first.
    """

    sysid: int
    name: str
    planned_s: float
    arrived_s: float | None
    along_rms_m: float | None
    along_max_m: float | None
    started_s: float


async def fly_connected(shared: Companionship, fleet: Fleet, announce: Announce, display: Display) -> list[Arrival]:
    """Fly a plan on the vehicles of a fleet; one has the system id of each of the plan's.

    Raises:
        InputError: vehicles are missing or not ready; nobody has been armed then.
        TransferError: an upload failed, or one could not be armed; those that had been are disarmed or sent home.
    """
    announce(f"Waiting for vehicles {', '.join(map(str, shared.slots))}")
    vehicles = await fleet.wait_for(shared.slots, HEARD_S)
    await fleet.hear_out()
    fleet.check()
    announce("Uploading missions and reading them back")
    missions = {uav.sysid: Plan(uav.mission) for uav in shared.plan.uavs}
    _require(await for_all(vehicles, lambda one: upload_plan(one, missions[one.sysid])))
    _require(await for_all(vehicles, lambda one: change_mode(one, Mode.AUTO)))
    announce("Waiting until all are ready to arm")
    await _until_ready(vehicles)
    logs = {vehicle.sysid: _Log() for vehicle in vehicles}
    said: dict[int, Correction] = {}
    tasks = [
        asyncio.create_task(_accompany(vehicle, shared, said, logs[vehicle.sysid], announce)) for vehicle in vehicles
    ]
    try:
        announce("Arming")
        await _arm_all(vehicles, logs)
        await _watch(shared, vehicles, tasks, logs, announce, display)
    finally:
        for task in tasks:
            task.cancel()
        await asyncio.gather(*tasks, return_exceptions=True)
    first = min(log.armed_at_s for log in logs.values())
    planned = shared.planned_s
    return [
        Arrival(
            uav.sysid,
            uav.name,
            planned[uav.sysid],
            logs[uav.sysid].arrived_s,
            logs[uav.sysid].along_rms_m,
            logs[uav.sysid].along_max_m,
            logs[uav.sysid].armed_at_s - first,
        )
        for uav in shared.plan.uavs
    ]


class _Log:
    """What is kept of one vehicle's flight."""

    def __init__(self) -> None:
        self.armed_at_s = 0.0
        self.arrived_s: float | None = None
        self.companion: Companion | None = None
        self.gone = False
        self.along_max_m: float | None = None
        self._squares, self._count = 0.0, 0

    @property
    def along_rms_m(self) -> float | None:
        return (self._squares / self._count) ** 0.5 if self._count else None

    def note(self, sample: Correction) -> None:
        """Take in a deviation."""
        if sample.in_formation:
            self._squares += sample.along_m**2
            self._count += 1
            self.along_max_m = max(self.along_max_m or 0.0, abs(sample.along_m))


async def _accompany(
    vehicle: VehicleLink, shared: Companionship, said: dict[int, Correction], log: _Log, announce: Announce
) -> None:
    def say(sample: Correction) -> None:
        said[sample.sysid] = sample
        log.note(sample)

    def make(order: Callable[[float], None]) -> Companion:
        log.companion = shared.companion(vehicle.sysid, say, lambda: said, order)
        return log.companion

    try:
        companion = await accompany(vehicle, make, announce)
    except TransferError as error:
        announce(f"{error}; it flies on alone")
        return
    log.arrived_s = companion.arrival_s


async def _until_ready(vehicles: list[VehicleLink]) -> None:
    """Until all say that their pre-arm checks pass. Raises InputError when some do not."""
    deadline = time.monotonic() + READY_S
    while waited_for := [one for one in vehicles if not _is_ready(one)]:
        if time.monotonic() > deadline:
            reasons = "; ".join(f"{one}: {one.texts[-1] if one.texts else 'does not say why'}" for one in waited_for)
            raise InputError(f"not ready to arm after {READY_S:g} s: {reasons}")
        for one in waited_for:
            if "SYS_STATUS" not in one.latest:
                await command(one, mavlink.MAV_CMD_REQUEST_MESSAGE, float(mavlink.MAVLINK_MSG_ID_SYS_STATUS))
        await asyncio.sleep(PERIOD_S)


def _is_ready(vehicle: VehicleLink) -> bool:
    status = vehicle.latest.get("SYS_STATUS")
    return status is not None and bool(status.onboard_control_sensors_health & mavlink.MAV_SYS_STATUS_PREARM_CHECK)


async def _arm_all(vehicles: list[VehicleLink], logs: Mapping[int, _Log]) -> None:
    async def arm_one(vehicle: VehicleLink) -> None:
        await arm(vehicle)
        logs[vehicle.sysid].armed_at_s = time.monotonic()

    results = await for_all(vehicles, arm_one)
    if any(isinstance(result, TransferError) for result in results.values()):
        armed = [one for one in vehicles if not isinstance(results[one.sysid], TransferError)]
        await for_all(armed, _call_off)
    _require(results)


async def _call_off(vehicle: VehicleLink) -> None:
    """Disarm; one that is in the air already is sent home."""
    try:
        await disarm(vehicle)
    except TransferError:
        await change_mode(vehicle, Mode.RTL)


def _require(results: Mapping[int, object]) -> None:
    """Raises TransferError with all that went wrong."""
    failed = [str(result) for result in results.values() if isinstance(result, TransferError)]
    if failed:
        raise TransferError("; ".join(failed))


async def _watch(
    shared: Companionship,
    vehicles: list[VehicleLink],
    tasks: list[asyncio.Task[None]],
    logs: Mapping[int, _Log],
    announce: Announce,
    display: Display,
) -> None:
    """Until every companion has ended, or its vehicle is silent while others are heard."""
    planned = shared.planned_s
    statuses = [
        VehicleStatus(uav.sysid, uav.name, planned[uav.sysid], planned[uav.sysid], len(uav.mission))
        for uav in shared.plan.uavs
    ]
    while not all(task.done() for task in tasks):
        for vehicle, status, task in zip(vehicles, statuses, tasks, strict=True):
            status.update(vehicle)
            if vehicle.silent_s > SILENT_S and not logs[vehicle.sysid].gone and not task.done():
                logs[vehicle.sysid].gone = status.silent = True
                announce(f"{vehicle}: silent for {SILENT_S:g} s; the others fly on")
            elif logs[vehicle.sysid].gone and vehicle.heard:
                logs[vehicle.sysid].gone = status.silent = False
                announce(f"{vehicle}: is heard again")
        display(statuses)
        left = [log for log, task in zip(logs.values(), tasks, strict=True) if not task.done()]
        if left and all(log.gone for log in left):
            return
        await asyncio.sleep(PERIOD_S)
