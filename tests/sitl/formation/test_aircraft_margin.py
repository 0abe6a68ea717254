"""The aircraft's margin against aircraft: the functions that endpoints fly with, tick by tick, on a straight track."""

import math
from collections import deque

import numpy as np
import pytest

from missions.reference import ReferenceTables
from missions.scenario import load_scenario
from sitl.aircraft.gusts import NORMALS_PER_TICK
from sitl.flight import at_point, ground_velocity, launched, make_aircraft, moved, path_accelerations
from sitl.formation.graph import edges, laplacian, neighbour_weights
from sitl.formation.law import Gains, correction, formation_acceleration
from sitl.formation.linear_formation import LinearFormation
from sitl.formation.margin import aircraft_margin_s
from sitl.guidance.path_errors import PathErrors, ScheduleClock, path_errors
from sitl.ticks import TICK_S

SPEED_M_S, HEIGHT_M = 28.0, 500.0
STRAIGHT = ReferenceTables(
    segments=[(0.0, 0.0, 0.0, 0.0, 0.0)],
    altitude=[(0.0, HEIGHT_M, 0.0, 0.0)],
    schedule=[(0.0, 0.0, SPEED_M_S, 0.0)],
    airspeeds=[(0.0, SPEED_M_S)],
    length_m=20_000.0,
    duration_s=20_000.0 / SPEED_M_S,
)
STILL = (0.0,) * NORMALS_PER_TICK
FLOWN = Gains(0.2, 0.8, 0.4, 0.01)
SCENARIO = load_scenario("radars")


@pytest.mark.parametrize(("kind", "count", "wind"), [("ring", 4, (0.0, 0.0)), ("line", 3, (-3.0, 4.0))])
def test_aircraft_turn_unstable_at_their_margin(kind: str, count: int, wind: tuple[float, float]) -> None:
    sysids = range(1, count + 1)
    matrix = laplacian(sysids, edges(kind, sysids))
    margin_s = aircraft_margin_s(LinearFormation(matrix, FLOWN, np.ones(count)), SCENARIO.airframe.airframe())
    below = math.floor(margin_s / TICK_S)
    settles, grows = (growth_rate(kind, count, ticks, wind) for ticks in (below - 1, below + 2))
    assert settles < 0.0 < grows
    knee = below - 1 + 3.0 * settles / (settles - grows)
    assert knee * TICK_S == pytest.approx(margin_s, rel=0.03)


def growth_rate(kind: str, count: int, delay_ticks: int, wind: tuple[float, float]) -> float:
    """Of the swing of the quickest mode (1/s), 30 to 60 s after a disturbance of centimetres."""
    sysids = range(1, count + 1)
    graph = edges(kind, sysids)
    weights = {sysid: neighbour_weights(sysid, graph) for sysid in sysids}
    shape = np.linalg.eigh(laplacian(sysids, graph))[1][:, -1]
    aircraft = make_aircraft(SCENARIO.airframe.airframe(), SCENARIO.environment.terrain, "none", wind)
    flights = {p: launched((0.05 * shape[p - 1], 0.0, HEIGHT_M), STRAIGHT, STILL, aircraft) for p in sysids}
    past: deque[dict[int, PathErrors]] = deque(maxlen=delay_ticks + 1)
    swing = []
    for tick in range(round(60.0 / TICK_S)):
        now = {}
        for p, flight in flights.items():
            position = (flight.air.x, flight.air.y, flight.air.h)
            clock = ScheduleClock(tick * TICK_S, 1.0, 0.0)
            now[p], point = path_errors(position, ground_velocity(flight), clock, flight.point, STRAIGHT)
            flights[p] = at_point(flight, point)
        past.append(now)
        swing.append(sum(shape[p - 1] * now[p].along_rate for p in sysids))
        for p, flight in flights.items():
            heard = 0.0
            if len(past) > delay_ticks:
                own = past[0][p]
                for q, weight in weights[p].items():
                    other = past[0][q]
                    heard += correction(own.along, own.along_rate, other.along, other.along_rate, weight, FLOWN)
            ahead = formation_acceleration(now[p], heard, FLOWN)
            flights[p] = moved(flight, path_accelerations(now[p], ahead, flight.air.V, aircraft.airframe), aircraft)
    early, late = np.split(np.array(swing)[len(swing) // 2 :], 2)
    return math.log(np.sqrt(np.mean(late**2)) / np.sqrt(np.mean(early**2))) / (len(late) * TICK_S)
