"""The merit against finite differences and against the exact kernel."""

import numpy as np
import numpy.typing as npt
from conftest_types import DrawProblem
