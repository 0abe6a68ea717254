"""Where what is shown comes from: vehicles that fly, or a flight that was recorded."""

from collections.abc import Mapping, Sequence
from typing import Protocol

import numpy as np
import numpy.typing as npt

from gcs.console.moment import Course, Moment, Row, ShownLink

FloatArray = npt.NDArray[np.float64]


class Source(Protocol):
    """A swarm over time."""

    @property
    def names(self) -> Mapping[int, str]:
        """Of the vehicles known so far, by sysid."""

    def advance(self, passed_s: float) -> Moment:
        """The moment to show, so much wall time after the last one."""

    def trails(self, seconds: float, count: int) -> FloatArray:
        """Where each vehicle of the last moment has been so long before it, (n, count, 3), oldest first; NaN where it
        was not known."""

    def links(self) -> Sequence[ShownLink]:
        """Of the formation, at the last moment."""

    def rows(self) -> Sequence[Row]:
        """Of the table, at the last moment."""

    def course(self) -> Course:
        """Of the figures of merit."""

    def state(self) -> str:
        """What it is that is shown, in a few words."""
