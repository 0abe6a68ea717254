"""MAVSDK as a foreign station of an endpoint's face, over TCP."""

import math
from typing import Any

import pytest

from gcs.bench.mavsdk_station import from_raw_items, peer_module, plugin, to_raw_items
from missions.commands import Command, Frame
from missions.fence import FenceCircle, FencePolygon, parse_fence, rally_items
from missions.mission import MissionItem
from missions.plan_type import PlanType
from sitl.modes import Mode


@pytest.fixture
def vehicle(make_vehicle: Any, make_mission: Any) -> Any:
    vehicle = make_vehicle(6)
    vehicle.mission = make_mission(25)
    return vehicle


@pytest.fixture
def system(vehicle: Any, serve: Any, mavsdk: Any) -> Any:
    """The vehicle, as MAVSDK knows it."""
    links = serve(vehicle)
    return mavsdk(f"tcpout://127.0.0.1:{links.tcp_port}").wait_for([6])[0]


@pytest.fixture
def missions(system: Any) -> Any:
    return plugin("mission_raw", system)


def test_it_downloads_the_mission_held(missions: Any, vehicle: Any) -> None:
    assert from_raw_items(missions.download_mission()) == vehicle.mission.items


def test_it_uploads_a_mission_and_clears_it(missions: Any, vehicle: Any, make_mission: Any) -> None:
    mission = make_mission(100)
    missions.upload_mission(to_raw_items(mission.items))
    assert vehicle.mission == mission
    missions.clear_mission()  # it uploads home alone, as ArduPilot wants it
    assert vehicle.mission == make_mission(1)


def test_a_refused_upload_is_an_error_there_too(missions: Any, vehicle: Any, make_mission: Any) -> None:
    old, new = vehicle.mission, make_mission(3)
    fence = MissionItem(Command.NAV_FENCE_CIRCLE_EXCLUSION, Frame.GLOBAL, 50.0, lat_e7=new[1].lat_e7)
    with pytest.raises(peer_module("mavsdk.plugins.mission_raw.mission_raw").MissionRawError):
        missions.upload_mission(to_raw_items((*new.items, fence)))
    assert vehicle.mission == old


def test_its_geofence_arrives_and_is_cleared(system: Any, missions: Any, vehicle: Any) -> None:
    fences = peer_module("mavsdk.plugins.geofence.geofence")
    area = [(46.4, 11.2), (46.4, 11.4), (46.6, 11.4), (46.6, 11.2)]
    polygon = fences.Polygon([fences.Point(*place) for place in area], fences.FenceType.INCLUSION)
    circle = fences.Circle(fences.Point(46.5, 11.3), 500.0, fences.FenceType.EXCLUSION)
    geofence = plugin("geofence", system)
    geofence.upload_geofence(fences.GeofenceData([polygon], [circle]))
    held = parse_fence(vehicle.items(PlanType.FENCE))
    assert held.areas == (
        FencePolygon(True, tuple((round(lat * 1e7), round(lon * 1e7)) for lat, lon in area)),
        FenceCircle(False, (465_000_000, 113_000_000), 500.0),
    )
    assert from_raw_items(missions.download_geofence()) == vehicle.items(PlanType.FENCE)
    geofence.clear_geofence()
    assert vehicle.items(PlanType.FENCE) == ()
    assert missions.download_geofence() == []


def test_its_rally_points_arrive(missions: Any, vehicle: Any) -> None:
    points = rally_items([(465_000_000 + 1000 * i, 113_000_000, 100.0 + i) for i in range(7)])
    missions.upload_rally_points(to_raw_items(points, PlanType.RALLY))
    assert vehicle.items(PlanType.RALLY) == points
    assert from_raw_items(missions.download_rallypoints()) == points


def test_it_lists_reads_and_sets_parameters(system: Any, vehicle: Any) -> None:
    parameters = plugin("param", system)
    listed = parameters.get_all_params()
    names = {parameter.name for parameter in (*listed.int_params, *listed.float_params)}
    assert names == set(vehicle.parameters.names)
    assert parameters.get_param_float("WP_RADIUS") == vehicle.parameters["WP_RADIUS"]
    parameters.set_param_float("WP_RADIUS", 75.0)
    assert vehicle.parameters["WP_RADIUS"] == 75.0
    assert parameters.get_param_float("WP_RADIUS") == 75.0


def test_it_arms_starts_the_mission_and_disarms(system: Any, missions: Any, vehicle: Any) -> None:
    action = plugin("action", system)
    action.arm()
    assert vehicle.state.armed
    missions.start_mission()
    assert vehicle.state.mode == Mode.AUTO
    action.disarm()
    assert not vehicle.state.armed


def test_its_modes_are_the_vehicles(system: Any, missions: Any, vehicle: Any) -> None:
    action = plugin("action", system)
    action.hold()
    assert vehicle.state.mode == Mode.LOITER
    action.return_to_launch()
    assert vehicle.state.mode == Mode.RTL


def test_its_goto_is_a_reposition(system: Any, vehicle: Any) -> None:
    plugin("action", system).goto_location(46.51, 11.31, 1400.0, math.nan)
    ((_, item),) = [asked for asked in vehicle.asked if asked[0] == "reposition"]
    assert (item.lat_e7, item.lon_e7, item.alt_m) == (465_100_000, 113_100_000, 1400.0)


def test_a_refused_command_is_an_error_with_the_vehicles_words(system: Any, vehicle: Any, make_mission: Any) -> None:
    vehicle.mission = make_mission(1)
    with pytest.raises(peer_module("mavsdk.plugins.action.action").ActionError):
        plugin("action", system).arm()
    assert not vehicle.state.armed


def test_it_sets_the_rate_of_the_battery_s_message(system: Any) -> None:
    plugin("telemetry", system).set_rate_battery(2.0)  # raises when the vehicle denies it
