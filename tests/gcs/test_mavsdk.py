"""MAVSDK as a foreign station of an endpoint's face, over TCP."""

from collections.abc import Iterator
from typing import Any

import mavsdk
import pytest
from mavsdk.plugins.mission_raw import mission_raw

from missions.commands import Frame
from missions.mission import MissionItem

PATIENCE_S = 20.0


@pytest.fixture
def vehicle(make_vehicle: Any, make_mission: Any) -> Any:
    vehicle = make_vehicle(6)
    vehicle.mission = make_mission(25)
    return vehicle


@pytest.fixture
def client(vehicle: Any, serve: Any) -> Iterator[Any]:
    """MAVSDK's raw missions of the vehicle."""
    links = serve(vehicle)
    station = mavsdk.Configuration.create_with_component_type(mavsdk.ComponentType.GROUND_STATION)
    with mavsdk.Mavsdk(station) as sdk:
        result = sdk.add_any_connection(f"tcpout://127.0.0.1:{links.tcp_port}")
        assert result == mavsdk.ConnectionResult.SUCCESS
        system = sdk.first_autopilot(PATIENCE_S)
        assert system is not None
        assert system.get_system_id() == 6
        yield mission_raw.MissionRaw(system)


def as_item(item: Any) -> MissionItem:
    return MissionItem(
        item.command,
        item.frame,
        item.param1,
        item.param2,
        item.param3,
        item.param4,
        item.x,
        item.y,
        item.z,
        bool(item.autocontinue),
    )


def as_mavsdks(item: MissionItem, seq: int) -> Any:
    return mission_raw.MissionItem(
        seq, item.frame, item.command, int(seq == 0), 1, *item.params, item.lat_e7, item.lon_e7, item.alt_m, 0
    )


def test_it_downloads_the_mission_held(client: Any, vehicle: Any) -> None:
    assert tuple(map(as_item, client.download_mission())) == vehicle.mission.items


def test_it_uploads_a_mission_and_clears_it(client: Any, vehicle: Any, make_mission: Any) -> None:
    mission = make_mission(40)
    client.upload_mission([as_mavsdks(item, seq) for seq, item in enumerate(mission)])
    assert vehicle.mission == mission
    client.clear_mission()
    assert vehicle.mission == make_mission(1)


def test_a_refused_upload_is_an_error_there_too(client: Any, vehicle: Any, make_mission: Any) -> None:
    old, new = vehicle.mission, make_mission(3)
    fence = MissionItem(5001, Frame.GLOBAL, lat_e7=new[1].lat_e7, lon_e7=new[1].lon_e7)
    with pytest.raises(mission_raw.MissionRawError):
        client.upload_mission([as_mavsdks(item, seq) for seq, item in enumerate((*new.items, fence))])
    assert vehicle.mission == old
