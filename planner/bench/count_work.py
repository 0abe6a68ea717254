"""How much arithmetic one evaluation of the objective takes, counted: the kernel's own source, run as plain Python on
numbers that count."""

import math
import operator
import types
from collections import Counter
from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt

from planner.cost.kernel import path_cost
from planner.cost.problem import PathProblem

FloatArray = npt.NDArray[np.float64]

FUNCTIONS = {
    "exp": "exp",
    "sqrt": "sqrt",
    "hypot": "sqrt",
    "atan": "atan",
    "atan2": "atan",
    "tan": "atan",
}
"""Functions that kernels call, and under which kind they count: those of one kind cost about alike."""
KINDS = ("flops", "sqrt", "exp", "atan")


class Counted:
    """A number that adds its operations to a counter: + - * / as one flop each; comparisons are free."""

    __slots__ = ("counts", "value")

    def __init__(self, value: float, counts: Counter[str]) -> None:
        self.value, self.counts = value, counts

    def _of(self, operation: Callable[[float, float], float], a: Any, b: Any) -> "Counted":
        self.counts["flops"] += 1
        return Counted(operation(float(a), float(b)), self.counts)

    def __add__(self, other: Any) -> "Counted":
        return self._of(operator.add, self, other)

    def __radd__(self, other: Any) -> "Counted":
        return self._of(operator.add, other, self)

    def __sub__(self, other: Any) -> "Counted":
        return self._of(operator.sub, self, other)

    def __rsub__(self, other: Any) -> "Counted":
        return self._of(operator.sub, other, self)

    def __mul__(self, other: Any) -> "Counted":
        return self._of(operator.mul, self, other)

    def __rmul__(self, other: Any) -> "Counted":
        return self._of(operator.mul, other, self)

    def __truediv__(self, other: Any) -> "Counted":
        return self._of(operator.truediv, self, other)

    def __rtruediv__(self, other: Any) -> "Counted":
        return self._of(operator.truediv, other, self)

    def __neg__(self) -> "Counted":
        return Counted(-self.value, self.counts)

    def __abs__(self) -> "Counted":
        return Counted(abs(self.value), self.counts)

    def __float__(self) -> float:
        return self.value

    def __int__(self) -> int:
        return int(self.value)

    def __floor__(self) -> int:
        return math.floor(self.value)

    def __lt__(self, other: Any) -> bool:
        return self.value < float(other)

    def __le__(self, other: Any) -> bool:
        return self.value <= float(other)

    def __gt__(self, other: Any) -> bool:
        return self.value > float(other)

    def __ge__(self, other: Any) -> bool:
        return self.value >= float(other)

    def __eq__(self, other: object) -> bool:
        return self.value == float(other)  # type: ignore[arg-type]

    __hash__ = None  # type: ignore[assignment]


def work_of(corners_m: FloatArray, problem: PathProblem) -> tuple[float, Counter[str]]:
    """Cost of a path of (n + 1, 3) corners, kilometres, and how many operations of each of `KINDS` that took."""
    counts: Counter[str] = Counter()

    def counted(values: Any) -> Any:
        array = np.asarray(values, dtype=np.float64)
        return np.array([Counted(v, counts) for v in array.ravel().tolist()], dtype=object).reshape(array.shape)

    names: dict[str, Any] = {"math": _counting_math(counts), "np": _object_numpy()}
    cost = _plain(path_cost, names, {})(counted(corners_m), problem, True, np.empty(5, dtype=object))
    return float(cost), counts


def _counting_math(counts: Counter[str]) -> types.SimpleNamespace:
    """The module `math` for numbers that count."""

    def counting(name: str, kind: str) -> Callable[..., Counted]:
        function = getattr(math, name)

        def call(*arguments: Any) -> Counted:
            counts[kind] += 1
            return Counted(function(*map(float, arguments)), counts)

        return call

    functions = {name: counting(name, kind) for name, kind in FUNCTIONS.items()}
    return types.SimpleNamespace(inf=math.inf, pi=math.pi, floor=math.floor, **functions)


def _object_numpy() -> types.SimpleNamespace:
    """As much of numpy as kernels use, with arrays that hold any number."""

    def zeros(shape: Any, dtype: Any = object) -> Any:
        return np.zeros(shape, dtype=dtype)

    return types.SimpleNamespace(empty=zeros, zeros=zeros, int64=np.int64)


def _plain(dispatcher: Any, names: dict[str, Any], done: dict[Any, Any]) -> Any:
    """A compiled function's source with other modules in place of `math` and `np`, and its callees likewise."""
    if dispatcher not in done:
        function = dispatcher.py_func
        callees = {
            name: _plain(value, names, done)
            for name in function.__code__.co_names
            if hasattr(value := function.__globals__.get(name), "py_func")
        }
        done[dispatcher] = types.FunctionType(
            function.__code__, {**function.__globals__, **callees, **names}, function.__name__, function.__defaults__
        )
    return done[dispatcher]
