"""Setting what a user may set, from here."""

from typing import Any


def set_value(handle: Any, value: object) -> None:
    """Give an input of a page a value; viser's types call it read-only, which it is not."""
    handle.value = value
