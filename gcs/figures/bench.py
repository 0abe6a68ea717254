"""What a comparison of searches shows: how they converge, and which part of all targets they meet after how much."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes

from gcs.figures import style
from planner.bench.comparison import Comparison
from planner.bench.ecdf import TARGETS, solved_after
from planner.bench.job import Limit, Run
from planner.bench.measures import CPU_S, EVALUATIONS, gaps_at
from planner.bench.methods import REFERENCE
from planner.bench.problems import BenchProblem

FloatArray = npt.NDArray[np.float64]

LEAST_GAP = 1e-5
"""Gaps are shown from here on: a logarithm knows no 0."""
MOST_GAP = 3.0
TICKS = {1e-5: "0.001 %", 1e-4: "0.01 %", 1e-3: "0.1 %", 1e-2: "1 %", 1e-1: "10 %", 1.0: "100 %"}
POINTS = 120
DECADES = 3.0
"""Shown before the limit."""


def draw_bench(comparison: Comparison, folder: Path) -> list[Path]:
    """Draw convergence and running times into an existing folder, where there are runs; returns the files.

    Evaluations are shown for the largest limit of evaluations, time for the limit of time. Raises OSError.
    """
    if not comparison.runs:
        return []
    files = [folder / "ecdf.png"]
    _draw_ecdf(comparison, files[0])
    for limit, column, label in _shown(comparison):
        files.append(folder / f"convergence_{'time' if column == CPU_S else 'evaluations'}.png")
        _draw_convergence(comparison, limit, column, label, files[-1])
    return files


def _shown(comparison: Comparison) -> list[tuple[Limit, int, str]]:
    """Limit, column of a run's lines and label of each axis to show."""
    counted = [limit for limit in comparison.limits if limit.evaluations_per_dimension]
    timed = [limit for limit in comparison.limits if limit.cpu_s]
    shown = []
    if counted:
        most = max(counted, key=lambda limit: limit.evaluations_per_dimension)
        shown.append((most, EVALUATIONS, "evaluations / dimension"))
    if timed:
        shown.append((max(timed, key=lambda limit: limit.cpu_s), CPU_S, "CPU time (s)"))
    return shown


def _draw_convergence(comparison: Comparison, limit: Limit, column: int, label: str, path: Path) -> None:
    """Median and quartiles of the gap, over everything and by family."""
    groups = comparison.groups
    if len(groups) == 2:  # all problems are of one family
        del groups["all"]
    columns = min(3, len(groups))
    rows = -(-len(groups) // columns)
    with style.page(path, 1.1 + 2.8 * rows) as figure:
        grid = figure.subplots(rows, columns, sharex=True, sharey=True, squeeze=False)
        for axes, (name, problems) in zip(grid.flat, groups.items(), strict=False):
            _gaps(axes, comparison, limit, column, problems)
            axes.set_title(f"{name}: {len(problems)} problems" if len(problems) > 1 else problems[0].name)
        for i, axes in enumerate(grid.flat):
            axes.set_visible(i < len(groups))
            if len(groups) - columns <= i < len(groups):
                axes.set_xlabel(label)
                axes.tick_params(labelbottom=True)
        for axes in grid[:, 0]:
            axes.set_ylabel("gap to best-known")
        _finish(figure, comparison, f"Gap to the best-known value: median and quartiles, {_seeds(comparison)}")


def _gaps(axes: Axes, comparison: Comparison, limit: Limit, column: int, problems: Sequence[BenchProblem]) -> None:
    dimension = {problem.name: problem.dimension if column == EVALUATIONS else 1 for problem in problems}
    end = limit.evaluations_per_dimension or limit.cpu_s
    used = end * np.logspace(-DECADES, 0.0, POINTS)
    for method, look in looks(comparison.methods).items():
        runs = comparison.chosen(limit, method=method, problems=dimension)
        if not runs:
            continue
        gaps = np.array(
            [
                gaps_at(run, comparison.best_km[run.job.problem], column, used * dimension[run.job.problem])
                for run in runs
            ]
        )
        low, middle, high = np.quantile(gaps, [0.25, 0.5, 0.75], axis=0, method="inverted_cdf")
        bottom, top = np.clip([low, high], LEAST_GAP, MOST_GAP)
        axes.fill_between(
            used, bottom, top, where=np.isfinite(high).tolist(), color=look["color"], alpha=0.13, linewidth=0
        )
        known = np.isfinite(middle)
        axes.plot(used[known], np.maximum(middle[known], LEAST_GAP), **look)
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlim(used[0], used[-1])
    axes.set_ylim(LEAST_GAP, MOST_GAP)
    axes.set_yticks(list(TICKS), list(TICKS.values()))
    axes.minorticks_off()


def _draw_ecdf(comparison: Comparison, path: Path) -> None:
    """Which part of all (problem, seed, target) is solved after how much."""
    shown = _shown(comparison)
    with style.page(path, 4.6) as figure:
        for axes, (limit, column, label) in zip(
            figure.subplots(1, len(shown), sharey=True, squeeze=False)[0], shown, strict=True
        ):
            scale = {p.name: float(p.dimension) if column == EVALUATIONS else 1.0 for p in comparison.problems}
            end = limit.evaluations_per_dimension or limit.cpu_s
            for method, look in looks(comparison.methods).items():
                runs: list[Run] = comparison.chosen(limit, method=method, problems=scale)
                if not runs:
                    continue
                solved, part = solved_after(runs, comparison.best_km, column, scale)
                last = part[-1:] if len(part) else np.zeros(1)
                axes.step([*solved, end], [*part, *last], where="post", **look)
            axes.set_xscale("log")
            axes.set_xlim(end * 10.0**-DECADES, end)
            axes.set_xlabel(label)
        figure.axes[0].set_ylabel("part of runs and targets met")
        figure.axes[0].set_ylim(0.0, 1.0)
        targets = f"{len(TARGETS)} targets: gaps of {100 * TARGETS[0]:g} to {100 * TARGETS[-1]:g} %"
        _finish(figure, comparison, f"{len(comparison.problems)} problems, {_seeds(comparison)}, {targets}")


def looks(methods: Sequence[str]) -> Mapping[str, dict[str, Any]]:
    """How each method is drawn: the reference in the first colour and thicker, above the others."""
    others = [method for method in methods if method != REFERENCE]
    found: dict[str, dict[str, Any]] = {}
    for i, method in enumerate(others):
        colour = style.VEHICLES[1 + i % (len(style.VEHICLES) - 1)]
        dashes = "-" if i < len(style.VEHICLES) - 1 else style.DASHES
        found[method] = {"color": colour, "linestyle": dashes, "linewidth": 1.5, "zorder": 2.5}
    if REFERENCE in methods:
        found[REFERENCE] = {"color": style.VEHICLES[0], "linestyle": "-", "linewidth": 2.6, "zorder": 3}
    return found


def _seeds(comparison: Comparison) -> str:
    seeds = len({run.job.seed for run in comparison.runs})
    return f"{seeds} seed{'' if seeds == 1 else 's'}"


def _finish(figure: Any, comparison: Comparison, title: str) -> None:
    style.headline(figure, title)
    shown = looks(comparison.methods)
    order = [method for method in (REFERENCE, *comparison.methods) if method in shown]
    handles = [style.line_handle(method, **shown[method]) for method in dict.fromkeys(order)]
    figure.legend(handles=handles, loc="outside lower left", ncols=min(9, len(handles)), handlelength=1.6)
