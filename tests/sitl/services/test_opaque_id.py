"""What is true of the opaque plan id."""

from typing import Any

from missions.mission import Mission
from sitl.services.codec import Codec
from sitl.services.opaque_id import MissionAck, MissionCount, MissionCurrent, opaque_id, received_opaque_id


def over_the_wire(message: Any) -> Any:
    return Codec(255, 190).feed(Codec(1, 1).pack(message))[0]


def test_it_crosses_the_wire_beside_the_fields_that_every_reader_knows() -> None:
    ack = over_the_wire(MissionAck(255, 190, 0, 0, 0xDEADBEEF))
    assert (ack.get_type(), ack.target_system, ack.type, received_opaque_id(ack)) == ("MISSION_ACK", 255, 0, 0xDEADBEEF)
    count = over_the_wire(MissionCount(255, 190, 12, 0, 0x01020304))
    assert (count.count, count.target_component, received_opaque_id(count)) == (12, 190, 0x01020304)
    current = over_the_wire(MissionCurrent(3, 11, 3, 0, 0x80000001))
    assert (current.seq, current.total, current.mission_state, received_opaque_id(current)) == (3, 11, 3, 0x80000001)


def test_none_is_zero_on_the_wire() -> None:
    assert received_opaque_id(over_the_wire(MissionAck(255, 190, 0, 0, 0))) == 0


def test_it_tells_missions_apart_and_not_their_homes(make_mission: Any) -> None:
    mission = make_mission(8)
    assert opaque_id(mission) == opaque_id(Mission(mission.items)) != 0
    assert opaque_id(mission) != opaque_id(make_mission(9))
    assert opaque_id(mission) == opaque_id(mission.with_home(mission[1]))
    assert opaque_id(make_mission(1)) == 0
