"""The tables of `skein bench`; they fit 100 columns."""

from rich import box
from rich.table import Table

from planner.bench.comparison import TARGETS, Comparison
from planner.bench.job import Limit


def method_table(comparison: Comparison, limit: Limit) -> Table:
    """Each method over all problems under one limit, the best first; what it takes to come within the targets in
    evaluations where those are limited, in seconds where time is."""
    figures = comparison.figures(limit, comparison.problems)
    friedman = figures["friedman_p"]
    title = f"At {limit.label}, {len(comparison.problems)} problems"
    table = _table(title if friedman is None else f"{title}; were all methods alike, p = {_short(friedman)}")
    used, key = ("CPU s", "cpu_s") if limit.cpu_s else ("evals/d", "evaluations_per_dimension")
    headings = ["gap %", "quartiles"]
    for target in TARGETS:
        headings += [f"in {100 * target:g} %", used]
    for heading in (*headings, "rank", f"p vs {figures['reference']}"):
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


def _table(title: str) -> Table:
    table = Table(title=title, title_justify="left", box=box.SIMPLE_HEAD, pad_edge=False)
    table.add_column("method", no_wrap=True)
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
