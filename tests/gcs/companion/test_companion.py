"""Plain autopilots with companions keep together in wind that nobody foresaw; without, they do not."""

from collections.abc import Callable
from typing import Any

from gcs.companion.companion import Companion
from gcs.companion.run import Companionship
from missions.scenario import Scenario
from planner.formation_plan import FormationPlan
from sitl.formation.correction import Correction
from sitl.ticks import TICK_S

WIND_M_S = (-5.0, 0.0)
EVERY_TICKS = 5
ON_ITS_WAY_TICKS = 8
"""From a companion's decision to the autopilot."""


def arrival_spread_s(
    short: Scenario, plan: FormationPlan, vehicles: dict[int, Any], telemetry: Callable[..., Any], *, ordered: bool
) -> float:
    """Fly until all have arrived; companions watch, and are obeyed if that is wished."""
    shared = Companionship(short, plan)
    said: dict[int, Correction] = {}
    orders: list[tuple[int, int, float]] = []
    tick = 0

    def companion(slot: int) -> Companion:
        def say(sample: Correction) -> None:
            said[slot] = sample

        def order(airspeed_m_s: float) -> None:
            orders.append((tick + ON_ITS_WAY_TICKS, slot, airspeed_m_s))

        return shared.companion(slot, say, lambda: said, order)

    companions = {slot: companion(slot) for slot in vehicles}
    while not all(one.done for one in companions.values()):
        assert tick * TICK_S < 200.0, "somebody does not arrive"
        for vehicle in vehicles.values():
            vehicle.observe()
        for slot, one in companions.items() if tick % EVERY_TICKS == 0 else ():
            for message in telemetry(vehicles[slot], short.frame):
                one.on_message(message)
        for vehicle in vehicles.values():
            vehicle.advance({})
        for order in [order for order in orders if order[0] <= tick]:
            orders.remove(order)
            if ordered:
                assert vehicles[order[1]].change_speed(order[2], over_ground=False) is None
        tick += 1
    late = [one.arrival_s - shared.planned_s[slot] for slot, one in companions.items() if one.arrival_s is not None]
    assert len(late) == len(vehicles)
    if ordered:
        assert max(map(abs, late)) < 1.0
    return max(late) - min(late)


def test_companions_keep_the_arrivals_together(
    short: Scenario, short_plan: FormationPlan, plain_vehicles: Callable[..., Any], telemetry: Callable[..., Any]
) -> None:
    alone = arrival_spread_s(short, short_plan, plain_vehicles(WIND_M_S), telemetry, ordered=False)
    kept = arrival_spread_s(short, short_plan, plain_vehicles(WIND_M_S), telemetry, ordered=True)
    assert kept < 0.5
    assert kept < alone / 2.0
