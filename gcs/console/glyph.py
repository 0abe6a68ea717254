"""The shape of an aircraft: nose +x, left wing +y, top +z, one unit from nose to tail."""

import numpy as np
import numpy.typing as npt

VERTICES: npt.NDArray[np.float32] = np.array(
    [
        (0.55, 0.0, 0.0),  # 0 nose
        (0.1, 0.06, 0.0),  # 1-4 fuselage, widest
        (0.1, -0.06, 0.0),
        (0.1, 0.0, 0.07),
        (0.1, 0.0, -0.05),
        (-0.45, 0.0, 0.02),  # 5 tail
        (0.16, 0.0, 0.03),  # 6-9 wing: roots and tips
        (-0.06, 0.0, 0.03),
        (0.0, 0.6, 0.06),
        (0.0, -0.6, 0.06),
        (-0.12, 0.6, 0.06),  # 10-11 its trailing tips
        (-0.12, -0.6, 0.06),
        (-0.33, 0.0, 0.03),  # 12-14 tailplane
        (-0.47, 0.2, 0.03),
        (-0.47, -0.2, 0.03),
        (-0.32, 0.0, 0.02),  # 15-17 fin
        (-0.48, 0.0, 0.2),
        (-0.48, 0.0, 0.02),
    ],
    dtype=np.float32,
)
FACES: npt.NDArray[np.uint32] = np.array(
    [
        (0, 1, 3), (0, 3, 2), (0, 2, 4), (0, 4, 1), (5, 3, 1), (5, 2, 3), (5, 4, 2), (5, 1, 4),
        (6, 8, 10), (6, 10, 7), (6, 7, 11), (6, 11, 9),
        (12, 13, 5), (12, 5, 14), (15, 16, 17),
    ],
    dtype=np.uint32,
)  # fmt: skip
