"""DO_JUMP in `.plan` files: it names the doJumpId of its target, which need not be the number the item gets."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

from missions.commands import Command
from missions.errors import InputError
from missions.mission import MissionItem


@dataclass(frozen=True)
class Numbered:
    """An item, the number that jumps know it by (None when the file gives none), and its place in the file."""

    item: MissionItem
    jump_id: int | None
    key: str


def renumbered(items: Sequence[Numbered], error: Callable[[str, str], InputError]) -> list[MissionItem]:
    """The items from number 1 on, jumps leading to the numbers that their targets have got.

    Where every item has the number that jumps know it by, or none of them has any, jumps stay as they are.

    Args:
        items: those that are read.
        error: makes one from a place and a reason.

    Raises:
        InputError: a jump leads to an item that is not there, or to one of several with the same doJumpId.
    """
    numbers: dict[float, list[int]] = {}
    for seq, one in enumerate(items, start=1):
        if one.jump_id is not None:
            numbers.setdefault(float(one.jump_id), []).append(seq)
    in_order = all(one.jump_id in (None, seq) for seq, one in enumerate(items, start=1))
    if in_order:
        return [one.item for one in items]
    result = []
    for one in items:
        if one.item.command != Command.DO_JUMP:
            result.append(one.item)
            continue
        targets = numbers.get(one.item.param1, [])
        if len(targets) != 1:
            some = "several items have it" if targets else "no item that was read has it"
            raise error(one.key, f"DO_JUMP to doJumpId {one.item.param1:g}: {some}; jump to another item")
        result.append(replace(one.item, param1=float(targets[0])))
    return result
