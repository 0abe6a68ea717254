"""The live table of a flight, on standard error: what each vehicle does, how far it has come, and the time left."""

from types import TracebackType

from rich.console import Console, Group
from rich.live import Live
from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn
from rich.progress_bar import ProgressBar
from rich.table import Table

from gcs.cli.progress import BAR_WIDTH, TimeLeft
from gcs.watch import VehicleStatus

REFRESHES_PER_S = 8


class LiveTable:
    """Shows the steps of a flight, and the vehicles while they fly. Where there is no terminal only the steps.

    Args:
        console: to show it on.
    """

    def __init__(self, console: Console) -> None:
        self._console = console
        self._live = Live(console=console, refresh_per_second=REFRESHES_PER_S, transient=True)
        columns = (TextColumn("{task.description}"), BarColumn(BAR_WIDTH), TaskProgressColumn(), TimeLeft())
        self._whole = Progress(*columns, console=console)
        self._flight = self._whole.add_task("Flying", total=None, start=False)

    def announce(self, step: str) -> None:
        """A step of the flight begins."""
        self._console.print(step)

    def show(self, statuses: list[VehicleStatus]) -> None:
        """Renew the table."""
        if self._console.is_terminal:
            self._tell_whole(statuses)
            self._live.update(Group(_table(statuses), self._whole))

    def _tell_whole(self, statuses: list[VehicleStatus]) -> None:
        """How far the flight is: in simulated time, until the last of those that fly is to arrive."""
        if not self._whole.tasks[0].started:
            self._whole.start_task(self._flight)
        ends_s = max((status.planned_arrival_s for status in statuses if status.lost is None), default=0.0)
        self._whole.update(self._flight, total=ends_s, completed=max(status.time_s for status in statuses))

    def __enter__(self) -> "LiveTable":
        self._live.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._live.stop()


def _table(statuses: list[VehicleStatus]) -> Table:
    newest_s = max(status.time_s for status in statuses)
    table = Table(title=f"simulated time {newest_s:.0f} s", title_justify="left")
    for heading, justify in (("vehicle", "left"), ("mode", "left"), ("item", "right")):
        table.add_column(heading, justify=justify)  # type: ignore[arg-type]
    table.add_column("progress", width=20)
    for heading in ("m/s", "alt m", "off track m"):
        table.add_column(heading, justify="right")
    for status in statuses:
        state = _state(status)
        table.add_row(
            f"{status.sysid} {status.name}",
            state,
            f"{status.item}/{status.items - 1}",
            ProgressBar(total=status.planned_arrival_s, completed=status.time_s, width=20),
            f"{status.airspeed_m_s:.1f}",
            f"{status.altitude_m:.0f}",
            f"{status.cross_track_m:.1f}",
        )
    return table


def _state(status: VehicleStatus) -> str:
    if status.lost:
        return "[red]lost[/red]"
    if status.silent:
        return "[red]silent[/red]"
    return "[green]arrived[/green]" if status.arrived else status.mode
