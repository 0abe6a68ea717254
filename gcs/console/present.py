"""Showing a page for as long as it is wanted: what moves many times a second, the rest some times."""

import asyncio
import contextlib
import time
from collections.abc import Callable

from gcs.console.page import Page
from gcs.console.source import Source

FRAME_S = 1.0 / 30.0
MANY_FRAME_S = 1.0 / 10.0
"""Of more vehicles than `MANY`."""
MANY = 50
FIGURES_S = 0.25
MANY_FIGURES_S = 0.5
LEAST_REST_S = 0.001
"""For all else that the process does."""


async def present(page: Page, source: Source, until: asyncio.Event, also: Callable[[], None] | None = None) -> None:
    """Show what the source has until the event is set.

    Args:
        page, source: to show, and of what.
        until: the end.
        also: called whenever the figures are renewed, before.
    """
    shown_s = figures_s = next_s = time.monotonic()
    while not until.is_set():
        many = len(source.names) > MANY
        frame_s = MANY_FRAME_S if many else FRAME_S
        now_s = time.monotonic()
        page.show(now_s - shown_s)
        shown_s = now_s
        next_s = max(next_s + frame_s, now_s)  # evenly; who falls behind does not hurry
        if now_s >= figures_s:
            figures_s = now_s + (MANY_FIGURES_S if many else FIGURES_S)
            if also is not None:
                also()
            page.show_figures()
        with contextlib.suppress(TimeoutError):
            await asyncio.wait_for(until.wait(), max(LEAST_REST_S, next_s - time.monotonic()))
