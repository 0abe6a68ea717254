"""How much faster or slower than its neighbour a vehicle flies its schedule: seen before it shows in position."""

from collections.abc import Mapping, Sequence

import numpy as np
import numpy.typing as npt

from gcs.metrics.formation_error import Edge

FloatArray = npt.NDArray[np.float64]


def relative_speed_rms_m_s(along_rate_m_s: Mapping[int, FloatArray], graph: Sequence[Edge]) -> float | None:
    """RMS of e_p' - e_q' over the edges (p, q) and the ticks at which both are on their paths; None without any.

    Args:
        along_rate_m_s: by sysid: (ticks,) e', NaN off the path.
    """
    squares, count = 0.0, 0
    for p, q in graph:
        both = min(len(along_rate_m_s[p]), len(along_rate_m_s[q]))
        difference = along_rate_m_s[p][:both] - along_rate_m_s[q][:both]
        known = difference[np.isfinite(difference)]
        squares += float(np.square(known).sum())
        count += len(known)
    return float(np.sqrt(squares / count)) if count else None
