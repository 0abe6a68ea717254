"""How an error travels along a graph: the law (15) in the frequency domain."""

import numpy as np
import numpy.typing as npt

from sitl.formation.graph import Edge
from sitl.formation.linear_formation import LinearFormation

FloatArray = npt.NDArray[np.float64]

FREQUENCIES_RAD_S = np.geomspace(1e-3, 30.0, 3000)


def edge_gains(formation: LinearFormation, delay_s: float, edges: list[Edge]) -> tuple[FloatArray, FloatArray]:
    """The largest amplitudes, over all frequencies, of e_p - e_q and of e_p' - e_q' on each edge when the first vehicle
    is shaken by an acceleration of amplitude 1, (edges,) each: m and m/s per m/s^2.

    (s^2 + d s + p + Lap (k2 s + k1) e^{-s tau}) e = (1, 0, ..., 0) with s = j w.

    Args:
        edges: pairs of rows.
    """
    damping, pins, gains = formation.damping(), formation.pins(), formation.gains
    s = 1j * FREQUENCIES_RAD_S[:, None, None]
    own = np.eye(len(damping)) * (s * s + damping * s + pins)
    matrices = own + formation.laplacian * ((gains.k2 * s + gains.k1) * np.exp(-s * delay_s))
    shaken = np.zeros((len(damping), 1))
    shaken[0] = 1.0
    errors = np.linalg.solve(matrices, shaken[None])[:, :, 0]
    between = np.stack([np.abs(errors[:, p] - errors[:, q]) for p, q in edges])
    return between.max(axis=1), (FREQUENCIES_RAD_S * between).max(axis=1)
