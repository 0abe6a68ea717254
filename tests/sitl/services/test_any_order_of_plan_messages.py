"""Whatever two stations say in whatever order, a vehicle holds whole plans only, and every upload comes to an end."""

import math
from dataclasses import replace
from typing import Any

from hypothesis import settings
from hypothesis import strategies as st
from hypothesis.stateful import (
    RuleBasedStateMachine,
    initialize,
    invariant,
    precondition,
    rule,
    run_state_machine_as_test,
)
from pymavlink.dialects.v20 import ardupilotmega as mavlink

from missions.commands import Command, Frame
from missions.fence import rally_items
from missions.mission import MissionItem
from missions.plan_type import PlanType
from sitl.events import StatusText
from sitl.modes import Mode
from sitl.services.mission_items import item_message
from sitl.services.mission_server import MissionServer
from sitl.services.peer import Peer
from sitl.services.plan_upload import GIVE_UP_S
from sitl.services.request_window import MAX_OUTSTANDING

SYSID = 3
PEERS = [Peer("udp", "127.0.0.1", port) for port in (14550, 14551)]
MISSION, FENCE, RALLY = PlanType.MISSION, PlanType.FENCE, PlanType.RALLY

counts = st.sampled_from([1, 2, 5, 12, 40])
plans = st.sampled_from([MISSION, MISSION, FENCE, RALLY])
peers = st.sampled_from(PEERS)


def make_items(plan: PlanType, count: int, mark: int) -> tuple[MissionItem, ...]:
    """A plan whose every item tells which one it is of."""
    if plan == RALLY:
        return rally_items((mark, seq, 100.0) for seq in range(count))
    command = Command.NAV_WAYPOINT if plan == MISSION else Command.NAV_FENCE_CIRCLE_INCLUSION
    return tuple(MissionItem(command, Frame.GLOBAL, 5.0, lat_e7=mark, lon_e7=seq) for seq in range(count))


class PlanMessages(RuleBasedStateMachine):
    """Two stations, each with the plans it has last counted; what they are asked for is answered, or not, or late."""

    make_vehicle: Any

    @initialize()
    def begin(self) -> None:
        self.time_s = 0.0
        self.vehicle = self.make_vehicle(SYSID)
        self.mark = 1
        self.counted: dict[tuple[Peer, PlanType], tuple[MissionItem, ...]] = {}
        self.asked: list[tuple[Peer, PlanType, int]] = []
        self.replies: list[Any] = []
        self.texts: list[StatusText] = []
        self.whole = {plan: {self.vehicle.items(plan)} for plan in (MISSION, FENCE, RALLY)}
        self.server = MissionServer(self.vehicle, self.hear, self.texts.append, lambda: self.time_s)

    def hear(self, message: Any, peer: Peer) -> None:
        self.replies.append(message)
        if message.get_type() in ("MISSION_REQUEST", "MISSION_REQUEST_INT"):
            plan = PlanType(message.mission_type)
            assert message.seq < len(self.counted[peer, plan])
            self.asked.append((peer, plan, message.seq))

    def announce(self, peer: Peer, plan: PlanType, items: tuple[MissionItem, ...]) -> None:
        """A plan that the vehicle may hold from now on."""
        self.whole[plan].add((self.vehicle.home, *items[1:]) if plan == MISSION else items)
        self.asked = [asked for asked in self.asked if asked[:2] != (peer, plan)]
        self.counted[peer, plan] = items

    def tell(self, peer: Peer, message: Any) -> None:
        message._header = mavlink.MAVLink_header(message.get_msgId(), srcSystem=255, srcComponent=190)
        self.server.on_message(message, peer)

    @rule(peer=peers, plan=plans, count=counts)
    def count(self, peer: Peer, plan: PlanType, count: int) -> None:
        self.mark += 1
        self.announce(peer, plan, make_items(plan, count, self.mark))
        self.tell(peer, mavlink.MAVLink_mission_count_message(SYSID, 1, count, plan))

    @rule(peer=peers, plan=plans, first=st.integers(0, 12), length=st.integers(1, 8))
    def replace_stretch(self, peer: Peer, plan: PlanType, first: int, length: int) -> None:
        held, last = self.vehicle.items(plan), first + length - 1
        if last < len(held):
            self.mark += 1
            new = make_items(plan, len(held), self.mark)
            items = held[:first] + new[first : last + 1] + held[last + 1 :]
            self.announce(peer, plan, items)
            self.tell(peer, mavlink.MAVLink_mission_write_partial_list_message(SYSID, 1, first, last, plan))

    @precondition(lambda self: self.asked)
    @rule(which=st.integers(0, 99), lost=st.sampled_from([False, False, False, True]), again=st.booleans())
    def answer(self, which: int, lost: bool, again: bool) -> None:
        at = which % len(self.asked)
        peer, plan, seq = self.asked[at] if again else self.asked.pop(at)
        if not lost:
            self.tell(peer, item_message(self.counted[peer, plan][seq], seq, SYSID, 1, plan))

    @precondition(lambda self: self.asked)
    @rule()
    def answer_all(self) -> None:
        asked, self.asked = self.asked, []
        for peer, plan, seq in asked:
            self.tell(peer, item_message(self.counted[peer, plan][seq], seq, SYSID, 1, plan))

    @precondition(lambda self: self.asked)
    @rule(which=st.integers(0, 99), change=st.sampled_from([{"command": 84}, {"frame": 10}, {"param1": math.nan}]))
    def answer_badly(self, which: int, change: dict[str, Any]) -> None:
        peer, plan, seq = self.asked.pop(which % len(self.asked))
        item = replace(self.counted[peer, plan][seq], **change)
        if plan != RALLY or "param1" not in change:  # rally points have no use for it
            self.tell(peer, item_message(item, seq, SYSID, 1, plan))

    @rule(peer=peers, plan=plans, result=st.sampled_from([0, 1, 3, 13, 15]))
    def acknowledge(self, peer: Peer, plan: PlanType, result: int) -> None:
        self.tell(peer, mavlink.MAVLink_mission_ack_message(SYSID, 1, result, plan))

    @rule(peer=peers, plan=st.sampled_from([MISSION, FENCE, RALLY, PlanType.ALL]))
    def clear(self, peer: Peer, plan: PlanType) -> None:
        self.whole[FENCE].add(())
        self.whole[RALLY].add(())
        self.tell(peer, mavlink.MAVLink_mission_clear_all_message(SYSID, 1, plan))

    @rule(peer=peers, plan=plans)
    def list_plan(self, peer: Peer, plan: PlanType) -> None:
        self.tell(peer, mavlink.MAVLink_mission_request_list_message(SYSID, 1, plan))

    @rule(refusal=st.sampled_from([None, None, "the disk is full"]))
    def break_the_disk(self, refusal: str | None) -> None:
        self.vehicle.refusal = refusal

    @rule(flying=st.booleans())
    def fly(self, flying: bool) -> None:
        self.vehicle.change(airborne=flying, mode=Mode.AUTO if flying else Mode.MANUAL)

    @rule(seconds=st.sampled_from([0.05, 0.3, 2.0, 9.0]))
    def wait(self, seconds: float) -> None:
        self.time_s += seconds
        self.server.on_tick()

    @rule(peer=peers)
    def leave(self, peer: Peer) -> None:
        self.server.forget(peer)
        self.asked = [asked for asked in self.asked if asked[0] != peer]

    @invariant()
    def only_whole_plans_are_held(self) -> None:
        for plan, whole in self.whole.items():
            assert self.vehicle.items(plan) in whole

    @invariant()
    def no_more_is_asked_for_than_fits_the_window(self) -> None:
        for plan in (MISSION, FENCE, RALLY):
            upload = self.server._servers[plan]._upload
            assert upload is None or len(upload.window.outstanding) <= MAX_OUTSTANDING

    def teardown(self) -> None:
        """With nobody answering any more, every upload ends, with an answer that says so."""
        running = [plan for plan in (MISSION, FENCE, RALLY) if self.server._servers[plan].uploader is not None]
        self.replies.clear()
        end_s = self.time_s + GIVE_UP_S + 1.0
        while self.time_s < end_s:
            self.time_s += 0.1
            self.server.on_tick()
        ended = [reply.mission_type for reply in self.replies if reply.get_type() == "MISSION_ACK"]
        assert sorted(set(ended)) == running, "told at least once; more often where much is lost"
        assert self.server.deadline_s == float("inf")


def test_no_order_of_messages_leaves_a_mixed_plan_or_an_upload_without_end(make_vehicle: Any) -> None:
    class WithVehicles(PlanMessages):
        pass

    WithVehicles.make_vehicle = staticmethod(make_vehicle)
    run_state_machine_as_test(WithVehicles, settings=settings(max_examples=150, stateful_step_count=40, deadline=None))
