"""What an operator asks of a vehicle: take a plan, say what it holds, change its mode, come home.

Plans here begin with home, whatever the autopilot; the vehicle gets and gives them in its own form.
"""

import asyncio
from collections.abc import Callable

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from gcs.flight_modes import custom_mode
from gcs.transfers.command import command, disarm, set_mode
from gcs.transfers.errors import TransferError
from gcs.transfers.plans import download, upload_and_verify
from gcs.vehicle_link import VehicleLink
from missions.autopilot import Autopilot
from missions.dialect import wire_items
from missions.errors import InputError
from missions.fence import NO_FENCE, fence_items, parse_fence
from missions.formats.qgc_plan import home_item
from missions.mission import Mission, MissionItem
from missions.plan_type import PlanType
from missions.px4 import mission_of_px4, px4_mission
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
        TransferError: the autopilot would not take it, a transfer failed, or the vehicle holds something else.
    """
    items = _mission_on_wire(vehicle, plan.mission)
    counts = {"mission": await upload_and_verify(vehicle, PlanType.MISSION, items)}
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
    items = await download(vehicle, PlanType.MISSION)
    fence = await download(vehicle, PlanType.FENCE)
    rally = await download(vehicle, PlanType.RALLY)
    if vehicle.autopilot is Autopilot.px4:
        mission = mission_of_px4(items, await home_of(vehicle))
    elif items:
        mission = Mission(items)
    else:
        raise TransferError(f"{vehicle}: holds no home; wait until it has a position")
    try:
        return Plan(mission, parse_fence(fence), rally)
    except InputError as error:
        raise TransferError(f"{vehicle}: {error}") from None


async def home_of(vehicle: VehicleLink) -> MissionItem:
    """Where a vehicle's home is, by its HOME_POSITION. Raises TransferError when it does not tell."""
    home = await _newest(vehicle, "HOME_POSITION", mavlink.MAVLINK_MSG_ID_HOME_POSITION)
    if home is None:
        raise TransferError(f"{vehicle}: has no home; wait until it has a position")
    return home_item(home.latitude, home.longitude, home.altitude / 1000.0)


def _mission_on_wire(vehicle: VehicleLink, mission: Mission) -> tuple[MissionItem, ...]:
    """A mission as the vehicle's autopilot has it. Raises TransferError when that would not take it."""
    if vehicle.autopilot is Autopilot.px4:
        try:
            mission = px4_mission(mission)
        except InputError as error:
            raise TransferError(f"{vehicle}: {error}") from None
    return wire_items(mission, vehicle.autopilot)


def is_armed(vehicle: VehicleLink) -> bool:
    """Whether its last HEARTBEAT said that it is armed."""
    return _armed(vehicle.latest["HEARTBEAT"])


async def is_flying(vehicle: VehicleLink) -> bool:
    """Whether it says that it is in the air: a PX4 in EXTENDED_SYS_STATE, others in HEARTBEAT. Raises TransferError."""
    if vehicle.autopilot is Autopilot.px4:
        state = await _newest(vehicle, "EXTENDED_SYS_STATE", mavlink.MAVLINK_MSG_ID_EXTENDED_SYS_STATE)
        grounded = state is not None and state.landed_state == mavlink.MAV_LANDED_STATE_ON_GROUND
    else:
        grounded = vehicle.latest["HEARTBEAT"].system_status == mavlink.MAV_STATE_STANDBY
    return is_armed(vehicle) and not grounded


async def bring_home(vehicle: VehicleLink) -> str:
    """Send a flying vehicle home in mode RTL, disarm one on the ground, and see that it does so.

    Returns:
        What it does now.

    Raises:
        TransferError: it refused, did not answer, or its heartbeats do not show it.
    """
    if not is_armed(vehicle):
        return "on the ground, disarmed"
    if not await is_flying(vehicle):
        await disarm(vehicle)
        await heartbeat_shows(vehicle, "disarmed", lambda heartbeat: not _armed(heartbeat))
        return "on the ground, disarmed now"
    await change_mode(vehicle, Mode.RTL)
    return "flying home (RTL)"


async def change_mode(vehicle: VehicleLink, mode: Mode) -> None:
    """Change a vehicle's mode and see it in a HEARTBEAT. Raises TransferError."""
    await set_mode(vehicle, mode)
    number = custom_mode(mode, vehicle.autopilot)
    await heartbeat_shows(vehicle, f"mode {mode.name}", lambda heartbeat: heartbeat.custom_mode == number)


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


async def _newest(vehicle: VehicleLink, kind: str, message_id: int) -> Message | None:
    """The newest message of a kind, asked for if none has come yet. Raises TransferError when nobody answers."""
    if kind not in vehicle.latest:
        await command(vehicle, mavlink.MAV_CMD_REQUEST_MESSAGE, float(message_id))  # it comes before its ACK
    return vehicle.latest.get(kind)


def _armed(heartbeat: Message) -> bool:
    return bool(heartbeat.base_mode & mavlink.MAV_MODE_FLAG_SAFETY_ARMED)
