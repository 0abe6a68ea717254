"""The ways to one vehicle: one in use, the others standing by; and whether somebody else claims its system id."""

import time

from gcs.channel import Channel
from gcs.links.link import Link
from gcs.second_vehicle import SecondVehicle
from sitl.services.peer import Message

SILENCE_S = 5.0
"""A vehicle may come back at another address of a link after it has been silent at the old one for so long."""
TAKEOVER_S = 2.5
"""Another link takes over when the one in use has been silent for so long: two heartbeats."""


class Routes:
    """The channels to one vehicle, at most one on each link.

    Args:
        channel: where it was heard first.

    Attributes:
        used: the channel in use.
        rival: another vehicle's with the same system id; None while none is known.
    """

    def __init__(self, channel: Channel) -> None:
        self.used = channel
        self.rival: Channel | None = None
        self._standby: dict[Link, tuple[Channel, SecondVehicle]] = {}

    @property
    def standby(self) -> list[Channel]:
        """The channels not in use."""
        return [channel for channel, _ in self._standby.values()]

    def offer(self, channel: Channel) -> bool:
        """Take note of a heartbeat over a channel that is not in use; whether it is from now on."""
        now_s = time.monotonic()
        known, second = self._standby.get(channel.link, (None, SecondVehicle()))
        if channel.link is self.used.link:
            known = self.used
        if (known not in (None, channel) and not known.is_silent(now_s, SILENCE_S)) or second.proven:
            self.rival = channel
            return False
        if channel.link is not self.used.link and not self.used.is_silent(now_s, TAKEOVER_S):
            self._standby[channel.link] = (channel, second)
            return False
        self._standby.pop(channel.link, None)
        if self.used.open and self.used.link is not channel.link:
            self._standby[self.used.link] = (self.used, SecondVehicle())
        self.used = channel
        return True

    def compare(self, channel: Channel, first: Message, second: Message, pace: float) -> None:
        """Compare the positions heard over the channel in use and over another one, as of SecondVehicle."""
        known, witness = self._standby.get(channel.link, (None, None))
        if known is channel and witness is not None:
            witness.compare(first, second, pace)

    def forget(self, channel: Channel) -> None:
        """Its connection is lost."""
        if channel in self.standby:
            del self._standby[channel.link]
