"""AVAILABLE_MODES and CURRENT_MODE of MAVLink's common messages, which pymavlink's ArduPilot dialect does not have yet.

They have of pymavlink's generated messages what packing and reading them takes.
"""

import struct

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from sitl.services.peer import Message


class AvailableModes(mavlink.MAVLink_message):  # type: ignore[misc]
    """AVAILABLE_MODES: one mode of `number_modes`, `mode_index` from 1."""

    id = 435
    msgname = "AVAILABLE_MODES"
    fieldnames = ("number_modes", "mode_index", "standard_mode", "custom_mode", "properties", "mode_name")
    ordered_fieldnames = ("custom_mode", "properties", "number_modes", "mode_index", "standard_mode", "mode_name")
    lengths = (1, 1, 1, 1, 1, 1)
    crc_extra = 134
    unpacker = struct.Struct("<IIBBB35s")

    def __init__(
        self,
        number_modes: int,
        mode_index: int,
        standard_mode: int,
        custom_mode: int,
        properties: int,
        mode_name: bytes,
    ) -> None:
        super().__init__(self.id, self.msgname)
        self._fieldnames = list(self.fieldnames)
        self.number_modes = number_modes
        self.mode_index = mode_index
        self.standard_mode = standard_mode
        self.custom_mode = custom_mode
        self.properties = properties
        self.mode_name = mode_name.split(b"\0", 1)[0].decode("ascii", "replace")

    def pack(self, mav: Message, force_mavlink1: bool = False) -> bytes:
        """The frame."""
        numbers = (self.custom_mode, self.properties, self.number_modes, self.mode_index, self.standard_mode)
        payload = self.unpacker.pack(*numbers, self.mode_name.encode("ascii", "replace"))
        return bytes(self._pack(mav, self.crc_extra, payload, force_mavlink1))


class CurrentMode(mavlink.MAVLink_message):  # type: ignore[misc]
    """CURRENT_MODE."""

    id = 436
    msgname = "CURRENT_MODE"
    fieldnames = ("standard_mode", "custom_mode", "intended_custom_mode")
    ordered_fieldnames = ("custom_mode", "intended_custom_mode", "standard_mode")
    lengths = (1, 1, 1)
    crc_extra = 193
    unpacker = struct.Struct("<IIB")

    def __init__(self, standard_mode: int, custom_mode: int, intended_custom_mode: int) -> None:
        super().__init__(self.id, self.msgname)
        self._fieldnames = list(self.fieldnames)
        self.standard_mode = standard_mode
        self.custom_mode = custom_mode
        self.intended_custom_mode = intended_custom_mode

    def pack(self, mav: Message, force_mavlink1: bool = False) -> bytes:
        """The frame."""
        payload = self.unpacker.pack(self.custom_mode, self.intended_custom_mode, self.standard_mode)
        return bytes(self._pack(mav, self.crc_extra, payload, force_mavlink1))


MODE_MESSAGES = {AvailableModes.id: AvailableModes, CurrentMode.id: CurrentMode}
"""By their ids."""
