"""What long work shows on standard error: what is done, how far it is, and the time left.

On a terminal that is a line which moves, and goes when the work is over; elsewhere the work's name, once. Standard
output is left alone.
"""

import logging
import time
from collections.abc import Iterator
from contextlib import contextmanager

from rich.progress import BarColumn, MofNCompleteColumn, Progress, ProgressColumn, Task, TaskID, TextColumn
from rich.text import Text

from gcs.cli import output

_log = logging.getLogger(__name__)

BAR_WIDTH = 24


class TimeLeft(ProgressColumn):
    """The time that is left, or where nobody can tell, how long it has taken so far."""

    max_refresh = 0.5

    def render(self, task: Task) -> Text:
        """The column's text for one line."""
        left_s = None if task.total is None else task.time_remaining
        if left_s is None:
            return Text(f"{_clock(task.elapsed or 0.0)} so far", style="progress.elapsed")
        return Text(f"{_clock(left_s)} left", style="progress.remaining")


class CountColumn(MofNCompleteColumn):
    """How many of how many, where single things are counted."""

    def render(self, task: Task) -> Text:
        """The column's text for one line; empty for what is not counted."""
        return super().render(task) if task.fields["counted"] else Text()


class Working:
    """The line of some work under way. May be told of it from several threads."""

    def __init__(self, progress: Progress, task: TaskID) -> None:
        self._progress, self._task = progress, task

    def advance(self, what: str | None = None) -> None:
        """One more is done; `what` renames the work."""
        self._progress.update(self._task, advance=1.0, description=what)

    def show(self, done: float, total: float, what: str | None = None, note: str = "") -> None:
        """So much of a total is done; `note` stands at the end of the line."""
        self._progress.update(self._task, completed=done, total=total, description=what, note=note)


@contextmanager
def working(what: str, count: int | None = None, done: int = 0, *, brief: bool = False) -> Iterator[Working]:
    """Show that some work is under way, until the block ends.

    Args:
        what: it is.
        count: how many things are to be done, one `advance` each; None where the work is not counted.
        done: of them before.
        brief: it takes seconds at most, and is worth no line where there is no terminal.
    """
    columns = (
        TextColumn("{task.description}", markup=False),
        BarColumn(BAR_WIDTH),
        CountColumn(),
        TimeLeft(),
        TextColumn("{task.fields[note]}", markup=False),
    )
    moving = output.progress.is_terminal
    if not (moving or brief):
        output.progress.print(what, markup=False, soft_wrap=True)
    with Progress(*columns, console=output.progress, transient=True, disable=not moving) as progress:
        task = progress.add_task(what, total=count, completed=done, counted=count is not None, note="")
        began_s = time.monotonic()
        yield Working(progress, task)
        _log.info("%s: %.3f s", what, time.monotonic() - began_s)


def _clock(seconds: float) -> str:
    """As "0:42" or "1:03:20"."""
    minutes, rest = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours}:{minutes:02}:{rest:02}" if hours else f"{minutes}:{rest:02}"
