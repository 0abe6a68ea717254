"""Whether it is well."""

from typing import Any

import pytest
from pymavlink.dialects.v20 import ardupilotmega as mavlink

from sitl.services.stream_messages.health import (
    battery_status,
    extended_sys_state,
    fence_status,
    sys_status,
    system_time,
)
from sitl.snapshot import Breach, LandedState

FENCE, READY = mavlink.MAV_SYS_STATUS_GEOFENCE, mavlink.MAV_SYS_STATUS_PREARM_CHECK


def bits(message: Any, sensor: int) -> tuple[bool, bool, bool]:
    """Present, enabled, in health."""
    return (
        bool(message.onboard_control_sensors_present & sensor),
        bool(message.onboard_control_sensors_enabled & sensor),
        bool(message.onboard_control_sensors_health & sensor),
    )


@pytest.mark.parametrize(
    ("fence_id", "changes", "expected"),
    [
        (0, {}, (False, False, True)),
        (5, {}, (True, False, True)),
        (5, {"fence_enabled": True}, (True, True, True)),
        (0, {"fence_enabled": True}, (True, True, True)),
        (5, {"fence_enabled": True, "breach_status": True}, (True, True, False)),
    ],
)
def test_the_fences_health_goes_with_a_breach_only(
    view: Any, fence_id: int, changes: dict[str, Any], expected: tuple[bool, ...]
) -> None:
    assert bits(sys_status(view(plan_ids=(77, fence_id, 0), **changes)), FENCE) == expected


def test_the_pre_arm_bit_is_whether_it_is_ready(view: Any) -> None:
    assert bits(sys_status(view()), READY) == (True, True, True)
    assert bits(sys_status(view(ready=False)), READY) == (True, True, False)
    assert bits(sys_status(view(ready=False)), mavlink.MAV_SYS_STATUS_SENSOR_GPS) == (True, True, True)


@pytest.mark.parametrize("landed", list(LandedState))
def test_the_landed_state_is_mavlinks(view: Any, landed: LandedState) -> None:
    name = landed.name.replace("TAKING_OFF", "TAKEOFF")
    state = extended_sys_state(view(landed=landed)).landed_state
    assert mavlink.enums["MAV_LANDED_STATE"][state].name == f"MAV_LANDED_STATE_{name}"


def test_a_breach_is_counted_and_dated(view: Any) -> None:
    breach = {"breach_status": True, "breach_count": 70_000, "breach_type": Breach.BOUNDARY, "breach_time_s": 12.5}
    message = fence_status(view(**breach))
    assert (message.breach_status, message.breach_count, message.breach_type) == (1, 0xFFFF, 3)
    assert message.breach_time == 12_500


def test_the_date_goes_with_simulated_time(view: Any) -> None:
    message = system_time(view())
    assert (message.time_unix_usec, message.time_boot_ms) == (1_700_000_012_520_000, 12_520)


def test_a_battery_that_is_not_modelled_is_unknown_in_both_messages(view: Any) -> None:
    battery, status = battery_status(view()), sys_status(view())
    assert battery.voltages == [0xFFFF] * 10
    assert status.voltage_battery == 0xFFFF
    assert battery.current_battery == status.current_battery == -1
    assert battery.battery_remaining == status.battery_remaining == -1
    assert battery.temperature == 0x7FFF
