"""How an upload ended, for a station that may not have heard it: its MISSION_ACK may have been lost."""

import math
from dataclasses import dataclass, field

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from sitl.services.peer import Message, Station

ASKS_AGAIN_S = (0.7, 1.1, 1.5)
"""When the item that decided an upload is asked for once more, after its MISSION_ACK, of a station that says nothing.

MAVSDK and QGroundControl wait for a MISSION_ACK and do nothing for it, the one for 2.5 s, the other for 1.5 s; both
give an item again that they are asked for, and are told again. To repeat the MISSION_ACK itself would be no help:
MAVSDK takes any for one of the transfer that it has begun since. It repeats the beginning of that after 0.5 s, so it
has been heard by 0.7 s; and of one upload it bears to be asked for an item four times.
"""


@dataclass
class EndedUpload:
    """An upload that is over.

    Attributes:
        station: who uploaded.
        seq: the item that decided it.
        last: the last item of the upload.
        result: the MAV_MISSION_RESULT.
        on_the_way: items asked for that had not come; their first arrival says nothing of what the station knows.
        question: what asks for the item that decided it; None where the station is not asked.
        at_s: when that was.
    """

    station: Station
    seq: int
    last: int
    result: int
    on_the_way: set[int] = field(default_factory=set)
    question: Message = None
    at_s: float = 0.0
    _asked: int = 0

    @property
    def deadline_s(self) -> float:
        """When the station is to be asked again; infinite when it is not."""
        if self.question is None or self._asked == len(ASKS_AGAIN_S):
            return math.inf
        return self.at_s + ASKS_AGAIN_S[self._asked]

    def ask_again(self) -> Message:
        """The question, when it is time."""
        self._asked += 1
        return self.question

    def rest(self) -> None:
        """The station has gone on to something else."""
        self.question = None

    def answers(self, seq: int) -> bool:
        """Whether an item that comes now is to be answered with the result."""
        if seq in self.on_the_way:
            self.on_the_way.remove(seq)
            return False
        return seq == self.seq or self.result != mavlink.MAV_MISSION_ACCEPTED
