"""What is true of `.waypoints` files."""

import math
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from missions.errors import InputError
from missions.formats.waypoints import write_waypoints
from missions.formats.waypoints_reader import read_waypoints
from missions.mission import Mission, MissionItem, as_float32

FLOAT32 = st.floats(width=32, allow_infinity=False)
E7 = st.integers(-(2**31) + 1, 2**31 - 1)
ITEMS = st.builds(
    MissionItem,
    st.integers(0, 65535),
    st.integers(0, 21),
    FLOAT32,
    FLOAT32,
    FLOAT32,
    FLOAT32,
    E7,
    E7,
    FLOAT32,
    st.booleans(),
)
MISSIONS = st.lists(ITEMS, min_size=1, max_size=20).map(lambda items: Mission(tuple(items)))


@given(MISSIONS)
def test_what_is_written_reads_back_equal(tmp_path_factory: pytest.TempPathFactory, mission: Mission) -> None:
    path = tmp_path_factory.mktemp("waypoints") / "any.waypoints"
    write_waypoints(mission, path)
    assert read_waypoints(path) == mission


def test_pymavlinks_loader_reads_it(tmp_path: Path) -> None:
    mavwp = pytest.importorskip("pymavlink.mavwp")
    item = MissionItem(16, 3, 0.1, 50.0, math.nan, 1e-20, -335_000_001, 1_491_234_567, 612.3)
    path = tmp_path / "one.waypoints"
    write_waypoints(Mission((MissionItem(16, lat_e7=1, lon_e7=2, alt_m=3.0), item)), path)
    loader = mavwp.MAVWPLoader()
    assert loader.load(str(path)) == 2
    read = loader.wp(1)
    assert (read.command, read.frame, read.autocontinue) == (16, 3, 1)
    assert (round(read.x * 1e7), round(read.y * 1e7)) == (item.lat_e7, item.lon_e7)
    wire = [as_float32(value) for value in (read.param1, read.param2, read.param4, read.z)]
    assert wire == [item.param1, item.param2, item.param4, item.alt_m]
    assert math.isnan(read.param3)


def test_rows_have_twelve_tab_separated_columns_and_eight_decimals(tmp_path: Path) -> None:
    path = tmp_path / "home.waypoints"
    write_waypoints(Mission((MissionItem(16, lat_e7=465_000_001, lon_e7=-1, alt_m=1200.5),)), path)
    row = "0 1 0 16 0.00000000 0.00000000 0.00000000 0.00000000 46.50000010 -0.00000010 1200.50000000 1"
    assert path.read_text() == "QGC WPL 110\n" + row.replace(" ", "\t") + "\n"


HOME_ROW = "0\t1\t0\t16\t0\t0\t0\t0\t46.5\t11.3\t1200\t1\n"


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("", "line 1: must be 'QGC WPL 110'"),
        ("QGC WPL 100\n" + HOME_ROW, "line 1: must be 'QGC WPL 110', got 'QGC WPL 100'"),
        ("QGC WPL 110\n", "no row 0"),
        ("QGC WPL 110\n0 1 0 16 0 0 0 0 1 2 3\n", "line 2: must have 12 tab-separated columns, got 11"),
        ("QGC WPL 110\n" + HOME_ROW + "\n" + HOME_ROW, "line 4: index: must be 1, got 0"),
        ("QGC WPL 110\n" + HOME_ROW.replace("46.5", "x"), "line 2: latitude: must be a number, got 'x'"),
        ("QGC WPL 110\n" + HOME_ROW.replace("46.5", "nan"), "line 2: latitude: must be degrees, got nan"),
        ("QGC WPL 110\n" + HOME_ROW.replace("16", "1.5"), "line 2: command: must be a whole number, got '1.5'"),
    ],
)
def test_errors_name_file_line_and_column(tmp_path: Path, text: str, reason: str) -> None:
    path = tmp_path / "bad.waypoints"
    path.write_text(text)
    with pytest.raises(InputError) as error:
        read_waypoints(path)
    assert str(error.value).startswith(f"{path}: {reason}")
    assert "\n" not in str(error.value)


def test_a_missing_file_is_an_input_error(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="No such file"):
        read_waypoints(tmp_path / "nowhere.waypoints")
