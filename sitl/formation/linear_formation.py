"""The formation as a linear system: the law (15) without its clips, and the modes it falls apart into."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from missions.scenario.network import FormationModel
from sitl.formation.graph import edges, laplacian
from sitl.formation.law import Gains

Array = npt.NDArray[np.float64]

SAME = 1e-6
"""Eigenvalues as near as this, in shares of the largest, are one of several fold."""


@dataclass(frozen=True)
class LinearFormation:
    """n vehicles with deviations e: each accelerates by c_p - d_p e' - k0 h_p e, the rows of c being
    -Lap (k1 e + k2 e')(t - tau).

    Attributes:
        laplacian: weighted, symmetric, (n, n), of a connected graph.
        gains: of the law.
        pinned: h_p, 1 for who keeps to its own schedule and 0 for who does not, (n,).
        bare: h_p switches k3 as in (15); in the law that is flown each vehicle has k3, and h_p switches k0 alone.
    """

    laplacian: Array
    gains: Gains
    pinned: Array
    bare: bool = False

    def damping(self) -> Array:
        """d_p (1/s), (n,)."""
        return self.gains.k3 * (self.pinned if self.bare else np.ones(len(self.pinned)))

    def pins(self) -> Array:
        """k0 h_p (1/s^2), (n,)."""
        return self.gains.k0 * self.pinned

    def alike(self) -> bool:
        """Whether all vehicles have the same own feedback, so that the modes separate."""
        return bool(np.ptp(self.damping()) == 0.0 and np.ptp(self.pins()) == 0.0)


def linear_formation(formation: FormationModel, sysids: Sequence[int], *, bare: bool = False) -> LinearFormation:
    """The formation of some vehicles, rows in order of sysid: the law as flown, or the bare one with unit weights."""
    graph = edges(formation.graph, sysids)
    return LinearFormation(
        laplacian=laplacian(sysids, graph, unit_weights=bare),
        gains=Gains(formation.k1, formation.k2, formation.k3, formation.k0),
        pinned=np.array([float(formation.is_pinned(sysid)) for sysid in sorted(sysids)]),
        bare=bare,
    )


@dataclass(frozen=True)
class Mode:
    """What can be studied by itself: m = 1 for one eigenvalue, or the whole formation, m = n.

    Attributes:
        block: the eigenvalue or the Laplacian, (m, m).
        damping, pins: own feedback, (m,).
        eigenvalue: lambda; None of a whole formation.
        vectors: eigenvectors, (n, multiplicity); the identity of a whole formation.
    """

    block: Array
    damping: Array
    pins: Array
    eigenvalue: float | None
    vectors: Array

    @property
    def multiplicity(self) -> int:
        """How many modes are like this; 1 of a whole formation."""
        return 1 if self.eigenvalue is None else self.vectors.shape[1]


def modes(formation: LinearFormation) -> list[Mode]:
    """The modes with lambda > 0, ascending, equal ones once; the whole as one when own feedback differs.

    Modes move vehicles against each other. The one with lambda = 0 moves all alike, hears nothing and has no margin.
    """
    damping, pins = formation.damping(), formation.pins()
    if not formation.alike():
        return [Mode(formation.laplacian, damping, pins, None, np.eye(len(pins)))]
    values, vectors = np.linalg.eigh(formation.laplacian)
    near = SAME * max(values[-1], 1e-300)
    found: list[Mode] = []
    first = int(np.searchsorted(values, near))
    while first < len(values):
        last = int(np.searchsorted(values, values[first] + near))
        value = float(values[first:last].mean())
        found.append(Mode(np.array([[value]]), damping[:1], pins[:1], value, vectors[:, first:last]))
        first = last
    return found


def evenly_pinned(formation: LinearFormation) -> LinearFormation:
    """The formation with the mean h_p for all, so that its modes separate."""
    return replace(formation, pinned=np.full(len(formation.pinned), formation.pinned.mean()))


def common_mode(formation: LinearFormation) -> Mode:
    """The mode that moves all alike, of a formation whose modes separate."""
    n = len(formation.pinned)
    vectors = np.full((n, 1), 1.0 / np.sqrt(n))
    return Mode(np.zeros((1, 1)), formation.damping()[:1], formation.pins()[:1], 0.0, vectors)


def closed_loop(of: Sequence[Mode], alone: Array, drive: Array, hearing: Array) -> Array:
    """State matrices of modes of one size with their feedback closed, (len(of), m d, m d).

    Args:
        alone: of one vehicle with states (e, e', ...) that neither keeps to its schedule nor hears anyone, (d, d).
        drive: what an acceleration asked for does to its states, (d,).
        hearing: what the states of the heard do to those of the hearer, per unit of weight, (d, d).
    """

    def spread(between: Array, within: Array) -> Array:
        return np.asarray(np.einsum("zij,ab->ziajb", between, within))

    blocks = np.stack([mode.block for mode in of])
    each = np.eye(blocks.shape[1])
    pins = np.stack([mode.pins for mode in of])[:, :, None] * each
    damping = np.stack([mode.damping for mode in of])[:, :, None] * each
    on_position, on_rate = np.outer(drive, np.eye(len(drive))[0]), np.outer(drive, np.eye(len(drive))[1])
    matrices = (
        spread(np.broadcast_to(each, blocks.shape), alone)
        - spread(pins, on_position)
        - spread(damping, on_rate)
        - spread(blocks, hearing)
    )
    size = blocks.shape[1] * len(drive)
    return matrices.reshape(len(of), size, size)
