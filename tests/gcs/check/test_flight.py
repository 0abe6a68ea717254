"""What is checked is what is flown."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from gcs.check.chain import chained
from gcs.check.flight import planned_flight
from missions.commands import Command
from missions.errors import InputError
from missions.mission import Mission, MissionItem
from missions.plan_type import PlanType
from missions.scenario import Scenario
from missions.vehicle_plan import Plan
from sitl.events import ItemReached
from sitl.modes import Mode
from sitl.swarm import SwarmOptions, vehicle_configs
from sitl.ticks import TICK_S
from sitl.truth import TruthWriter
from sitl.vehicle import Vehicle

Place = Callable[..., MissionItem]
WAYPOINT = Command.NAV_WAYPOINT
TURNS = [
    (Command.NAV_TAKEOFF, 0, 0, 40, {}),
    (WAYPOINT, 1000, 0, 100, {}),
    (Command.NAV_LOITER_TURNS, 2000, 0, 120, {"param1": 1, "param3": -250}),
    (WAYPOINT, 3000, 0, 120, {}),
]
JUMP = [(WAYPOINT, x, y, 100, {}) for x, y in ((900, 0), (900, 900), (0, 900), (0, 300))] + [
    (Command.DO_JUMP, 0, 0, 0, {"param1": 2, "param2": 1})
]
LANDING = [
    (WAYPOINT, 1500, 0, 80, {}),
    (WAYPOINT, 1500, 1500, 60, {}),
    (Command.NAV_LAND, 300, 1500, 0, {}),
]


@pytest.mark.parametrize("items", [TURNS, JUMP, LANDING], ids=["turns", "jump", "landing"])
def test_a_vehicle_is_where_and_when_the_flight_on_paper_says(
    calm: Scenario, home: MissionItem, place: Place, items: list[Any]
) -> None:
    mission = Mission((home, *(place(command, x, y, z, **more) for command, x, y, z, more in items)))
    flight = planned_flight(Plan(mission), calm)
    config = vehicle_configs(calm, SwarmOptions(seed=1, delay_s=0.0))[0]
    vehicle = Vehicle(config, TruthWriter(None))
    vehicle.load(PlanType.MISSION, mission.items)
    assert vehicle.arm() is None
    assert vehicle.set_mode(Mode.AUTO) is None
    flown, reached_s = [], {}
    for tick in range(round((flight.ended_s + 10.0) / TICK_S)):
        vehicle.observe()
        flown.append(vehicle.snapshot().position_m)
        vehicle.advance({})
        reached_s |= {event.seq: tick * TICK_S for event in vehicle.drain_events() if isinstance(event, ItemReached)}
    last = max(seq for seq, item in enumerate(mission) if item.command != Command.DO_JUMP)
    assert reached_s[last] == pytest.approx(flight.ended_s, abs=2.0)
    planned = flight.whole.points(np.arange(0.0, flight.ended_m, 4.0))
    for point in np.array(flown)[: round(reached_s[last] / TICK_S) : 50]:
        assert np.linalg.norm(planned - point, axis=1).min() < 25.0


def test_a_chain_is_at_all_times_where_its_references_are(calm: Scenario, home: MissionItem, place: Place) -> None:
    way = [place(WAYPOINT, 1000, 0, 100), place(WAYPOINT, 2000, 700, 60), place(WAYPOINT, 3500, 0, 120)]
    flights = [planned_flight(Plan(Mission((home, *way[:count]))), calm).paths[0][1] for count in (1, 2, 3)]
    chain, begun_m, begun_s = chained(flights), 0.0, 0.0
    for one in flights:
        t_s = np.linspace(0.0, one.duration_s, 50)[:-1]
        assert np.allclose(chain.positions(begun_s + t_s), one.positions(t_s), atol=1e-6)
        s_m = np.linspace(0.0, one.length_m, 50)[:-1]
        assert np.allclose(chain.slopes(begun_m + s_m), one.slopes(s_m), atol=1e-9)
        begun_m, begun_s = begun_m + one.length_m, begun_s + one.duration_s
    assert (chain.length_m, chain.duration_s) == (begun_m, begun_s)


def test_the_way_home_and_back_on_the_circle_is_part_of_a_flight(
    calm: Scenario, home: MissionItem, place: Place
) -> None:
    mission = Mission((home, place(WAYPOINT, 2000, 0, 100), place(Command.NAV_RETURN_TO_LAUNCH)))
    flight = planned_flight(Plan(mission), calm)
    assert 3700.0 < flight.ended_m < 4700.0
    assert flight.item_at(3000.0) == 2


def test_what_cannot_be_flown_is_said_by_item(calm: Scenario, home: MissionItem, place: Place) -> None:
    mission = Mission((home, place(WAYPOINT, 1000, 0, 300), place(Command.NAV_LAND, 2000, 0, 0)))
    with pytest.raises(InputError, match="mission item 2: LAND: 300 m to lose"):
        planned_flight(Plan(mission), calm)
