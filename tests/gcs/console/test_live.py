"""Vehicles that fly, shown from what they tell."""

import contextlib
import math
from collections.abc import Callable, Iterator, Mapping
from typing import Any, TypeAlias

import numpy as np
import pytest
from pymavlink.dialects.v20 import ardupilotmega as mavlink

from gcs.console.live import Live
from gcs.vehicle_link import SILENCE_S, VehicleLink
from missions.frame import LocalFrame
from missions.reference import Reference
from missions.scenario import Scenario
from planner.formation_plan import FormationPlan
from sitl.modes import Mode
from sitl.services.peer import Peer

FRAME_S = 1.0 / 30.0
EDGES = ((1, 2), (1, 3), (2, 3))
Watch: TypeAlias = Callable[..., Live]


class FakeFleet:
    """Vehicles that say what a test lets them say."""

    def __init__(self, frame: LocalFrame, *sysids: int) -> None:
        self.frame = frame
        self.vehicles = {i: VehicleLink(i, 1, Peer("udp", "127.0.0.1", i), lambda message: b"") for i in sysids}

    def hear(self, sysid: int, message: Any) -> None:
        message.pack(mavlink.MAVLink(None, srcSystem=sysid, srcComponent=1))
        message.time_boot_ms_or = lambda default: getattr(message, "time_boot_ms", default)
        self.vehicles[sysid].on_message(message)

    def fly(self, sysid: int, t_s: float, position_m: Any, velocity_m_s: Any = (0.0, 0.0, 0.0)) -> None:
        (x, y, z), (u, v, w) = position_m, velocity_m_s
        lat_e7, lon_e7 = self.frame.to_e7(x, y)
        alt_mm = round((z + self.frame.alt_m) * 1000)
        velocity = (round(v * 100), round(u * 100), round(-w * 100))
        self.hear(
            sysid,
            mavlink.MAVLink_global_position_int_message(
                round(t_s * 1000), lat_e7, lon_e7, alt_mm, alt_mm, *velocity, 65535
            ),
        )


@pytest.fixture
def fleet(short: Scenario) -> FakeFleet:
    return FakeFleet(short.frame, 1, 2, 3)


@pytest.fixture
def watch(fleet: FakeFleet, short: Scenario) -> Iterator[Watch]:
    """Sources that are fed by the fleet."""
    with contextlib.ExitStack() as stack:

        def begin(references: Mapping[int, Reference] | None = None, **changes: Any) -> Live:
            names = {1: "left", 2: "middle", 3: "right"}
            options = {"simulated": True, "stack": stack} | changes
            live = Live(fleet, short.frame, names, references or {}, EDGES, **options)  # type: ignore[arg-type]
            live.advance(0.0)
            return live

        yield begin


def fly_the_plan(
    fleet: FakeFleet, live: Live, references: Mapping[int, Reference], until_s: float, ahead_m: float = 0.0
) -> None:
    """All fly on their references; the third is ahead of its own by so much, in x."""
    for frame in range(int(until_s / FRAME_S)):
        t_s = frame * FRAME_S
        if frame % 6 == 0:
            for sysid, reference in references.items():
                before, there = reference.positions(np.array([t_s, t_s + 0.01]))
                place = there + np.array([ahead_m if sysid == 3 else 0.0, 0.0, 0.0])
                fleet.fly(sysid, t_s, place, (there - before) / 0.01)
        live.advance(FRAME_S)


def test_they_are_where_they_have_said_and_move_between(fleet: FakeFleet, watch: Watch) -> None:
    live = watch()
    seen = []
    for frame in range(150):
        if frame % 6 == 0:
            for sysid in (1, 2, 3):
                fleet.fly(sysid, frame * FRAME_S, (20.0 * frame * FRAME_S, 100.0 * sysid, 50.0), (20.0, 0.0, 0.0))
        seen.append(live.advance(FRAME_S))
    last = seen[-1]
    assert last.sysids == (1, 2, 3)
    assert last.position_m[:, 0] == pytest.approx([20.0 * last.t_s] * 3, abs=0.1)
    assert last.position_m[:, 1] == pytest.approx([100.0, 200.0, 300.0], abs=0.1)
    steps = np.diff([moment.position_m[0, 0] for moment in seen[90:]])
    assert steps.min() > 0.0
    assert steps.mean() == pytest.approx(20.0 * FRAME_S, rel=0.1)


def test_who_has_not_said_where_it_is_is_not_shown_but_has_a_row(fleet: FakeFleet, watch: Watch) -> None:
    live = watch()
    fleet.fly(2, 1.0, (0.0, 0.0, 0.0))
    assert live.advance(FRAME_S).sysids == (2,)
    assert [(row.sysid, row.name) for row in live.rows()] == [(1, "left"), (2, "middle"), (3, "right")]


def test_vehicles_may_become_more(fleet: FakeFleet, watch: Watch) -> None:
    live = watch()
    fleet.vehicles[9] = VehicleLink(9, 1, Peer("udp", "127.0.0.1", 9), lambda message: b"")
    live.advance(FRAME_S)
    fleet.fly(9, 1.0, (0.0, 0.0, 0.0))
    assert live.advance(FRAME_S).sysids == (9,)
    assert live.names == {1: "left", 2: "middle", 3: "right", 9: ""}


def test_it_goes_on_when_one_falls_silent_and_waits_for_who_is_only_slow(fleet: FakeFleet, watch: Watch) -> None:
    live = watch()
    for sysid in (1, 2, 3):
        fleet.fly(sysid, 10.0, (0.0, 0.0, 0.0))
    for sysid in (1, 2):
        fleet.fly(sysid, 99.0, (0.0, 0.0, 0.0))
        fleet.fly(sysid, 100.0, (0.0, 0.0, 0.0))
    assert live.advance(1.0).t_s <= 10.0
    fleet.vehicles[3].heard_at_s -= 2.0 * SILENCE_S
    assert live.advance(1.0).t_s > 90.0


def test_a_row_says_what_the_vehicle_says(fleet: FakeFleet, watch: Watch) -> None:
    live = watch()
    fleet.hear(1, mavlink.MAVLink_heartbeat_message(1, 3, 209, Mode.RTL, 4, 3))
    fleet.hear(1, mavlink.MAVLink_vfr_hud_message(21.5, 22.0, 90, 55, 1480.0, 0.5))
    fleet.hear(1, mavlink.MAVLink_mission_current_message(4, 9))
    fleet.hear(1, mavlink.MAVLink_nav_controller_output_message(0, 0, 0, 0, 100, 0, 0, -3.0))
    row = live.rows()[0]
    assert (row.mode, row.item, row.speed_m_s, row.altitude_m, row.error_m) == ("RTL", (4, 9), 21.5, 1480.0, -3.0)
    fleet.hear(1, mavlink.MAVLink_named_value_float_message(1000, b"FormErr", 1.5))
    assert live.rows()[0].error_m == 1.5, "where there is a formation, its error"
    fleet.hear(1, mavlink.MAVLink_mission_current_message(0, 0xFFFF))
    assert live.rows()[0].item == (0, None)


def test_who_is_silent_and_who_is_lost_stand_out(fleet: FakeFleet, watch: Watch) -> None:
    live = watch()
    live.lost = {2: "its process has ended"}
    fleet.vehicles[3].heard_at_s -= 2.0 * SILENCE_S
    well, lost, silent = live.rows()
    assert well.well
    assert (lost.mode, lost.link, lost.well) == ("lost", "", False)
    assert (silent.link, silent.well) == ("silent 6 s", False)


def test_a_link_is_as_old_as_the_older_of_its_directions(fleet: FakeFleet, watch: Watch) -> None:
    live = watch()
    live.ages_s = {(1, 2): 0.2, (2, 1): 0.4, (1, 3): 0.2, (3, 1): None}
    assert [(link.pair, link.age_s) for link in live.links()] == [((1, 2), 0.4), ((1, 3), None)]
    live.lost = {2: "gone"}
    assert [link.pair for link in live.links()] == [(1, 3)]
    assert [row.link for row in live.rows()] == ["0.40 s", "", "0.20 s"]


def test_where_the_swarm_does_not_tell_a_link_is_as_old_as_what_was_heard_last(fleet: FakeFleet, watch: Watch) -> None:
    live = watch(simulated=False)
    fleet.vehicles[2].heard_at_s -= 30.0
    ages = {link.pair: link.age_s for link in live.links()}
    assert set(ages) == set(EDGES)
    assert ages[1, 3] == pytest.approx(0.0, abs=20.0)
    assert all(age_s is not None and age_s >= 30.0 for age_s in (ages[1, 2], ages[2, 3]))


def test_the_formation_error_is_that_of_who_is_off_his_plan(
    fleet: FakeFleet, watch: Watch, short: Scenario, short_plan: FormationPlan
) -> None:
    references = short_plan.references(short)
    live = watch(references)
    fly_the_plan(fleet, live, references, 20.0)
    assert live.course().error_m[-1] == pytest.approx(0.0, abs=0.5)
    moment = live.advance(0.0)
    apart = [math.dist(moment.position_m[i], moment.position_m[j]) for i, j in ((0, 1), (0, 2), (1, 2))]
    assert live.course().separation_m[-1] == pytest.approx(min(apart))


def test_a_vehicle_ahead_of_its_plan_disturbs_two_edges_of_three(
    fleet: FakeFleet, watch: Watch, short: Scenario, short_plan: FormationPlan
) -> None:
    references = short_plan.references(short)
    live = watch(references)
    fly_the_plan(fleet, live, references, 20.0, ahead_m=30.0)
    assert live.course().error_m[-1] == pytest.approx(30.0 * math.sqrt(2.0 / 3.0), abs=0.5)


def test_who_goes_by_the_swarms_clock_is_measured_by_it(
    fleet: FakeFleet, watch: Watch, short: Scenario, short_plan: FormationPlan
) -> None:
    references = short_plan.references(short)
    live = watch(references)
    for sysid, reference in references.items():
        fleet.fly(sysid, 30.0, reference.positions(np.array([25.0]))[0])
        fleet.hear(sysid, mavlink.MAVLink_named_value_float_message(30_000, b"FormShift", -5.0))
    live.advance(10.0)
    assert live.course().error_m[-1] == pytest.approx(0.0, abs=0.5)


def test_a_curve_has_a_point_a_moment_and_none_while_the_clock_stands(fleet: FakeFleet, watch: Watch) -> None:
    live = watch()
    for t_s in (1.0, 2.0, 2.0, 3.0):
        for sysid in (1, 2):
            fleet.fly(sysid, t_s, (0.0, 50.0 * sysid, 0.0))
        live.advance(2.0)
        course = live.course()
    assert (np.diff(course.t_s) > 0.0).all()
    assert course.now == len(course.t_s)
    assert np.isnan(course.error_m).all(), "nobody knows a plan"
    assert course.separation_m[-1] == pytest.approx(50.0, abs=0.1)


def test_it_says_how_fast_it_goes(fleet: FakeFleet, watch: Watch) -> None:
    live = watch()
    for frame in range(120):
        fleet.fly(1, 4.0 * frame * FRAME_S, (0.0, 0.0, 0.0))
        live.advance(FRAME_S)
    assert live.state() == "live, 4.0 x"
    for _ in range(120):
        live.advance(FRAME_S)
    live.doing = "flying"
    assert live.state() == "flying, held"
