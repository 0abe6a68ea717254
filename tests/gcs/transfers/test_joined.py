"""Both ends of the transfers over a link that loses, repeats and reorders messages of every kind."""

from dataclasses import replace
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from gcs.bench.lossy_link import LossyLink, seeded_fates
from gcs.transfers.errors import TransferError
from gcs.transfers.parameters import ParameterFetch, ParameterSet, ParameterValue
from gcs.transfers.plan_clear import PlanClear
from gcs.transfers.plan_download import PlanDownload
from gcs.transfers.plan_upload import PlanUpload, Uploaded
from missions.fence import Fence, FenceCircle, FencePolygon, fence_items, rally_items
from missions.mission import MissionItem
from missions.plan_type import HELD, PlanType
from sitl.services.request_window import RequestWindow

SYSID = 3
SLOWEST_S = 200.0
FENCES = [
    fence_items(Fence((FenceCircle(True, (n, n), 300.0), FencePolygon(False, ((n, 1), (2, n), (3, 3))))))
    for n in (10, 20)
]
RALLIES = [rally_items([(n, n, 80.0), (n, 5, 90.0)]) for n in (10, 20)]


def plans(make_mission: Any, plan_type: PlanType) -> list[tuple[MissionItem, ...]]:
    """Two plans of a type, which differ in each item."""
    if plan_type == PlanType.MISSION:
        long = make_mission(9).items
        return [long[:5], (long[0], *long[4:9])]
    return FENCES if plan_type == PlanType.FENCE else RALLIES


def upload_and_read_back(link: Any, plan_type: PlanType, items: tuple[MissionItem, ...]) -> Any:
    """As the station does it; what is read back, or the error."""
    outcome = link.run(PlanUpload(plan_type, items, *link.link()), SLOWEST_S)
    if isinstance(outcome, TransferError):
        return outcome
    return link.run(PlanDownload(plan_type, *link.link()), SLOWEST_S)


@pytest.mark.parametrize("seed", range(8))
def test_a_hundred_items_get_through_a_link_that_loses_a_quarter_each_way(
    make_vehicle: Any, make_mission: Any, seed: int
) -> None:
    link = LossyLink(make_vehicle(SYSID), seeded_fates(seed, 0.25))
    mission = make_mission(100).items
    assert upload_and_read_back(link, PlanType.MISSION, mission) == mission
    assert {"MISSION_ITEM_INT", "MISSION_REQUEST_INT"} <= link.kinds_lost


def test_an_endpoint_that_asks_in_strict_order_gets_all_as_well(
    make_vehicle: Any, make_mission: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    begin = RequestWindow.__init__

    def begin_strictly(window: RequestWindow, first: int, last: int, now: Any, **_: bool) -> None:
        begin(window, first, last, now, strict=True)

    monkeypatch.setattr(RequestWindow, "__init__", begin_strictly)
    link = LossyLink(make_vehicle(SYSID), seeded_fates(1, 0.25))
    mission = make_mission(60).items
    assert upload_and_read_back(link, PlanType.MISSION, mission) == mission


@settings(max_examples=50, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(
    st.sampled_from(HELD),
    st.integers(0, 10**6),
    st.sampled_from([0.0, 0.1, 0.3, 0.5]),
    st.sampled_from([0.0, 0.1, 0.4]),
)
def test_whatever_the_link_does_there_is_an_end_no_mixture_and_no_false_success(
    make_vehicle: Any,
    make_mission: Any,
    plan_type: PlanType,
    seed: int,
    loss: float,
    jitter_s: float,
) -> None:
    old, new = plans(make_mission, plan_type)
    vehicle = make_vehicle(SYSID)
    vehicle.load(plan_type, old)
    link = LossyLink(vehicle, seeded_fates(seed, loss, jitter_s=jitter_s))
    held = upload_and_read_back(link, plan_type, new)
    assert vehicle.items(plan_type) in (old, new)
    if not isinstance(held, TransferError):
        assert held in (old, new)
    if loss < 0.5 and jitter_s == 0.0:
        assert held == new


@pytest.mark.parametrize("plan_type", HELD)
def test_a_station_or_an_endpoint_that_dies_at_any_step_leaves_a_whole_plan(
    lossy_link: Any, make_vehicle: Any, make_mission: Any, plan_type: PlanType
) -> None:
    old, new = plans(make_mission, plan_type)
    for dies in ("station", "endpoint"):
        outcomes = set()
        for step in range(40):
            vehicle = make_vehicle(SYSID)
            vehicle.load(plan_type, old)
            link = lossy_link(vehicle)
            upload = PlanUpload(plan_type, new, *link.link())
            upload.start()
            link.go_on(upload, lambda: False, 0.01 * step)
            if dies == "endpoint":
                link.start_endpoint()
            assert vehicle.items(plan_type) in (old, new)
            outcomes.add(vehicle.items(plan_type))
            assert upload_and_read_back(link, plan_type, new) == new  # the second try starts clean
        assert outcomes == {old, new}


def test_when_the_last_acks_are_lost_reading_back_tells(
    lossy_link: Any, make_vehicle: Any, make_mission: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    vehicle = make_vehicle(SYSID)
    link = lossy_link(vehicle)
    put = link._put
    monkeypatch.setattr(link, "_put", lambda up, message: message.get_type() != "MISSION_ACK" and put(up, message))
    mission = make_mission(6).items
    assert link.run(PlanUpload(PlanType.MISSION, mission, *link.link())) == Uploaded(confirmed=False)
    assert link.run(PlanDownload(PlanType.MISSION, *link.link())) == mission


def test_a_vehicle_that_does_not_answer_is_given_up_by_name(
    lossy_link: Any, make_vehicle: Any, make_mission: Any
) -> None:
    link = lossy_link(make_vehicle(SYSID), lambda: True)
    error = link.run(PlanUpload(PlanType.MISSION, make_mission(4).items, *link.link()), 30.0)
    assert str(error).startswith("vehicle 3: mission upload stopped at MISSION_COUNT 4: no answer")
    assert str(error).endswith("nothing heard in this transfer")


def test_a_refusal_names_item_and_code(lossy_link: Any, make_vehicle: Any, make_mission: Any) -> None:
    link = lossy_link(make_vehicle(SYSID))
    home, *rest = make_mission(5).items
    error = link.run(PlanUpload(PlanType.MISSION, (home, replace(rest[0], command=93), *rest[1:]), *link.link()))
    assert "mission upload refused at item" in str(error)
    assert "MAV_MISSION_UNSUPPORTED" in str(error)


def test_a_plan_is_cleared(make_vehicle: Any) -> None:
    vehicle = make_vehicle(SYSID)
    vehicle.load(PlanType.FENCE, FENCES[0])
    link = LossyLink(vehicle, seeded_fates(4, 0.25))
    assert link.run(PlanClear(PlanType.FENCE, *link.link())) in (True, False)
    assert link.run(PlanDownload(PlanType.FENCE, *link.link())) == ()


@pytest.mark.parametrize("loss", [0.0, 0.25])
def test_parameters_are_fetched_and_set(make_vehicle: Any, loss: float) -> None:
    vehicle = make_vehicle(SYSID)
    link = LossyLink(vehicle, seeded_fates(5, loss))
    fetched = link.run(ParameterFetch(*link.link()))
    assert {name: value.value for name, value in fetched.items()} == {
        name: vehicle.parameters[name] for name in vehicle.parameters.names
    }
    wanted = ParameterValue(35.5, fetched["WP_RADIUS"].kind)
    assert link.run(ParameterSet("wp_radius", wanted, *link.link())) == wanted
    assert vehicle.parameters["WP_RADIUS"] == 35.5


def test_a_parameter_that_stays_is_an_error_with_both_values(lossy_link: Any, make_vehicle: Any) -> None:
    link = lossy_link(make_vehicle(SYSID))
    error = link.run(ParameterSet("WP_RADIUS", ParameterValue(0.0, 9), *link.link()))
    assert str(error).startswith("vehicle 3: WP_RADIUS stays 90, wanted 0")
    error = link.run(ParameterSet("NONE", ParameterValue(0.0, 9), *link.link()))
    assert str(error).startswith("vehicle 3: has no parameter NONE")
