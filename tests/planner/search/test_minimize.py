"""The searches as a general tool: arguments and results."""

import numpy as np
import pytest
from scipy.optimize import Bounds

from missions.errors import InputError
from planner.search import minimize
from planner.search.objective import FloatArray
from planner.search.peers import extra

BOX = [(-1.0, 1.0)] * 3


def sphere(x: FloatArray) -> FloatArray:
    return np.sum(x**2, axis=1)


def test_bounds_may_be_scipys() -> None:
    pairs = minimize(sphere, BOX, method="pso", budget=100, seed=1)
    assert np.array_equal(minimize(sphere, Bounds([-1] * 3, [1] * 3), method="pso", budget=100, seed=1).x, pairs.x)


def test_all_kinds_of_seeds_are_taken() -> None:
    for seed in (5, np.random.SeedSequence(5), np.random.default_rng(5)):
        same = minimize(sphere, BOX, method="pso", budget=100, seed=seed)
        assert np.array_equal(same.x, minimize(sphere, BOX, method="pso", budget=100, seed=5).x)


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        ({"method": "cmaess"}, r"method cmaess: must be one of .*pso.*; did you mean cmaes\?"),
        ({"budget": 0}, "budget 0: must be a whole number of evaluations, 1 or more"),
        ({"budget": 1e3}, "budget 1000.0: must be a whole number"),
        ({"seed": -1}, "seed -1: expected non-negative integer"),
        (
            {"bounds": [(0.0, 1.0), (2.0, 1.0)]},
            r"bounds\[1\]: the lowest value must be below the highest, got 2.0",
        ),
        ({"bounds": [(0.0, np.inf)]}, r"bounds\[0\]: must be finite, got 0.0 to inf"),
        ({"bounds": [(np.nan, 1.0)]}, r"bounds\[0\]: must be finite"),
        ({"bounds": [0.0, 1.0]}, r"bounds: must have shape \(d, 2\).*, got \(2,\)"),
        ({"bounds": np.empty((0, 2))}, r"bounds: must have shape \(d, 2\)"),
        ({"x0": [0.0, 0.0]}, r"x0: must have shape \(3,\) or \(n, 3\), got \(2,\)"),
        ({"x0": [[0.0] * 3, [0.0, 0.0, 1.5]]}, r"x0\[1\]\[2\]: must be within the bounds -1.0 to 1.0, got 1.5"),
        ({"x0": [0.0, np.nan, 0.0]}, r"x0\[0\]\[1\]: must be within the bounds -1.0 to 1.0, got nan"),
        ({"fun": lambda x: x}, r"fun: must turn points of shape \(40, 3\) into costs of shape \(40,\).*\(40, 3\)"),
        ({"fun": lambda x: 1.0}, r"fun: .* returned shape \(\)"),
    ],
)
def test_wrong_arguments_are_named(wrong: dict[str, object], message: str) -> None:
    right: dict[str, object] = {"fun": sphere, "bounds": BOX, "method": "pso", "budget": 50, "seed": 1}
    with pytest.raises(InputError, match=message):
        minimize(**{**right, **wrong})  # type: ignore[arg-type]


@pytest.mark.parametrize("method", ["cmaes", "lshade", "pyswarms"])
def test_a_missing_library_is_named_with_the_extra_that_brings_it(method: str, monkeypatch: pytest.MonkeyPatch) -> None:
    def missing(name: str) -> None:
        raise ImportError(name)

    monkeypatch.setattr(extra.importlib, "import_module", missing)
    with pytest.raises(InputError, match=rf"method {method}: needs the library .*pip install 'skein-gcs\[bench\]'"):
        minimize(sphere, BOX, method=method, budget=50, seed=1)
