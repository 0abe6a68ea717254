"""SETUP_SIGNING: a station gives the vehicle a key, a new one, or none."""

from collections.abc import Callable

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from missions.errors import InputError
from sitl.events import StatusText
from sitl.services.peer import Message
from sitl.services.signing import NO_KEY, Signing
from sitl.services.vehicle import Vehicle


class SigningServer:
    """Lets in what is properly signed, and changes the key on demand.

    Refuses a change while armed, as ArduPilot does; what is wrong is told by STATUSTEXT, for there is no answer.

    Args:
        vehicle: asked whether it is armed.
        signing: its key.
        report: called with the StatusText that explains a refusal.
    """

    def __init__(self, vehicle: Vehicle, signing: Signing, report: Callable[[StatusText], None]) -> None:
        self._vehicle = vehicle
        self._signing = signing
        self._report = report

    def on_message(self, message: Message) -> None:
        """Take SETUP_SIGNING, which is for this vehicle and has been judged good."""
        if message.get_type() != "SETUP_SIGNING" or message.target_system != self._vehicle.sysid:
            return
        if self._vehicle.snapshot().armed:
            self._refuse("armed")
            return
        key, timestamp = bytes(message.secret_key), message.initial_timestamp
        try:
            if key == NO_KEY and timestamp == 0:
                self._signing.set_key(None, 0)
            else:
                self._signing.set_key(key, timestamp)
        except InputError as error:
            self._refuse(str(error))

    def on_tick(self) -> None:
        """Tell what has gone wrong since."""
        if self._signing.trouble is not None:
            self._report(StatusText(mavlink.MAV_SEVERITY_WARNING, self._signing.trouble))
            self._signing.trouble = None

    def _refuse(self, reason: str) -> None:
        self._report(StatusText(mavlink.MAV_SEVERITY_WARNING, f"Signing not changed: {reason}"))
