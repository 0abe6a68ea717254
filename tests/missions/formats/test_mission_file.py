"""What is true of mission files of any kind."""

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from missions.errors import InputError
from missions.formats.mission_file import home_at, read_mission_file
from missions.formats.qgc_plan import write_plan
from missions.formats.waypoints import write_waypoints
from missions.mission import Mission, MissionItem
from missions.vehicle_plan import Plan

ALTITUDE = st.floats(-500, 80_000, width=32)
PARAM = st.floats(width=32, allow_infinity=False)
LATITUDE, LONGITUDE = st.integers(-(9 * 10**8), 9 * 10**8), st.integers(-(18 * 10**8), 18 * 10**8)
ITEMS = st.builds(
    MissionItem,
    *(st.integers(0, 65535), st.integers(0, 21)),
    *(PARAM, PARAM, PARAM, PARAM),
    *(LATITUDE, LONGITUDE, ALTITUDE, st.booleans()),
)
HOMES = st.builds(
    lambda lat, lon, alt: MissionItem(16, lat_e7=lat, lon_e7=lon, alt_m=alt), LATITUDE, LONGITUDE, ALTITUDE
)
MISSIONS = st.builds(lambda home, items: Mission((home, *items)), HOMES, st.lists(ITEMS, max_size=12))


@given(MISSIONS)
def test_what_is_read_is_written_and_read_again_without_loss_in_both_formats(
    tmp_path_factory: pytest.TempPathFactory, mission: Mission
) -> None:
    folder = tmp_path_factory.mktemp("files")
    write_plan(Plan(mission), folder / "any.plan", cruise_speed_m_s=25.0)
    once = read_mission_file(folder / "any.plan").plan.mission
    assert once == mission
    write_waypoints(once, folder / "any.waypoints")
    assert read_mission_file(folder / "any.waypoints").plan.mission == mission


@pytest.mark.parametrize("text", ["47.4,8.5", "47.4,8.5,high", "95,8.5,450", "47.4,181,450", "47.4,8.5,nan"])
def test_a_home_that_is_no_place_is_refused(text: str) -> None:
    with pytest.raises(InputError, match=f"--home {text}: "):
        home_at(text)


def test_what_a_file_is_called_does_not_matter(tmp_path: Path) -> None:
    mission = Mission((home_at("47.4,8.5,450"), MissionItem(16, 3, lat_e7=475_000_000, lon_e7=85_000_000, alt_m=90.0)))
    write_waypoints(mission, tmp_path / "misnamed.plan")
    assert read_mission_file(tmp_path / "misnamed.plan").plan.mission == mission
