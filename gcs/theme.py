"""What pictures are drawn with: dark ink on light paper, or light on dark. Vehicles have the same colours on both."""

from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass


@dataclass(frozen=True)
class Theme:
    """Colours of everything but vehicles and threats.

    Attributes:
        ink, faint, paper, grid: of text, of what is beside the point, of the page, of the lines in axes.
        ground: from the plain to the peaks.
    """

    ink: str
    faint: str
    paper: str
    grid: str
    ground: tuple[str, ...]


LIGHT = Theme(
    "#222222", "#8a8a8a", "#ffffff", "#dddddd", ("#dde5d0", "#c2cda5", "#b0a97a", "#97805d", "#7d6655", "#d8d4d0")
)
DARK = Theme(
    "#e6e6e6", "#8a8f98", "#12161c", "#2c333d", ("#1c2620", "#26301f", "#343323", "#403426", "#4d3f36", "#77736f")
)

_chosen: ContextVar[Theme] = ContextVar("theme", default=LIGHT)


def theme() -> Theme:
    """The one that pictures are drawn with now."""
    return _chosen.get()


@contextmanager
def drawn_dark(dark: bool) -> Iterator[None]:
    """Draw light on dark within the block, if that is wanted."""
    token = _chosen.set(DARK if dark else LIGHT)
    try:
        yield
    finally:
        _chosen.reset(token)
