"""Asking a vehicle to send a kind of message at a rate: MAV_CMD_SET_MESSAGE_INTERVAL."""

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from gcs.transfers.command import command_long, send_command
from gcs.vehicle_link import VehicleLink


async def set_message_interval(vehicle: VehicleLink, message_id: int, interval_s: float) -> bool:
    """Ask for a message every `interval_s` seconds of the vehicle's time; returns whether it will do so.

    Raises:
        TransferError: it does not answer.
    """
    order = command_long(mavlink.MAV_CMD_SET_MESSAGE_INTERVAL, float(message_id), round(interval_s * 1e6))
    return bool(await send_command(vehicle, order) == mavlink.MAV_RESULT_ACCEPTED)
