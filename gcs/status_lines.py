"""STATUSTEXT pieces put together to lines."""

from sitl.services.peer import Message

_PIECE_BYTES = 50


class StatusLines:
    """Feed it one vehicle's STATUSTEXT messages; a line of which pieces are lost is shown without them."""

    def __init__(self) -> None:
        self._id = 0
        self._pieces: list[str] = []

    def feed(self, message: Message) -> list[str]:
        """The lines that are complete with this message."""
        if message.id == 0:
            return [*self._unfinished(), message.text]
        lines = [] if message.id == self._id else self._unfinished()
        self._id = message.id
        self._pieces.append(message.text)
        return lines + self._unfinished() if len(message.text) < _PIECE_BYTES else lines

    def _unfinished(self) -> list[str]:
        line = "".join(self._pieces)
        self._id, self._pieces = 0, []
        return [line] if line else []
