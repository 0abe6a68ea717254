"""A place keeps within two centimetres from the plan to the telemetry, and what would break that is seen."""

from dataclasses import replace

import numpy as np
import pytest

from gcs.bench.position_chain import LIMIT_M, PositionChain, measure_chain, stage, waypoints_m
from gcs.cli.bench_chain import chain_table
from missions.mission import Mission, as_float32
from missions.scenario import Scenario
from planner.formation_plan import FormationPlan

HALF_STEP_M = 0.5e-7 * 111_700.0
"""Half of the wire's 1e-7 degrees, at most; so much may each axis be off."""
HALF_A_MILLIMETRE_M = 0.5e-3


@pytest.fixture(scope="module")
def chain(short: Scenario, short_plan: FormationPlan) -> PositionChain:
    return measure_chain(short, short_plan)


def test_the_whole_keeps_within_two_centimetres(chain: PositionChain) -> None:
    assert chain.holds
    assert 0.0 < chain.whole.distance_m < LIMIT_M == 0.02
    assert chain.whole.distance_m <= sum(one.distance_m for one in chain.stages)


def test_each_stage_is_off_by_what_it_rounds_and_no_more(chain: PositionChain, short_plan: FormationPlan) -> None:
    to_mission, *files, to_vehicle, to_telemetry = chain.stages
    places = sum(len(uav.waypoints_m) for uav in short_plan.uavs)
    assert to_mission.compared == to_vehicle.compared == places
    assert [one.compared for one in files] == [2 * places] * 3
    assert to_telemetry.compared > 20 * len(short_plan.uavs)
    for rounded in (to_mission, to_telemetry):
        assert 0.0 < rounded.horizontal_m <= 2**0.5 * HALF_STEP_M
    for exact in (*files, to_vehicle):
        assert exact.horizontal_m == 0.0
        assert exact.vertical_m < HALF_A_MILLIMETRE_M
    assert to_telemetry.vertical_m <= 1.01 * HALF_A_MILLIMETRE_M


def test_positions_in_float32_would_be_seen(short: Scenario, short_plan: FormationPlan) -> None:
    uav = short_plan.uavs[0]
    coarse = Mission(
        tuple(
            replace(item, lat_e7=round(as_float32(item.lat_deg) * 1e7), lon_e7=round(as_float32(item.lon_deg) * 1e7))
            for item in uav.mission
        )
    )
    errors = waypoints_m(coarse, short.frame, lambda *_: 0.0) - uav.waypoints_m
    assert stage("coarse", [errors]).horizontal_m > LIMIT_M


def test_the_table_has_each_stage_and_the_whole(chain: PositionChain) -> None:
    table = chain_table(chain)
    assert list(table.columns[0].cells) == [one.name for one in (*chain.stages, chain.whole)]
    assert list(table.columns[-1].cells)[-1] == f"{1e3 * chain.whole.distance_m:.2f}"
    assert np.isclose(chain.as_json()["whole"]["distance_m"], chain.whole.distance_m)
