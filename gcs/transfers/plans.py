"""What the station does with a vehicle's plans: upload and verify, download, clear."""

from collections.abc import Iterable, Sequence

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from gcs.transfers.compare import differences
from gcs.transfers.errors import TransferError
from gcs.transfers.plan_clear import PlanClear
from gcs.transfers.plan_download import PlanDownload
from gcs.transfers.plan_transfer import NOUNS
from gcs.transfers.plan_upload import PlanUpload
from gcs.transfers.run import run
from gcs.vehicle_link import VehicleLink
from missions.mission import MissionItem
from missions.plan_type import HELD, PlanType

ROUNDS = 3
"""How often a plan is uploaded that is not what is read back afterwards: a late message of an earlier transfer may have
been taken for one of this."""

_LARGEST_COUNT = 0xFFFF
_LINES = 5

_PLANES = frozenset({int(mavlink.MAV_TYPE_FIXED_WING), *range(19, 26)})
"""MAV_TYPE of fixed wings and of all VTOL kinds."""


async def upload_and_verify(vehicle: VehicleLink, plan_type: PlanType, items: Iterable[MissionItem]) -> int:
    """Upload a plan, read it back and compare.

    Args:
        vehicle: who gets it; a plane.
        plan_type: mission, fence or rally points.
        items: in order, as its autopilot has them on the wire (`missions.dialect.wire_items`).

    Returns:
        The number of items that the vehicle holds as sent; home, if it is one of them, is the vehicle's own.

    Raises:
        TransferError: the vehicle is no plane, the transfer failed, or the vehicle holds something else.
    """
    sent = tuple(items)
    _check(vehicle, plan_type, sent)
    async with vehicle.transfer_lock:
        lines: list[str] = []
        for _ in range(ROUNDS):
            await run(vehicle, lambda *link: PlanUpload(plan_type, sent, *link, home_first=_home_first(vehicle)))
            held = await run(vehicle, lambda *link: PlanDownload(plan_type, *link))
            lines = differences(plan_type, sent, held, vehicle.autopilot)
            if not lines:
                return len(held)
    raise TransferError(f"{vehicle}: holds another {_plan(plan_type)} than was sent: {_some(lines)}")


async def download(vehicle: VehicleLink, plan_type: PlanType) -> tuple[MissionItem, ...]:
    """Download the plan that a vehicle holds, as its autopilot has it on the wire. Raises TransferError."""
    async with vehicle.transfer_lock:
        return await run(vehicle, lambda *link: PlanDownload(plan_type, *link))


async def clear(vehicle: VehicleLink, plan_type: PlanType) -> None:
    """Remove a plan, and see by reading back that it is gone; ALL removes mission, fence and rally points in turn.

    Raises:
        TransferError: the transfer failed, or the vehicle still holds something.
    """
    async with vehicle.transfer_lock:
        for one in HELD if plan_type == PlanType.ALL else (plan_type,):
            await _clear(vehicle, one)


async def _clear(vehicle: VehicleLink, plan_type: PlanType) -> None:
    await run(vehicle, lambda *link: PlanClear(plan_type, *link))
    held = await run(vehicle, lambda *link: PlanDownload(plan_type, *link))
    left = len(held) - (1 if plan_type == PlanType.MISSION and _home_first(vehicle) else 0)
    if left > 0:
        raise TransferError(f"{vehicle}: still holds {left} items of its {_plan(plan_type)} after clearing it")


def _check(vehicle: VehicleLink, plan_type: PlanType, items: Sequence[MissionItem]) -> None:
    """Raise TransferError when a plan is none for this vehicle."""
    heartbeat = vehicle.latest.get("HEARTBEAT")
    if heartbeat is not None and heartbeat.type not in _PLANES:
        entry = mavlink.enums["MAV_TYPE"].get(heartbeat.type)
        kind = entry.name if entry is not None else f"vehicle of type {heartbeat.type}"
        raise TransferError(f"{vehicle}: is a {kind}, and gets no {_plan(plan_type)}: Skein's are for planes")
    if len(items) > _LARGEST_COUNT:
        raise TransferError(f"{vehicle}: {len(items)} items are more than MAVLink can count; {_LARGEST_COUNT} at most")


def _home_first(vehicle: VehicleLink) -> bool:
    return vehicle.autopilot.home_is_item_0


def _plan(plan_type: PlanType) -> str:
    return NOUNS[plan_type]


def _some(lines: Sequence[str]) -> str:
    """The first lines, and how many more there are."""
    more = f"; and {len(lines) - _LINES} more" if len(lines) > _LINES else ""
    return "; ".join(lines[:_LINES]) + more
