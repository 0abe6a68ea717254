import json
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from gcs.flight_record import FlightRecord
from gcs.metrics import Metrics, measure
from gcs.truth import read_truths, trajectory_sha256
from missions.reference import Reference
from missions.scenario import Scenario
from planner.formation_plan import FormationPlan, load_plan
from sitl.formation.graph import edges

KEYS = {
    "": {"scenario", "seed", "delay_s", "trajectory_sha256", "vehicles", "formation", "timing", "events"},
    "vehicles": {
        "sysid", "name", "fitness", "fitness_terms", "straight_line_km", "planned_length_km", "flown_length_km",
        "planned_arrival_s", "arrival_s", "completed", "items_uploaded", "items_verified",
    },
    "fitness_terms": {"length", "terrain", "radar", "collision", "altitude"},
    "formation": {
        "delay_margin_s", "rms_error_m", "max_error_m", "arrival_spread_s", "min_separation_m", "min_clearance_m",
        "radar_exposure_s", "late_samples", "lost_samples",
    },
    "timing": {"compile_s", "plan_s", "startup_s", "upload_s", "flight_wall_s", "flight_sim_s", "real_time_factor"},
    "events": {"t_s", "sysid", "what"},
}  # fmt: skip
MORE_KEYS = {
    "": {"arm", "limits", "graph", "links", "losses", "real_time", "behind_s"},
    "vehicles": {"lost_s", "place"},
    "formation": {"clearance_margin_m", "min_wall_m", "refused_samples", "measured_delay_s", "slowed_s", "hurried_s"},
}
Truths = dict[int, np.ndarray]
UPWARDS_M = np.array([0.0, 0.0, 6.0, 0.0, 0.0, 0.0])


@pytest.fixture(scope="module")
def plan(radars: Scenario, straight_plan: Callable[[Scenario], FormationPlan]) -> FormationPlan:
    return straight_plan(radars)


@pytest.fixture(scope="module")
def truths(radars: Scenario, plan: FormationPlan, fly_exactly: Callable[[dict[int, Reference]], Truths]) -> Truths:
    """As planned, but vehicle 5 keeps 6 m too high."""
    exact = fly_exactly(plan.references(radars))
    return exact | {5: exact[5] + UPWARDS_M}


@pytest.fixture(scope="module")
def measured(radars: Scenario, plan: FormationPlan, make_record: Callable[..., FlightRecord]) -> Callable[..., Metrics]:
    def run(truths: Truths, **changes: Any) -> Metrics:
        graph = edges("ring", [uav.sysid for uav in plan.uavs])
        return measure(radars, plan, truths, graph, make_record(plan, **changes))[0]

    return run


def test_json_has_the_keys_that_were_agreed_and_nothing_that_json_has_not(
    measured: Callable[..., Metrics], truths: Truths
) -> None:
    values = json.loads(json.dumps(measured(truths).as_json(), allow_nan=False))
    vehicle = values["vehicles"][0]
    levels = values | {"": values, "vehicles": vehicle, "fitness_terms": vehicle["fitness_terms"]}
    levels["events"] = values["events"][0]
    for level, keys in KEYS.items():
        assert set(levels[level]) == keys | MORE_KEYS.get(level, set())
    assert [vehicle["sysid"] for vehicle in values["vehicles"]] == list(range(1, 10))
    assert vehicle["fitness"] == pytest.approx(sum(vehicle["fitness_terms"].values()))


def test_a_flight_as_planned_arrives_as_planned(measured: Callable[..., Metrics], truths: Truths) -> None:
    metrics = measured(truths)
    for vehicle in metrics.vehicles:
        assert vehicle.completed
        assert vehicle.arrival_s == pytest.approx(vehicle.planned_arrival_s, abs=1e-4)
        assert vehicle.flown_length_km == pytest.approx(vehicle.straight_line_km, abs=1e-4)
    assert metrics.vehicles[0].straight_line_km == pytest.approx(36.20, abs=0.005)
    assert metrics.formation.arrival_spread_s == pytest.approx(0.0, abs=1e-4)


def test_formation_figures_are_those_of_the_offset(measured: Callable[..., Metrics], truths: Truths) -> None:
    formation = measured(truths).formation
    assert formation.max_error_m == pytest.approx(6.0)
    assert formation.rms_error_m == pytest.approx(6.0 * math.sqrt(2 / 9), rel=1e-4)
    # F3 and F5 arrive 500 m from each other; on straight lines some fly through radars and into walls.
    assert formation.min_separation_m == pytest.approx(500.0, abs=1.0)
    assert formation.min_wall_m == 0.0
    assert formation.radar_exposure_s > 0.0


def test_everything_of_the_flight_can_be_recomputed_from_files(
    tmp_path: Path,
    radars: Scenario,
    plan: FormationPlan,
    truths: Truths,
    measured: Callable[..., Metrics],
    make_record: Callable[..., FlightRecord],
) -> None:
    plan.save(tmp_path / "plan.json")
    for sysid, truth in truths.items():
        (tmp_path / f"{sysid}.f64").write_bytes(truth.astype("<f8").tobytes())
    again_plan, again_truths = load_plan(tmp_path / "plan.json"), read_truths(tmp_path, truths)
    graph = edges("ring", list(again_truths))
    again, _ = measure(radars, again_plan, again_truths, graph, make_record(again_plan))
    assert again == measured(truths)


def test_hash_is_cut_at_the_last_arrival(measured: Callable[..., Metrics], truths: Truths) -> None:
    metrics = measured(truths)
    last_tick = math.ceil(max(vehicle.arrival_s or 0.0 for vehicle in metrics.vehicles) / 0.04)
    assert metrics.trajectory_sha256 == trajectory_sha256(truths, last_tick)
    shorter = {sysid: truth[: last_tick + 1 + sysid] for sysid, truth in truths.items()}
    assert measured(shorter).trajectory_sha256 == metrics.trajectory_sha256
    other = truths | {9: truths[9] + 1e-9}
    assert measured(other).trajectory_sha256 != metrics.trajectory_sha256


def test_a_lost_vehicle_takes_the_hash_with_it_and_leaves_the_others_figures(
    measured: Callable[..., Metrics], truths: Truths
) -> None:
    metrics = measured(truths | {5: truths[5][:10000]}, lost={5: 401.3})
    assert metrics.trajectory_sha256 is None
    assert [vehicle.completed for vehicle in metrics.vehicles] == [sysid != 5 for sysid in range(1, 10)]
    lost = metrics.vehicles[4]
    assert (lost.arrival_s, lost.lost_s) == (None, 401.3)
    assert lost.flown_length_km == pytest.approx(
        lost.straight_line_km * 10000 * 0.04 / lost.planned_arrival_s, rel=0.01
    )
    assert metrics.formation.arrival_spread_s == pytest.approx(0.0, abs=1e-4)
    assert metrics.formation.rms_error_m is not None
    json.dumps(metrics.as_json(), allow_nan=False)


def test_what_is_unknown_is_null(measured: Callable[..., Metrics], truths: Truths) -> None:
    without = {sysid: truth[:20] for sysid, truth in truths.items() if sysid != 5}
    values = measured(without, delay_margin_s=math.inf, items_verified={}).as_json()
    assert values["trajectory_sha256"] is None
    assert values["formation"]["delay_margin_s"] is None
    assert values["formation"]["arrival_spread_s"] is None
    assert values["formation"]["min_clearance_m"] is None
    assert values["vehicles"][4]["flown_length_km"] is None
    assert values["vehicles"][0]["items_verified"] is None
    json.dumps(values, allow_nan=False)
