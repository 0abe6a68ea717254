"""All runs of a comparison and what they say: figures for each method, over everything, by family and by problem."""

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from importlib.metadata import version
from typing import Any

import numpy as np
import numpy.typing as npt

from planner.bench.job import Job, Limit, Run
from planner.bench.measures import CPU_S, EVALUATIONS, expected_running_time, final_gap, quartiles, used_to_reach
from planner.bench.methods import REFERENCE
from planner.bench.problems import BenchProblem
from planner.bench.significance import friedman_p, holm, mean_ranks, wilcoxon_p
from planner.jobs.run_jobs import Failure

FloatArray = npt.NDArray[np.float64]

FORMAT = 1
TARGETS = (0.01, 0.001)
"""Gaps that count as success."""


@dataclass(frozen=True)
class Comparison:
    """Runs of the same methods, seeds and limits on the same problems.

    Attributes:
        problems, methods, limits: what was asked for.
        known_km: best-known values by problem from before; those without are missing.
        runs: what came of it.
        failures: jobs that gave nothing.
    """

    problems: tuple[BenchProblem, ...]
    methods: tuple[str, ...]
    limits: tuple[Limit, ...]
    known_km: Mapping[str, float]
    runs: tuple[Run, ...]
    failures: tuple[Failure[Job], ...]

    @cached_property
    def best_km(self) -> dict[str, float]:
        """What gaps are measured from, by problem: the best-known value or what was found here, if that is better.

        Infinite where nobody found a feasible path.
        """
        best = {problem.name: self.known_km.get(problem.name, math.inf) for problem in self.problems}
        for run in self.runs:
            if len(run.lines):
                best[run.job.problem] = min(best[run.job.problem], float(run.lines[-1, 2]))
        return best

    def chosen(self, limit: Limit, *, method: str, problems: Iterable[str]) -> list[Run]:
        """Runs of one method on some problems."""
        names = set(problems)
        return [r for r in self._by_limit_and_method.get((limit, method), []) if r.job.problem in names]

    @cached_property
    def _by_limit_and_method(self) -> dict[tuple[Limit, str], list[Run]]:
        grouped: dict[tuple[Limit, str], list[Run]] = {}
        for run in self.runs:
            grouped.setdefault((run.job.limit, run.job.method), []).append(run)
        return grouped

    @property
    def groups(self) -> dict[str, list[BenchProblem]]:
        """Problems by family, after all of them."""
        families = {problem.family: None for problem in self.problems}
        groups = {family: [p for p in self.problems if p.family == family] for family in families}
        return {"all": list(self.problems), **groups}

    def as_json(self) -> dict[str, Any]:
        """Everything, raw runs included. Infinite figures are null."""
        return {
            "format": FORMAT,
            "version": version("skein-gcs"),
            "methods": list(self.methods),
            "limits": [limit.label for limit in self.limits],
            "problems": [
                {
                    "problem": p.name,
                    "family": p.family,
                    "waypoints": p.waypoints,
                    "digest": p.digest,
                    "best_known_km": self.known_km.get(p.name),
                    "best_km": finite(self.best_km[p.name]),
                }
                for p in self.problems
            ],
            "summary": {limit.label: self._summary(limit) for limit in self.limits},
            "runs": [_run_json(run) for run in self.runs],
            "failures": [{"job": failure.job.name, "reason": failure.reason} for failure in self.failures],
        }

    def _summary(self, limit: Limit) -> dict[str, Any]:
        groups = {name: self.figures(limit, problems) for name, problems in self.groups.items()}
        alone = {problem.name: self.figures(limit, [problem]) for problem in self.problems}
        return {"groups": groups, "problems": alone}

    def figures(self, limit: Limit, problems: Sequence[BenchProblem]) -> dict[str, Any]:
        """What the runs under one limit on some problems say of each method, and of their differences."""
        medians = self._median_gaps(limit, problems)
        ranks = dict(zip(self.methods, mean_ranks(medians).tolist(), strict=True))
        reference = REFERENCE if REFERENCE in ranks else min(ranks, key=lambda method: ranks[method])
        column = dict(zip(self.methods, medians.T, strict=True))
        others = [method for method in self.methods if method != reference]
        p_values = {method: wilcoxon_p(column[reference], column[method]) for method in others}
        corrected = holm(p_values)
        return {
            "reference": reference,
            "friedman_p": friedman_p(medians),
            "methods": {
                method: {
                    **self._method_figures(limit, method, problems, reference),
                    "mean_rank": ranks[method],
                    "wilcoxon_p": p_values.get(method),
                    "wilcoxon_holm_p": corrected.get(method),
                }
                for method in self.methods
            },
        }

    def _median_gaps(self, limit: Limit, problems: Sequence[BenchProblem]) -> FloatArray:
        """(n problems, m methods) median over seeds; infinite where there is no run."""
        medians = np.full((len(problems), len(self.methods)), np.inf)
        for i, problem in enumerate(problems):
            for j, method in enumerate(self.methods):
                if gaps := self._gaps(self.chosen(limit, method=method, problems=[problem.name])):
                    medians[i, j] = quartiles(gaps)[1]
        return medians

    def _gaps(self, runs: Iterable[Run]) -> list[float]:
        return [final_gap(run, self.best_km[run.job.problem]) for run in runs]

    def _method_figures(
        self, limit: Limit, method: str, problems: Sequence[BenchProblem], reference: str
    ) -> dict[str, Any]:
        runs = self.chosen(limit, method=method, problems=[p.name for p in problems])
        if not runs:
            return {"runs": 0}
        first, middle, third = quartiles(self._gaps(runs))
        figures: dict[str, Any] = {
            "runs": len(runs),
            "gap": {"q1": finite(first), "median": finite(middle), "q3": finite(third)},
        }
        for target in TARGETS:
            reached = [self._reached(run, EVALUATIONS, target) for run in runs]
            each = [self.running_times(limit, method, problem, target) for problem in problems]
            evaluations, cpu_s = zip(*each, strict=True)
            theirs = [self.running_times(limit, reference, problem, target)[1] for problem in problems]
            ratios = [
                ours / s if math.isfinite(s) else 0.0
                for ours, s in zip(cpu_s, theirs, strict=True)
                if min(ours, s) < math.inf
            ]
            figures[f"within_{target:g}"] = {
                "success_rate": float(np.mean(np.isfinite(reached))),
                "evaluations_per_dimension": finite(quartiles(evaluations)[1]),
                "cpu_s": finite(quartiles(cpu_s)[1]),
                "cpu_s_over_reference": finite(quartiles(ratios)[1]) if ratios else None,
            }
        return figures

    def running_times(self, limit: Limit, method: str, problem: BenchProblem, target: float) -> tuple[float, float]:
        """Expected evaluations a dimension, and expected CPU seconds, to come within a target."""
        runs = self.chosen(limit, method=method, problems=[problem.name])
        evaluations = expected_running_time(
            [self._reached(run, EVALUATIONS, target) for run in runs], [run.evaluations for run in runs]
        )
        cpu_s = expected_running_time([self._reached(run, CPU_S, target) for run in runs], [run.cpu_s for run in runs])
        return evaluations / problem.dimension, cpu_s

    def _reached(self, run: Run, column: int, target: float) -> float:
        return float(used_to_reach(run, self.best_km[run.job.problem], column, np.array([target]))[0])


def finite(value: float) -> float | None:
    """For JSON, which knows no infinity."""
    return value if math.isfinite(value) else None


def _run_json(run: Run) -> dict[str, Any]:
    return {
        "problem": run.job.problem,
        "method": run.job.method,
        "seed": run.job.seed,
        "limit": run.job.limit.label,
        "evaluations": run.evaluations,
        "cpu_s": round(run.cpu_s, 6),
        "lines": [[int(evaluations), round(cpu_s, 6), round(km, 7)] for evaluations, cpu_s, km in run.lines.tolist()],
    }
