"""References one after another as one: what the verifier's proofs take."""

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from missions.reference import FilletedPath, Reference

FloatArray = npt.NDArray[np.float64]


def chained(references: Sequence[Reference]) -> Reference:
    """The flight of all of them in turn, the last one's end at the end.

    Args:
        references: at least one, each beginning where the one before ends.
    """
    segments, altitude, schedule, corner_s, corner_time, seqs = [], [], [], [], [], list[int]()
    s0 = t0 = 0.0
    for one in references:
        rows = one.path.segments[one.path.segments[:, 0] < one.length_m]
        segments.append(_moved(rows, s0))
        altitude.append(_moved(_within(one.altitude, one.length_m), s0))
        timed = _moved(_within(one.schedule, one.duration_s), t0)
        timed[:, 1] += s0
        schedule.append(timed)
        corner_s.append(one.path.corner_s_m + s0)
        corner_time.append(one.corner_time_s + t0)
        seqs += one.corner_seq if not seqs else [seqs[-1], *one.corner_seq[1:]]
        s0, t0 = s0 + one.length_m, t0 + one.duration_s
    last = references[-1]
    x, y, heading, _ = last.path.at(np.array(last.length_m))
    segments.append(np.array([[s0, x, y, heading, 0.0]]))
    return Reference(
        path=FilletedPath(
            segments=np.concatenate(segments),
            length_m=s0,
            corner_s_m=np.concatenate(corner_s),
            corner_radius_m=np.concatenate([one.path.corner_radius_m for one in references]),
            corner_turn=np.concatenate([one.path.corner_turn for one in references]),
        ),
        altitude=np.concatenate(altitude),
        schedule=np.concatenate(schedule),
        duration_s=t0,
        corner_seq=tuple(seqs),
        corner_time_s=np.concatenate(corner_time),
        leg_airspeed_m_s=np.concatenate([one.leg_airspeed_m_s for one in references]),
        leg_ground_speed_m_s=np.concatenate([one.leg_ground_speed_m_s for one in references]),
        leg_slope=np.concatenate([one.leg_slope for one in references]),
        target_m=last.target_m,
        loiter_radius_m=last.loiter_radius_m,
        loiter_z_m=last.loiter_z_m,
    )


def _moved(rows: FloatArray, by: float) -> FloatArray:
    moved = rows.copy()
    moved[:, 0] += by
    return moved


def _within(pieces: FloatArray, end: float) -> FloatArray:
    """Quadratic pieces (m, 4) that hold in [0, end), the first beginning at 0."""
    first = max(int(np.searchsorted(pieces[:, 0], 0.0, side="right")) - 1, 0)
    start, c0, c1, c2 = pieces[first]
    head = [0.0, c0 + (c1 - c2 * start) * -start, c1 - 2.0 * c2 * start, c2]
    rest = pieces[first + 1 :]
    return np.vstack([head, rest[rest[:, 0] < end]])
