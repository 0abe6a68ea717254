"""How an aircraft lies in the air, as the scene has it."""

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]


def quaternions(attitude_rad: FloatArray) -> FloatArray:
    """(n, 3) roll to the right, pitch up, heading anticlockwise from +x, to quaternions (n, 4) in order w, x, y, z.

    They turn a body whose nose is +x, its left wing +y and its top +z: R = Rz(heading) Ry(-pitch) Rx(roll).
    """
    roll, pitch, heading = np.nan_to_num(attitude_rad).T / 2.0
    cr, sr, cp, sp = np.cos(roll), np.sin(roll), np.cos(-pitch), np.sin(-pitch)
    ch, sh = np.cos(heading), np.sin(heading)
    return np.stack(
        [
            ch * cp * cr + sh * sp * sr,
            ch * cp * sr - sh * sp * cr,
            ch * sp * cr + sh * cp * sr,
            sh * cp * cr - ch * sp * sr,
        ],
        axis=1,
    )
