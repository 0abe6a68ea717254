"""Transfers driven in asyncio: whatever goes wrong in one, its caller hears of it."""

import asyncio
import contextlib
from collections.abc import Callable, Iterator
from types import SimpleNamespace
from typing import Any

import pytest

from gcs.transfers.run import run


class Link:
    """As much of a vehicle's link as a transfer is driven over."""

    def __init__(self) -> None:
        self.sysid, self.compid, self.known, self.texts = 1, 1, None, list[str]()
        self.send = lambda message: None
        self.hear: Callable[[Any], None] = lambda message: None

    @contextlib.contextmanager
    def listening(self, hear: Callable[[Any], None]) -> Iterator[None]:
        self.hear = hear
        yield


class Broken(SimpleNamespace):
    """A transfer that cannot do what it should."""

    outcome = None

    def start(self) -> None:
        pass

    def on_tick(self) -> None:
        raise ZeroDivisionError("in a timer")

    def on_message(self, message: object) -> None:
        raise ZeroDivisionError("at a message")


@pytest.mark.parametrize(("due_s", "where"), [(0.0, "in a timer"), (3600.0, "at a message")])
def test_an_error_inside_a_transfer_reaches_the_caller_who_would_wait_for_ever(due_s: float, where: str) -> None:
    async def driven() -> None:
        link, loop = Link(), asyncio.get_running_loop()
        loop.call_soon(lambda: loop.call_soon(lambda: link.hear("anything")))
        make = lambda *_: Broken(deadline_s=loop.time() + due_s)  # noqa: E731
        if due_s == 0.0:
            link.listening = lambda hear: contextlib.nullcontext()  # type: ignore[method-assign]
        await asyncio.wait_for(run(link, make), 10)  # type: ignore[arg-type]

    with pytest.raises(ZeroDivisionError, match=where):
        asyncio.run(driven())
