"""Showing a page for as long as it is wanted: what moves many times a second, the rest some times."""

import asyncio
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


async def present(page: Page, source: Source, until: asyncio.Event, also: Callable[[], None] | None = None) -> None:
    """Show what the source has until the event is set.

    Args:
        page, source: to show, and of what.
        until: the end.
        also: called whenever the figures are renewed, before.
    """
    shown_s = figures_s = time.monotonic()
    while not until.is_set():
        many = len(source.names) > MANY
        frame_s = MANY_FRAME_S if many else FRAME_S
        now_s = time.monotonic()
        page.show(now_s - shown_s)
        shown_s = now_s
        if now_s >= figures_s:
            figures_s = now_s + (MANY_FIGURES_S if many else FIGURES_S)
            if also is not None:
                also()
            page.show_figures()
        rest_s = now_s + frame_s - time.monotonic()
        try:
            await asyncio.wait_for(until.wait(), max(0.001, rest_s))
        except TimeoutError:
            continue
