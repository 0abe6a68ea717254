import math

import numpy as np
import pytest

from gcs.metrics.flight_limits import flight_limits
from sitl.ticks import TICK_S


def test_a_helix_turns_and_climbs_at_its_rates() -> None:
    t_s = np.arange(5000) * TICK_S
    heading = (0.2 * t_s + math.pi) % (2 * math.pi) - math.pi
    speed = 28.0 + np.sin(t_s)
    truth = np.column_stack([t_s, t_s, -1.5 * t_s, speed, np.zeros_like(t_s), heading])
    limits = flight_limits(3, truth)
    assert limits.sysid == 3
    assert limits.turn_rate_max_deg_s == pytest.approx(math.degrees(0.2))
    assert (limits.climb_rate_min_m_s, limits.climb_rate_max_m_s) == pytest.approx((-1.5, -1.5))
    assert (limits.airspeed_min_m_s, limits.airspeed_max_m_s) == pytest.approx((27.0, 29.0), abs=1e-3)


def test_a_flight_of_less_than_a_second_has_no_rates() -> None:
    limits = flight_limits(1, np.full((20, 6), 25.0))
    assert (limits.airspeed_min_m_s, limits.climb_rate_max_m_s, limits.turn_rate_max_deg_s) == (25.0, None, None)
