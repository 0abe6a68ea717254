"""What is true of every stream."""

from typing import Any

from sitl.services.codec import Codec
from sitl.services.stream_messages.streams import STREAMS


def test_every_message_can_be_encoded_and_read(view: Any) -> None:
    codec, reader = Codec(1, 1), Codec(255, 190)
    far = view(
        ground_velocity_m_s=(900.0, 0.0, -400.0),
        thrust_fraction=1.7,
        distance_to_waypoint_m=-3.0,
        time_s=5e6,
        breach_count=10**6,
        along_track_m=1e30,
    )
    for message_id, stream in STREAMS.items():
        for message in stream.messages(far):
            assert [read.get_msgId() for read in reader.feed(codec.pack(message))] == [message_id]


def test_formation_is_two_values_that_any_station_can_plot(view: Any) -> None:
    messages = STREAMS[251].messages(view(along_track_m=-4.5, formation_delay_s=0.2))
    read = Codec(255, 190).feed(b"".join(Codec(1, 1).pack(message) for message in messages))
    assert [(value.name, round(value.value, 3), value.time_boot_ms) for value in read] == [
        ("FormErr", -4.5, 12520),
        ("FormDelay", 0.2, 12520),
    ]


def test_a_vehicle_that_goes_by_a_swarms_clock_tells_what_that_shows(view: Any) -> None:
    names = [message.name for message in STREAMS[251].messages(view(schedule_shift_s=-2.5))]
    assert names == ["FormErr", "FormDelay", "FormShift"]
