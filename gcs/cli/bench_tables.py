"""The tables of `skein bench`; they fit 80 columns, but for many families side by side."""

from collections.abc import Mapping, Sequence
from typing import Any

from rich import box
from rich.table import Table

from planner.bench.comparison import TARGETS, Comparison
from planner.bench.growth import Growth
from planner.bench.job import Limit
from planner.bench.kernel_speed import KernelSpeed


def method_table(comparison: Comparison, limit: Limit) -> Table:
    """Each method over all problems under one limit, the best first; what it takes to come within the targets in
    evaluations where those are limited, in seconds where time is."""
    figures = comparison.figures(limit, comparison.problems)
    friedman = figures["friedman_p"]
    title = f"At {limit.label}, {len(comparison.problems)} problems"
    table = _table(title if friedman is None else f"{title}; were all methods alike, p = {_short(friedman)}")
    used, key = ("CPU\ns", "cpu_s") if limit.cpu_s else ("evals\n/d", "evaluations_per_dimension")
    headings = ["gap %", "quartiles"]
    for target in TARGETS:
        headings += [f"in\n{100 * target:g} %", used]
    for heading in (*headings, "rank", f"p vs\n{figures['reference']}"):
        table.add_column(heading, justify="right", no_wrap=True)
    for method, row in sorted(figures["methods"].items(), key=lambda item: float(item[1]["mean_rank"])):
        if not row["runs"]:
            continue
        gap, p = row["gap"], row["wilcoxon_holm_p"]
        cells = [_percent(gap["median"]), f"{_percent(gap['q1'])} .. {_percent(gap['q3'])}"]
        for target in TARGETS:
            within = row[f"within_{target:g}"]
            cells += [f"{within['success_rate']:.0%}", "-" if within[key] is None else _short(within[key])]
        table.add_row(method, *cells, f"{row['mean_rank']:.2f}", "" if p is None else _short(p))
    return table


def family_table(comparison: Comparison, limit: Limit) -> Table:
    """Median gap and mean rank of each method, family by family."""
    table = _table(f"At {limit.label}, median gap % (mean rank) by family")
    groups = {name: problems for name, problems in comparison.groups.items() if name != "all"}
    figures = {name: comparison.figures(limit, problems)["methods"] for name, problems in groups.items()}
    for name in groups:
        table.add_column(name, justify="right", no_wrap=True)
    for method in comparison.methods:
        rows = [figures[name][method] for name in groups]
        table.add_row(
            method,
            *(f"{_percent(row['gap']['median'])} ({row['mean_rank']:.1f})" if row["runs"] else "-" for row in rows),
        )
    return table


def kernel_table(speeds: Sequence[KernelSpeed]) -> Table:
    """Evaluations a second."""
    table = _table("Evaluations of the objective a second", "problem")
    for heading in (
        "ground",
        "1 thread",
        f"{speeds[0].threads} threads",
        "numpy",
        "1 thread\n/ numpy",
        "part\nof peak",
    ):
        table.add_column(heading, justify="right", no_wrap=True)
    for speed in speeds:
        rates = (speed.one_thread, speed.all_threads, speed.in_numpy)
        table.add_row(
            speed.problem,
            speed.ground,
            *(f"{rate:,.0f}" for rate in rates),
            f"{speed.one_thread / speed.in_numpy:.0f}",
            f"{speed.share_of_peak:.0%}",
        )
    return table


def work_table(peaks: Mapping[str, float], speeds: Sequence[KernelSpeed]) -> Table:
    """Operations an evaluation, and what one core does at most."""
    table = _table("Operations an evaluation, and a second at most on one core", "problem")
    for kind in ("ground", *peaks, "least us"):
        table.add_column(kind, justify="right", no_wrap=True)
    for speed in speeds:
        counts = (f"{speed.work[kind]:,.0f}" for kind in peaks)
        table.add_row(speed.problem, speed.ground, *counts, f"{1e6 * speed.least_s:.2f}")
    table.add_row("a second at most", "", *(f"{rate:.1e}" for rate in peaks.values()), "")
    return table


def together_table(figures: Sequence[Mapping[str, Any]]) -> Table:
    """Plans of all vehicles together."""
    table = _table("All vehicles together", "scenario")
    for heading in (
        "method",
        "seeds",
        "best km",
        "gap %",
        "quartiles",
        *(f"in\n{100 * t:g} %" for t in TARGETS),
        "plan\ns",
    ):
        table.add_column(heading, justify="right", no_wrap=True)
    for row in figures:
        gap, times = row["gap"], row["plan_s"]
        table.add_row(
            row["scenario"],
            row["method"],
            str(row["runs"]),
            "-" if row["best_km"] is None else f"{row['best_km']:.3f}",
            _percent(gap["median"]),
            f"{_percent(gap['q1'])} .. {_percent(gap['q3'])}",
            *(f"{rate:.0%}" for rate in row["success_rate"].values()),
            "-" if times is None else f"{times['median']:.2f}",
        )
    return table


def growth_table(growths: Sequence[Growth], power: float) -> Table:
    """Planning time of fields of vehicles."""
    table = _table(f"Planning time grows as n^{power:.2f}", "vehicles")
    for heading in ("CPU s", "wall s", "CPU ms a vehicle"):
        table.add_column(heading, justify="right", no_wrap=True)
    for growth in growths:
        row = (f"{growth.cpu_s:.2f}", f"{growth.wall_s:.2f}", f"{1e3 * growth.cpu_s / growth.uavs:.0f}")
        table.add_row(str(growth.uavs), *row)
    return table


def _table(title: str, first: str = "method") -> Table:
    table = Table(title=title, title_justify="left", box=box.SIMPLE_HEAD, pad_edge=False, collapse_padding=True)
    table.add_column(first, no_wrap=True)
    return table


def _percent(gap: float | None) -> str:
    """A gap in per cent; none where no feasible path was found."""
    return "none" if gap is None else _short(100.0 * gap)


def _short(value: float) -> str:
    """Two or three digits in few characters."""
    if 100.0 <= value < 1e5:
        return f"{value:.0f}"
    if value == 0.0 or 1e-3 <= value < 100.0:
        return f"{value:.2g}" if value < 10.0 else f"{value:.3g}"
    return f"{value:.0e}".replace("e+0", "e").replace("e-0", "e-")
