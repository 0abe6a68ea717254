"""Someone who listens on a link."""

import asyncio
from collections.abc import Callable

import pytest

from gcs.links.link import Link
from sitl.services.peer import Peer

PATIENCE_S = 10.0


class Listener:
    """Notes what comes over a link."""

    def __init__(self, link: Link) -> None:
        self.received: dict[Peer, bytes] = {}
        self.news: list[tuple[str, Peer]] = []
        self._changed = asyncio.Event()
        link.on_bytes = self._on_bytes
        link.on_lost = lambda peer: self._on_news("lost", peer)
        link.on_back = lambda peer: self._on_news("back", peer)

    async def until(self, condition: Callable[[], object]) -> None:
        """Wait until the condition holds; fails when it never does."""
        async with asyncio.timeout(PATIENCE_S):
            while not condition():
                self._changed.clear()
                await self._changed.wait()

    def _on_bytes(self, data: bytes, peer: Peer) -> None:
        self.received[peer] = self.received.get(peer, b"") + data
        self._changed.set()

    def _on_news(self, kind: str, peer: Peer) -> None:
        self.news.append((kind, peer))
        self._changed.set()


@pytest.fixture
def listen() -> Callable[[Link], Listener]:
    return Listener
