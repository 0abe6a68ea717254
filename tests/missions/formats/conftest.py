"""A scene by hand: two tracks, a radar and an obstacle."""

import math

import numpy as np
import pytest

from missions.formats.scene import Round, Scene, Stop, Track

AREA = ((46.4, 11.2), (46.4, 11.5), (46.6, 11.5), (46.6, 11.2))


def _round(name: str, lat_deg: float, lon_deg: float, bottom_m: float, top_m: float) -> Round:
    rim = [(lat_deg + 0.01 * math.sin(angle), lon_deg + 0.01 * math.cos(angle)) for angle in np.arange(8) * math.pi / 4]
    return Round(name, lat_deg, lon_deg, 750.0, bottom_m, top_m, tuple(rim))


def _track(sysid: int, name: str, north_deg: float) -> Track:
    time_s = np.arange(0.0, 21.0, 2.0)
    stops = (
        Stop(0, "home", 46.5 + north_deg, 11.3, 1200.0, None, None, 0.0),
        Stop(3, "waypoint", 46.5 + north_deg, 11.32, 1400.0, 80.0, 25.5, 20.0),
    )
    return Track(
        sysid,
        name,
        "#4a45b8",
        time_s,
        np.full(len(time_s), 46.5 + north_deg),
        11.3 + 0.001 * time_s,
        1200.0 + 10.0 * time_s,
        np.full(len(time_s), 24.25),
        stops,
    )


@pytest.fixture
def scene() -> Scene:
    return Scene(
        name="by-hand",
        description="Two <tracks> & more",
        tracks=(_track(1, "leader", 0.0), _track(7, "F6", 0.01)),
        radars=(_round("radar 1", 46.45, 11.35, 1000.0, 2500.0),),
        obstacles=(_round("obstacle 1", 46.55, 11.45, 1150.0, 1650.0),),
        area=AREA,
    )
