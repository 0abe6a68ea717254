"""Mission files as stations and scripts of all ages write them: what each is read as, or why it is refused.

The files in corpus/good and corpus/broken are small and written by hand, each with one peculiarity.
"""

import math
from pathlib import Path
from typing import Any

import pytest

from missions.errors import InputError
from missions.fence import Fence, FenceCircle, FencePolygon, rally_items
from missions.formats.mission_file import home_at, read_mission_file
from missions.mission import MissionItem

CORPUS = Path(__file__).parent / "corpus"
HOME = MissionItem(16, 0, lat_e7=474_000_000, lon_e7=85_000_000, alt_m=450.0)
NAN = math.nan


def point(lat_deg: float, lon_deg: float, alt_m: float, command: int = 16, frame: int = 3, **more: Any) -> MissionItem:
    return MissionItem(command, frame, lat_e7=round(lat_deg * 1e7), lon_e7=round(lon_deg * 1e7), alt_m=alt_m, **more)


A, B = point(47.41, 8.51, 100.0), point(47.42, 8.53, 120.0)
"""What nearly all files say; params of .plan files written today are 0, 0, 0 and NaN."""
A_NAN, B_NAN = point(47.41, 8.51, 100.0, param4=NAN), point(47.42, 8.53, 120.0, param4=NAN)


def jump(target: int, times: int) -> MissionItem:
    return MissionItem(177, 2, float(target), float(times))


def assert_read(name: str, *items: MissionItem, notes: tuple[str, ...] = (), **options: Any) -> Any:
    """Read a good file: home, these items, and notes that begin so."""
    found = read_mission_file(CORPUS / "good" / name, **options)
    assert [*map(repr, found.plan.mission)] == [*map(repr, (HOME, *items))]  # NaN equals NaN in words
    assert len(found.notes) == len(notes), found.notes
    for note, beginning in zip(found.notes, notes, strict=True):
        assert note.startswith(beginning)
    return found.plan


def test_todays_qgroundcontrol_with_fence_rally_and_return_point() -> None:
    plan = assert_read(
        "qgc_4.plan",
        point(47.401, 8.501, 50.0, 22, param1=15.0, param4=NAN),
        MissionItem(178, 2, 0.0, 24.0, -1.0),
        A_NAN,
        B_NAN,
        MissionItem(20, 2),
    )
    corners = ((474_300_000, 85_000_000), (474_400_000, 85_000_000), (474_400_000, 85_100_000))
    around = FenceCircle(True, (474_100_000, 85_200_000), 3000.5)
    assert plan.fence == Fence((FencePolygon(False, corners), around), (474_000_000, 85_000_000))
    assert plan.rally == rally_items([(474_050_000, 85_050_000, 60.0)])


def test_the_first_plans_with_coordinates_and_a_fence_of_version_1_which_qgroundcontrol_drops_without_a_word() -> None:
    plan = assert_read("qgc_first_plans.plan", A, B, notes=("geoFence: version 1: its polygon",))
    (area,) = plan.fence.areas
    assert (area.inclusion, len(area.vertices), plan.fence.return_point) == (True, 4, (474_000_000, 85_000_000))


def test_a_mission_of_qgroundcontrol_3_without_file_type_and_its_take_off_in_frame_2() -> None:
    assert_read("qgc_3.mission", point(47.401, 8.501, 50.0, 22), A, B, notes=("items[0]: a take-off in frame 2",))


def test_a_mission_of_qgroundcontrol_2_with_param1_to_param4_and_home_as_an_item() -> None:
    assert_read("qgc_2.mission", point(47.41, 8.51, 100.0, param2=25.0), B, jump(1, 2))


def test_a_plan_of_a_script_without_versions_speeds_ids_fence_and_rally_points() -> None:
    plan = assert_read("bare.plan", A_NAN, B_NAN)
    assert plan.fence == Fence()
    assert plan.rally == ()


@pytest.mark.parametrize("name", ["commented.plan", "utf16.plan", "numbers_with_points.plan"])
def test_comments_byte_order_marks_carriage_returns_and_whole_numbers_with_points_change_nothing(name: str) -> None:
    assert_read(name, A_NAN, B_NAN)


def test_an_altitude_that_stands_only_beside_the_params_is_taken_and_said() -> None:
    above_sea = point(47.42, 8.53, 620.5, frame=0, param4=NAN)
    notes = ("mission.items[0]: params[6] is not there; Altitude", "mission.items[1]: params[6] is not there; AMSL")
    assert_read("altitude_beside_params.plan", A_NAN, above_sea, notes=notes)


def test_altitudes_above_ground_are_read_as_they_are_flown_not_as_they_are_shown() -> None:
    worked_out = point(47.41, 8.51, 575.5, frame=0, param4=NAN)
    assert_read("above_terrain.plan", worked_out, point(47.42, 8.53, 120.0, frame=10, param4=NAN))


def test_jumps_follow_do_jump_ids_not_places_in_the_list() -> None:
    assert_read("jump_ids.plan", A_NAN, B_NAN, jump(2, 3))


def test_a_survey_left_out_is_said_and_jumps_beyond_it_are_renumbered() -> None:
    notes = ("mission.items[1]: ComplexItem 'survey' was left out",)
    assert_read("survey.plan", A_NAN, B_NAN, jump(2, 1), notes=notes, complex_items="skip")


def test_a_survey_can_be_replaced_by_the_items_that_the_file_keeps_of_it() -> None:
    inside = (point(47.411, 8.511, 100.0, param4=NAN), point(47.412, 8.512, 100.0, param4=NAN))
    notes = ("mission.items[1]: ComplexItem 'survey' became 2 simple items",)
    assert_read("survey.plan", A_NAN, *inside, B_NAN, jump(4, 1), notes=notes, complex_items="expand")


def test_a_landing_pattern_can_be_left_out_but_not_expanded() -> None:
    assert_read("landing_pattern.plan", A_NAN, B_NAN, notes=("mission.items[2]: ComplexItem",), complex_items="skip")
    with pytest.raises(InputError, match=r"mission.items\[2\]: ComplexItem 'fwLandingPattern': the file keeps no"):
        read_mission_file(CORPUS / "good" / "landing_pattern.plan", complex_items="expand")


def test_params_5_and_6_of_an_item_without_position_are_no_degrees() -> None:
    shoot = MissionItem(203, 2, lat_e7=1)
    assert shoot.lat_deg == 1.0
    assert_read("camera.plan", A_NAN, shoot, B_NAN)


def test_an_item_without_position_is_where_the_vehicle_is_and_that_is_said() -> None:
    here = MissionItem(17, 3, param4=NAN, alt_m=60.0)
    assert_read("no_position.plan", A_NAN, here, B_NAN, notes=("mission.items[1]: has no position",))


def test_keys_that_are_not_known_are_said() -> None:
    notes = ('mission: "wingLoading" is not known', 'mission.items[0]: "speed" is not known')
    assert_read("newer_keys.plan", A_NAN, B_NAN, notes=notes)


@pytest.mark.parametrize(
    "name",
    [
        *("mission_planner.waypoints", "mavproxy.txt", "spaces.waypoints", "commas.waypoints", "blank_lines.waypoints"),
        "current_row.waypoints",
    ],
)
def test_rows_mean_the_same_however_they_are_separated_ended_commented_and_flagged(name: str) -> None:
    assert_read(name, A, B)


def test_frames_of_ints_and_whole_numbers_with_points() -> None:
    assert_read("int_frames.waypoints", A, point(47.42, 8.53, 120.0, frame=10))


def test_home_in_frame_3_has_its_altitude_above_sea() -> None:
    assert_read("home_in_frame_3.waypoints", A, B, notes=("home: in frame 3",))


def test_a_home_at_0_0_is_read_and_said_to_be_likely_unknown() -> None:
    found = read_mission_file(CORPUS / "good" / "home_unknown.waypoints")
    assert found.plan.mission.items == (MissionItem(16), A, B)
    assert found.notes[0].startswith("home: latitude and longitude are 0")


@pytest.mark.parametrize("name", ["old_qgc_120.txt", "no_home_row.waypoints"])
def test_files_without_home_need_one_and_jumps_count_it(name: str) -> None:
    with pytest.raises(InputError, match="say where home is with --home"):
        read_mission_file(CORPUS / "good" / name)
    assert_read(name, A, B, jump(2, 2), home=home_at("47.4,8.5,450"))


BROKEN = {
    "truncated.plan": "line 28: not JSON",
    "duplicate_key.plan": "mission.items[0].frame: stands here twice",
    "nan.plan": "mission.items[0].params[4]: no number",
    "infinity.plan": "mission.items[0].params[4]: no number",
    "digits.plan": "mission.items[0].params[4]: no number",
    "thousands_of_digits.plan": "not a plan: a number of thousands of digits",
    "nested.plan": "not a plan: nested too deeply",
    "other_file_type.plan": "fileType: must be 'Plan', got 'Fence'",
    "version_2.plan": "version: must be 1, got 2",
    "mission_version_3.plan": "mission.version: must be 1 or 2, got 3",
    "text_for_null.plan": 'mission.items[0].params[3]: must be a number or null, got "null"',
    "six_params.plan": "mission.items[0].params: must have 7 numbers, got 6",
    "params_twice.plan": "mission.items[0]: has both params and param1",
    "frame_99.plan": "mission.items[0].frame: must be 0 to 21, got 99",
    "command_negative.plan": "mission.items[0].command: must be 0 to 65535, got -16",
    "command_missing.plan": "mission.items[0].command: must be a whole number, got null",
    "auto_continue_text.plan": "mission.items[0].autoContinue: must be true or false",
    "altitudes_disagree.plan": "mission.items[1].Altitude: is 80, but params[6], which is flown, 120",
    "altitude_never_worked_out.plan": "mission.items[0].params[6]: is not there, and Altitude 100 may be",
    "no_altitude.plan": "item 1 (command 16): it has no altitude",
    "huge_altitude.plan": "mission.items[0].params[6]: must be a number that MAVLink can carry",
    "half_a_place.plan": "mission.items[0]: has a latitude or a longitude but not both",
    "latitude_95.plan": "item 1 (command 16): latitude 95 is none",
    "home_null.plan": "mission.plannedHomePosition: there is none; say where home is with --home",
    "home_missing.plan": "mission.plannedHomePosition: there is none; say where home is with --home",
    "place_in_frame_2.plan": "mission.items[0].params[4]: must be a whole number, as frame 2 has no position",
    "survey_unasked.plan": "mission.items[1]: ComplexItem 'survey' cannot be read; replace it",
    "jump_to_twins.plan": "mission.items[2]: DO_JUMP to doJumpId 1: several items have it",
    "fence_of_two_corners.plan": "geoFence.polygons[0].polygon: must have at least 3 corners",
    "fence_corner_null.plan": "geoFence.polygons[0].polygon[2][1]: must be a number, got null",
    "fence_altitude_band.plan": "geoFence.circles[0].altitudeBandEnabled: an area between two altitudes",
    "fence_version_3.plan": "geoFence.version: must be 1 or 2, got 3",
    "rally_without_altitude.plan": "rallyPoints.points[0][2]: must be a number",
    "eleven_columns.waypoints": "line 3: must have 12 tab-separated columns, got 11",
    "truncated_row.waypoints": "line 4: must have 12 tab-separated columns, got 2",
    "decimal_commas.waypoints": "line 3: latitude: must be a number, got '47,41'",
    "raw_1e7.waypoints": "line 3: latitude: must be degrees, got 4.741e+08",
    "index_gap.waypoints": "line 4: index: must be 2, got 3",
    "guided_target.waypoints": "line 3: current: must be 0 to 1, got '2'",
    "underscores.waypoints": "line 3: altitude: must be a number, got '1_00.0'",
    "other_digits.waypoints": "line 3: altitude: must be a number",
    "infinite_param.waypoints": "line 3: param1: must be a number, got 'inf'",
    "huge_param.waypoints": "line 3: param1: must be a number that MAVLink can carry",
    "take_off_for_home.waypoints": "row 0: is home, and must be a NAV_WAYPOINT (16) in frame 0, got command 22",
    "version_100.waypoints": "line 1: must be 'QGC WPL 110', got 'QGC WPL 100'",
    "protobuf.waypoints": "line 1: must be 'QGC WPL 110', got 'QGC WPL PB 110'",
    "no_header.waypoints": "line 1: neither a plan",
    "empty.waypoints": "line 1: neither a plan",
    "header_only.waypoints": "no row 0",
    "latitude_95.waypoints": "item 1 (command 16): latitude 95 is none",
    "latin_1.waypoints": "byte 15: not UTF-8 text",
    "qgc_120_without_home.txt": "QGC WPL 120 has no home; say where home is with --home",
}


@pytest.mark.parametrize(("name", "reason"), BROKEN.items(), ids=list(BROKEN))
def test_a_broken_file_is_refused_with_its_line_or_place(name: str, reason: str) -> None:
    path = CORPUS / "broken" / name
    with pytest.raises(InputError) as error:
        read_mission_file(path)
    assert str(error.value).startswith(f"{path}: {reason}")
    assert "\n" not in str(error.value)


def test_a_jump_to_an_item_of_a_survey_that_is_left_out_is_refused() -> None:
    with pytest.raises(InputError, match=r"items\[3\]: DO_JUMP to doJumpId 2: no item that was read has it"):
        read_mission_file(CORPUS / "broken" / "jump_into_survey.plan", complex_items="skip")


def test_every_file_of_the_corpus_has_its_test() -> None:
    text = Path(__file__).read_text(encoding="utf-8")
    assert all(f'"{path.name}"' in text for path in CORPUS.glob("*/*"))
