"""The plans of a vehicle as bytes that it keeps over restarts: each item with its wire fields, exactly."""

import struct
from collections.abc import Iterable

from missions.errors import InputError
from missions.mission import MissionItem
from missions.plan_type import PlanType
from sitl.store import Store

_HEAD = b"skein-plan-1"
_ITEM = struct.Struct("<HB4fiifB")
"""command, frame, param1 to 4, latitude, longitude, altitude, autocontinue."""


def encode_plan(items: Iterable[MissionItem]) -> bytes:
    """Items as bytes; `decode_plan` gives back equal ones."""
    packed = (
        _ITEM.pack(item.command, item.frame, *item.params, item.lat_e7, item.lon_e7, item.alt_m, int(item.autocontinue))
        for item in items
    )
    return _HEAD + b"".join(packed)


def decode_plan(piece: bytes) -> tuple[MissionItem, ...]:
    """The items in such bytes.

    Raises:
        InputError: they are none.
    """
    body = piece[len(_HEAD) :]
    if not piece.startswith(_HEAD) or len(body) % _ITEM.size:
        raise InputError("no plan of this version")
    return tuple(
        MissionItem(command, frame, p1, p2, p3, p4, lat_e7, lon_e7, alt_m, bool(autocontinue))
        for command, frame, p1, p2, p3, p4, lat_e7, lon_e7, alt_m, autocontinue in _ITEM.iter_unpack(body)
    )


def keep_plan(store: Store, plan: PlanType, items: Iterable[MissionItem]) -> None:
    """Keep a plan in place of the old one. Raises InputError when it could not be written."""
    store.write(_piece(plan), encode_plan(items))


def recall_plan(store: Store, plan: PlanType) -> tuple[MissionItem, ...] | None:
    """The plan that was kept; None when none was. Raises InputError when it is damaged."""
    piece = store.read(_piece(plan))
    return None if piece is None else decode_plan(piece)


def _piece(plan: PlanType) -> str:
    return f"{plan.name.lower()}.plan"
