"""Commands that were sent more often than answered: their late COMMAND_ACKs must not pass for a later command's."""

_FORGET_S = 10.0
"""After so long an acknowledgement was lost rather than late."""


class Unanswered:
    """Counts, for each MAV_CMD, the acknowledgements that earlier commands still have to get.

    A COMMAND_ACK says which command it answers, not which sending of it. So a command that was sent twice and is done
    with the first answer leaves one that is on its way, and arming and disarming are one MAV_CMD.
    """

    def __init__(self) -> None:
        self._counts: dict[int, int] = {}
        self._sent_at_s: dict[int, float] = {}

    def sent(self, command: int, now_s: float) -> None:
        """The command has been sent, once more."""
        self._counts[command] = self.of(command, now_s) + 1
        self._sent_at_s[command] = now_s

    def answered(self, command: int) -> None:
        """One of its acknowledgements is in."""
        self._counts[command] = max(0, self._counts.get(command, 0) - 1)

    def of(self, command: int, now_s: float) -> int:
        """How many acknowledgements may still come."""
        recent = now_s - self._sent_at_s.get(command, now_s) < _FORGET_S
        return self._counts.get(command, 0) if recent else 0
