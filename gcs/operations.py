"""What an operator asks of a vehicle: take a plan, say what it holds, change its mode, come home."""

import asyncio
from collections.abc import Callable

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from gcs.transfers.command import disarm, set_mode
from gcs.transfers.errors import TransferError
from gcs.transfers.plans import download, upload_and_verify
from gcs.vehicle_link import VehicleLink
from missions.errors import InputError
from missions.fence import NO_FENCE, fence_items, parse_fence
from missions.mission import Mission
from missions.plan_type import PlanType
from missions.vehicle_plan import Plan
from sitl.modes import Mode
from sitl.services.peer import Message

CONFIRM_TIMEOUT_S = 5.0
"""For a HEARTBEAT that shows what was commanded."""


async def upload_plan(vehicle: VehicleLink, plan: Plan) -> dict[str, int]:
    """Bring all of a plan that is not empty to a vehicle, read back and compared, the mission first.

    Returns:
        The number of items that the vehicle holds now, by what they are.

    Raises:
        TransferError: a transfer failed, or the vehicle holds something else.
    """
    counts = {"mission": await upload_and_verify(vehicle, PlanType.MISSION, plan.mission.items)}
    if plan.fence != NO_FENCE:
        counts["fence"] = await upload_and_verify(vehicle, PlanType.FENCE, fence_items(plan.fence))
    if plan.rally:
        counts["rally"] = await upload_and_verify(vehicle, PlanType.RALLY, plan.rally)
    return counts


async def download_plan(vehicle: VehicleLink) -> Plan:
    """All that a vehicle holds.

    Raises:
        TransferError: a transfer failed, or what the vehicle holds is no plan.
    """
    mission = await download(vehicle, PlanType.MISSION)
    fence = await download(vehicle, PlanType.FENCE)
    rally = await download(vehicle, PlanType.RALLY)
    if not mission:
        raise TransferError(f"{vehicle}: holds no home; wait until it has a position")
    try:
        return Plan(Mission(mission), parse_fence(fence), rally)
    except InputError as error:
        raise TransferError(f"{vehicle}: {error}") from None


def is_armed(vehicle: VehicleLink) -> bool:
    """Whether its last HEARTBEAT said that it is armed."""
    return _armed(vehicle.latest["HEARTBEAT"])


def is_flying(vehicle: VehicleLink) -> bool:
    """Whether its last HEARTBEAT said that it is in the air."""
    return bool(is_armed(vehicle) and vehicle.latest["HEARTBEAT"].system_status != mavlink.MAV_STATE_STANDBY)


async def bring_home(vehicle: VehicleLink) -> str:
    """Send a flying vehicle home in mode RTL, disarm one on the ground, and see that it does so.

    Returns:
        What it does now.

    Raises:
        TransferError: it refused, did not answer, or its heartbeats do not show it.
    """
    if not is_armed(vehicle):
        return "on the ground, disarmed"
    if not is_flying(vehicle):
        await disarm(vehicle)
        await heartbeat_shows(vehicle, "disarmed", lambda heartbeat: not _armed(heartbeat))
        return "on the ground, disarmed now"
    await set_mode(vehicle, Mode.RTL)
    await heartbeat_shows(vehicle, "mode RTL", lambda heartbeat: heartbeat.custom_mode == Mode.RTL)
    return "flying home (RTL)"


async def change_mode(vehicle: VehicleLink, mode: Mode) -> None:
    """Change a vehicle's mode and see it in a HEARTBEAT. Raises TransferError."""
    await set_mode(vehicle, mode)
    await heartbeat_shows(vehicle, f"mode {mode.name}", lambda heartbeat: heartbeat.custom_mode == mode)


async def heartbeat_shows(vehicle: VehicleLink, what: str, shown: Callable[[Message], bool]) -> None:
    """Wait until a HEARTBEAT shows something. Raises TransferError when none does in time."""
    seen = asyncio.Event()

    def on_message(message: Message) -> None:
        if message.get_type() == "HEARTBEAT" and shown(message):
            seen.set()

    with vehicle.listening(on_message):
        try:
            async with asyncio.timeout(CONFIRM_TIMEOUT_S):
                await seen.wait()
        except TimeoutError:
            raise TransferError(
                f"{vehicle}: accepted, but no heartbeat shows {what} within {CONFIRM_TIMEOUT_S:g} s"
            ) from None


def _armed(heartbeat: Message) -> bool:
    return bool(heartbeat.base_mode & mavlink.MAV_MODE_FLAG_SAFETY_ARMED)
