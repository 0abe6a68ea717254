"""Delay margins against simulation in time: `python -m gcs.bench.margins` prints the table of docs/margin.md."""

import itertools
from collections.abc import Iterator, Sequence

import numpy as np
import numpy.typing as npt

from missions.scenario import load_scenario
from sitl.formation.graph import Edge, edges, laplacian
from sitl.formation.law import Gains
from sitl.formation.linear_formation import LinearFormation
from sitl.formation.margin import Level, margin_s, mode_margins
from sitl.ticks import TICK_S

Array = npt.NDArray[np.float64]

NINE = range(1, 10)
BARE, FLOWN, FLOWN_PINNED = Gains(0.2, 1.0, 1.0, 0.0), Gains(0.2, 0.8, 0.4, 0.01), Gains(0.2, 0.8, 0.4, 0.1)
STEPS_A_MARGIN = 200
"""Of continuous time."""
SHARES = np.arange(0.94, 1.065, 0.01)
"""Of the margin: delays among which the knee is looked for."""
WINDOWS = 8
STEPS: dict[Level, int] = {"continuous": 24_000, "sampled": 12_000}


def custom_graph() -> tuple[Edge, ...]:
    """A tree over nine vehicles and four more edges, drawn once."""
    rng = np.random.default_rng(3)
    tree = [(int(rng.integers(1, node)), node) for node in NINE[1:]]
    others = [pair for pair in itertools.combinations(NINE, 2) if pair not in tree]
    return tuple(sorted([*tree, *(others[i] for i in rng.choice(len(others), 4, replace=False))]))


def studies() -> dict[tuple[str, str], LinearFormation]:
    """Formations of nine by graph and law: the bare law with unit weights, the one flown; pinned all or one."""
    graphs = {kind: edges(kind, NINE) for kind in ("ring", "star", "complete", "line")} | {"custom": custom_graph()}
    everyone, first = np.ones(9), np.eye(9)[0]
    found = {}
    for kind, graph in graphs.items():
        unit, weighted = laplacian(NINE, graph, unit_weights=True), laplacian(NINE, graph)
        found[kind, "bare"] = LinearFormation(unit, BARE, everyone, bare=True)
        found[kind, "bare, pin one"] = LinearFormation(unit, BARE, first, bare=True)
        found[kind, "flown"] = LinearFormation(weighted, FLOWN, everyone)
        found[kind, "k0 = 0.1"] = LinearFormation(weighted, FLOWN_PINNED, everyone)
        found[kind, "k0 = 0.1, pin one"] = LinearFormation(weighted, FLOWN_PINNED, first)
    return found


def time_steps(margins_s: Array, level: Level) -> Array:
    """Steps that a level is simulated with: the tick, or a two hundredth of each margin for continuous time."""
    return margins_s / STEPS_A_MARGIN if level == "continuous" else np.full(len(margins_s), TICK_S)


def simulated_growth(formations: Sequence[LinearFormation], steps_s: Array, delays_s: Array, count: int) -> Array:
    """By how much (logarithm) formations swing more in the last eighth of a simulation than in the one before,
    (formations, delays).

    All are simulated side by side for `count` steps, from one disturbance. A vehicle is a double integrator with its
    command held over the step; what was said between steps is interpolated.

    Args:
        steps_s: of each formation, (formations,).
        delays_s: of each, some, (formations, delays).
    """
    laplacians = np.stack([formation.laplacian for formation in formations])
    k1, k2 = (np.array([getattr(f.gains, key) for f in formations])[:, None, None] for key in ("k1", "k2"))
    damping, pins = (np.stack([getattr(f, key)() for f in formations])[:, :, None] for key in ("damping", "pins"))
    dt = steps_s[:, None, None]
    late = np.floor(delays_s / steps_s[:, None] + 1e-9).astype(int)[:, None, :]
    later = (delays_s / steps_s[:, None] - late[:, 0]).round(9)[:, None, :]
    n, columns = laplacians.shape[1], delays_s.shape[1]
    f, i, d = np.ix_(range(len(formations)), range(n), range(columns))
    free = ~pins.any(axis=1, keepdims=True)

    e = np.broadcast_to(np.random.default_rng(1).normal(size=(n, 1)), (len(formations), n, columns)).copy()
    rate = np.zeros_like(e)
    slots, window = int(late.max()) + 2, count // WINDOWS
    said = np.zeros((slots, *e.shape))
    energy = np.zeros((len(formations), columns))
    growth = np.zeros_like(energy)
    for step in range(count):
        said[step % slots] = k1 * e + k2 * rate
        heard = said[(step - late) % slots, f, i, d]
        if later.any():
            heard = (1.0 - later) * heard + later * said[(step - late - 1) % slots, f, i, d]
        u = -laplacians @ heard - damping * rate - pins * e
        e += dt * rate + 0.5 * dt * dt * u
        rate += dt * u
        energy += (rate * rate).sum(axis=1) / window
        if (step + 1) % window == 0:  # from here on in units of what there was in this window
            growth = 0.5 * np.log(energy)
            size = np.sqrt(energy)[:, None, :]
            # Where nothing pins it, the place of the whole is nobody's business, and would drown the rest in round-off.
            e, said = e - free * e.mean(axis=1, keepdims=True), said - free * said.mean(axis=2, keepdims=True)
            e, rate, said, energy = e / size, rate / size, said / size, np.zeros_like(energy)
    return growth


def simulated_knees(formations: Sequence[LinearFormation], steps_s: Array, near_s: Array, count: int) -> Array:
    """The delays near those given at which growth begins, between one of `SHARES` and the next."""
    growth = simulated_growth(formations, steps_s, np.outer(near_s, SHARES), count)
    first = np.argmax(growth > 0.0, axis=1)
    rows = np.arange(len(growth))
    below, above = growth[rows, first - 1], growth[rows, first]
    share = SHARES[first - 1] + below / (below - above) * (SHARES[first] - SHARES[first - 1])
    return np.where(first > 0, share * near_s, np.nan)


def table() -> Iterator[str]:
    """Margins and knees, as rows of Markdown."""
    airframe = load_scenario("radars").airframe.airframe()
    cases = studies()
    margins = [mode_margins(formation, airframe) for formation in cases.values()]
    yield "| graph | law | `continuous_s` | simulated | `sampled_s` | simulated | `aircraft_s` |"
    yield "|---|---|---|---|---|---|---|"
    columns = []
    for level, count in STEPS.items():
        found = np.array([margin_s(one, level) for one in margins])
        columns += [found, simulated_knees(list(cases.values()), time_steps(found, level), found, count)]
    columns.append(np.array([margin_s(one, "aircraft") for one in margins]))
    for (graph, law), row in zip(cases, np.stack(columns, axis=1), strict=True):
        yield f"| {graph} | {law} | " + " | ".join(f"{value:.3f}" for value in row) + " |"


if __name__ == "__main__":
    print("\n".join(table()))
