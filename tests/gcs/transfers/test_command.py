"""What is true of one command, fed by hand."""

from typing import Any

import pytest
from pymavlink.dialects.v20 import ardupilotmega as mavlink

from gcs.transfers.acquaintance import Acquaintance
from gcs.transfers.command import Command, command_long
from gcs.transfers.errors import TransferError
from sitl.services.codec import Codec

ARM = mavlink.MAV_CMD_COMPONENT_ARM_DISARM


class Bench:
    """A command to arm, what it sends, and a clock."""

    def __init__(self) -> None:
        self.time_s = 0.0
        self.sent: list[tuple[int, int]] = []
        self.known = Acquaintance()
        self.command = Command(command_long(ARM, 1.0), 3, 1, self._send, lambda: self.time_s, self.known)
        self.command.start()

    def _send(self, message: Any) -> None:
        self.sent.append((message.command, message.confirmation))

    def answer(self, result: int, command: int = ARM, target: int = 255) -> None:
        ack = mavlink.MAVLink_command_ack_message(command, result, 0, 0, target, 190)
        self.command.on_message(Codec(255, 190).feed(Codec(3, 1).pack(ack))[0])

    def wait(self, seconds: float) -> None:
        end_s = self.time_s + seconds
        while self.time_s < end_s:
            self.time_s += 0.05
            self.command.on_tick()


@pytest.fixture
def bench() -> Bench:
    return Bench()


def test_the_answer_is_the_outcome(bench: Bench) -> None:
    bench.answer(mavlink.MAV_RESULT_ACCEPTED, command=mavlink.MAV_CMD_DO_SET_MODE)
    bench.answer(mavlink.MAV_RESULT_ACCEPTED, target=254)
    assert bench.command.outcome is None
    bench.answer(mavlink.MAV_RESULT_FAILED)
    assert bench.command.outcome == mavlink.MAV_RESULT_FAILED


def test_it_is_repeated_with_growing_confirmation_until_given_up(bench: Bench) -> None:
    bench.wait(60.0)
    assert bench.sent == [(ARM, tries) for tries in range(len(bench.sent))]
    assert len(bench.sent) > 5
    assert isinstance(bench.command.outcome, TransferError)
    assert "vehicle 3: no answer to MAV_CMD_COMPONENT_ARM_DISARM" in str(bench.command.outcome)


def test_in_progress_buys_time(bench: Bench) -> None:
    for _ in range(10):
        bench.wait(1.0)
        bench.answer(mavlink.MAV_RESULT_IN_PROGRESS)
    assert bench.command.outcome is None
    bench.answer(mavlink.MAV_RESULT_ACCEPTED)
    assert bench.command.outcome == mavlink.MAV_RESULT_ACCEPTED


def test_a_late_answer_to_an_earlier_command_is_not_taken_for_a_later_ones(bench: Bench) -> None:
    bench.wait(1.0)
    assert len(bench.sent) == 2
    bench.answer(mavlink.MAV_RESULT_ACCEPTED)
    disarm = Command(command_long(ARM, 0.0), 3, 1, bench._send, lambda: bench.time_s, bench.known)
    bench.command = disarm
    disarm.start()
    bench.answer(mavlink.MAV_RESULT_ACCEPTED)  # the other answer to arming
    assert disarm.outcome is None
    bench.answer(mavlink.MAV_RESULT_FAILED)
    assert disarm.outcome == mavlink.MAV_RESULT_FAILED


def test_a_command_rejected_for_now_is_tried_again(bench: Bench) -> None:
    bench.answer(mavlink.MAV_RESULT_TEMPORARILY_REJECTED)
    assert bench.command.outcome is None
    bench.wait(1.2)
    assert len(bench.sent) == 2
