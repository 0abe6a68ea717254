"""The table that a study of delay prints; it fits 80 columns."""

from rich import box
from rich.table import Table

from gcs.study.delay import DelayStudy
from gcs.study.linear_sweep import FLOWN, Growth
from gcs.study.points import Point, on_curve


def delay_table(study: DelayStudy) -> Table:
    """A row for each graph: the linear law at both sides of its margin, aircraft below and above theirs."""
    table = Table(
        title=f"Delay and {study.scenario.name}",
        caption="Linear law: growth (1/s) at 0.95 and 1.05 of its margin. Aircraft: formation error (m), "
        "± 95 %, at the least delay flown and the greatest, and without neighbours.",
        title_justify="left",
        caption_justify="left",
        box=box.SIMPLE_HEAD,
    )
    table.add_column("graph", no_wrap=True)
    for heading in ("τ* s", "at 0.95", "at 1.05", "aircraft\nτ* s", "least\ndelay", "greatest\ndelay", "own\nschedule"):
        table.add_column(heading, justify="right", no_wrap=True)
    for graph, margin_s in study.margins_s.items():
        mine = [growth for growth in study.growths if (growth.graph, growth.law) == (graph, FLOWN)]
        flown = on_curve(study.aircraft, graph, "full")
        (alone,) = on_curve(study.aircraft, graph, "own_schedule")
        table.add_row(
            graph,
            f"{mine[0].margin_s:.3f}",
            f"{_near(mine, 0.95).rate_1_s:+.3f}",
            f"{_near(mine, 1.05).rate_1_s:+.3f}",
            f"{margin_s:.3f}",
            *(_error(point) for point in (flown[0], flown[-1], alone)),
        )
    return table


def _near(growths: list[Growth], share: float) -> Growth:
    return min(growths, key=lambda growth: abs(growth.share - share))


def _error(point: Point) -> str:
    error = point.measures["rms_error_m"]
    return f"{error.mean:.2f}±{error.half_width:.2f}"
