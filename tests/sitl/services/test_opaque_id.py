"""What is true of the opaque plan id."""

from typing import Any

from missions.fence import Fence, FenceCircle, fence_items
from missions.mission import Mission
from missions.plan_type import PlanType
from sitl.services.codec import Codec
from sitl.services.opaque_id import (
    MissionAck,
    MissionCount,
    MissionCurrent,
    opaque_id,
    received_opaque_id,
    received_opaque_ids,
)

MISSION, FENCE = PlanType.MISSION, PlanType.FENCE


def over_the_wire(message: Any) -> Any:
    return Codec(255, 190).feed(Codec(1, 1).pack(message))[0]


def test_it_crosses_the_wire_beside_the_fields_that_every_reader_knows() -> None:
    ack = over_the_wire(MissionAck(255, 190, 0, 0, 0xDEADBEEF))
    assert (ack.get_type(), ack.target_system, ack.type, received_opaque_id(ack)) == ("MISSION_ACK", 255, 0, 0xDEADBEEF)
    count = over_the_wire(MissionCount(255, 190, 12, 0, 0x01020304))
    assert (count.count, count.target_component, received_opaque_id(count)) == (12, 190, 0x01020304)
    current = over_the_wire(MissionCurrent(3, 11, 3, 0, (0x80000001, 2, 3)))
    assert (current.seq, current.total, current.mission_state) == (3, 11, 3)
    assert received_opaque_ids(current) == (0x80000001, 2, 3)


def test_none_is_zero_on_the_wire() -> None:
    assert received_opaque_id(over_the_wire(MissionAck(255, 190, 0, 0, 0))) == 0


def test_it_tells_missions_apart_and_not_their_homes(make_mission: Any) -> None:
    mission = make_mission(8)
    plan_id = opaque_id(MISSION, mission)
    assert plan_id == opaque_id(MISSION, Mission(mission.items)) != 0
    assert plan_id != opaque_id(MISSION, make_mission(9))
    assert plan_id == opaque_id(MISSION, mission.with_home(mission[1]))
    assert opaque_id(MISSION, make_mission(1)) == 0


def test_of_other_plans_all_items_count() -> None:
    fence = fence_items(Fence((FenceCircle(True, (1, 2), 100.0), FenceCircle(False, (3, 4), 50.0))))
    assert len({opaque_id(FENCE, fence), opaque_id(FENCE, fence[1:]), opaque_id(FENCE, fence[:1]), 0}) == 4
    assert opaque_id(FENCE, ()) == 0
