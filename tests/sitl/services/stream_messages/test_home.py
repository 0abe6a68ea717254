"""Where it returns to."""

from typing import Any

import pytest

from sitl.services.stream_messages.home import gps_global_origin, home_position


def test_home_is_where_the_vehicle_says(view: Any) -> None:
    message = home_position(view())
    assert (message.latitude, message.longitude, message.altitude) == (465_000_000, 113_000_000, 1_200_000)
    assert (message.x, message.y, message.z) == (pytest.approx(0, abs=1e-6), pytest.approx(0, abs=1e-6), -1200.0)


def test_the_origin_is_the_frames(view: Any) -> None:
    message = gps_global_origin(view())
    assert (message.latitude, message.longitude, message.altitude) == (465_000_000, 113_000_000, 0)
