"""Whether one search is better than another, or the order of the problems made it look so: ranks, Friedman's test,
Wilcoxon's signed ranks with Holm's correction (Demsar, J. Machine Learning Research 7, 2006)."""

from collections.abc import Mapping

import numpy as np
import numpy.typing as npt
from scipy import stats

FloatArray = npt.NDArray[np.float64]

TIE = 1e-6
"""Gaps that differ by less are equal."""
WORST_GAP = 10.0
"""Stands for no feasible path, and for anything worse than this."""
FRIEDMAN_METHODS = 3
"""Fewer cannot be tested all at once."""


def comparable(gaps: FloatArray) -> FloatArray:
    """Gaps, rounded to ties and finite."""
    return np.round(np.minimum(gaps, WORST_GAP) / TIE) * TIE


def mean_ranks(gaps: FloatArray) -> FloatArray:
    """(m,) mean rank of each method, 1 the best, from gaps (n problems, m methods); equals share their ranks."""
    ranks: FloatArray = stats.rankdata(comparable(gaps), axis=1).mean(axis=0)
    return ranks


def friedman_p(gaps: FloatArray) -> float | None:
    """Probability of ranks as unequal as these if all methods were alike, from gaps (n problems, m methods).

    None for fewer than three methods or two problems.
    """
    if gaps.shape[1] < FRIEDMAN_METHODS or len(gaps) < 2:
        return None
    values = comparable(gaps)
    if np.all(values == values[:, :1]):
        return 1.0
    return float(stats.friedmanchisquare(*values.T).pvalue)


def wilcoxon_p(ours: FloatArray, theirs: FloatArray) -> float:
    """Two-sided probability of differences over problems (n,) as one-sided as these if both were alike."""
    differences = comparable(ours) - comparable(theirs)
    if not np.any(np.abs(differences) > 0.5 * TIE):
        return 1.0
    return float(stats.wilcoxon(np.round(differences, 9), zero_method="pratt").pvalue)


def holm(p_values: Mapping[str, float]) -> dict[str, float]:
    """Holm's step-down correction of several tests: the smallest times their number, the next times one less, never
    falling."""
    corrected: dict[str, float] = {}
    largest = 0.0
    for i, (name, p) in enumerate(sorted(p_values.items(), key=lambda item: item[1])):
        largest = max(largest, min(1.0, p * (len(p_values) - i)))
        corrected[name] = largest
    return {name: corrected[name] for name in p_values}
