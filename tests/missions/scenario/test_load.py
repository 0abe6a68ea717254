"""Scenario files are checked at the door, and every error names the file, the key and the reason."""

from pathlib import Path

import pytest

from missions.errors import InputError
from missions.scenario import load_scenario, parse_scenario, read_scenario_text, shipped_scenarios

RADARS, _ = read_scenario_text("radars")


def error_of(text: str) -> str:
    with pytest.raises(InputError) as caught:
        parse_scenario(text, "radars.toml")
    message = str(caught.value)
    assert message.startswith("radars.toml: ")
    assert "\n" not in message
    return message


def test_five_scenarios_ship() -> None:
    assert shipped_scenarios() == ["crossing", "mountains", "radars", "ridge", "vee"]
    assert [len(load_scenario(name).vehicles) for name in shipped_scenarios()] == [5, 9, 9, 9, 9]


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("radius_m = 1500.0", "radius_m = -1500", "radars[0].radius_m: must be > 0, got -1500"),
        ("radius_m = 1500.0", "radius_m = nan", "radars[0].radius_m: must be a finite number, got nan"),
        ("radius_m = 1500.0", 'radius_m = "wide"', "radars[0].radius_m: must be a number, got 'wide'"),
        ("population", "populaton", "search.populaton: unknown key; did you mean population?"),
        ("sysid = 2", "sysid = 1", "vehicles[1].sysid: 1 is already vehicles[0]'s; give each vehicle its own"),
        ('name = "F1"', 'name = "leader"', "vehicles[1].name: leader is already vehicles[0]'s"),
        ("mass_kg = 11.0", "", "airframe.mass_kg: is missing"),
        (
            'gusts = "light"',
            'gusts = "strong"',
            "wind.gusts: must be one of 'none', 'light' or 'moderate', got 'strong'",
        ),
        ("x_m = [0.0, 40000.0]", "x_m = [9.0, 1.0]", "area: the first number of x_m must be smaller"),
        ("target = [33000.0", "target = [93000.0", "vehicles[0].target: (93000, 24500, 3300) lies outside the area"),
        ("radius_m = 1500.0", "radious_m = 1500.0", "radars[0].radious_m: unknown key; did you mean radius_m?"),
        ("delay_s = 0.2", "delay_s = 1e9", "formation.delay_s: must be <= 60"),
        ("k0 = 0.01", "k0 = 0.01\navoidance = 1", "formation.avoidance: must be true or false, got 1"),
        ("k0 = 0.01", "k0 = 0.01\nreassign = true\nswarm_clock = true", "formation.reassign: places change at times"),
        ("k0 = 0.01", "k0 = 0.01\nreassign = true\navoidance = true", "formation.reassign: others' intents"),
        ("k0 = 0.01", "k0 = 0.01\npinned = [1.5]", "formation.pinned[0]: must be a whole number, got 1.5"),
        ("seed = 1", "seed = 1.5", "seed: must be a whole number, got 1.5"),
    ],
)
def test_errors_name_file_key_and_reason(old: str, new: str, message: str) -> None:
    assert old in RADARS
    assert message in error_of(RADARS.replace(old, new, 1))


def test_several_problems_are_told_together_and_those_after_the_fifth_are_counted() -> None:
    two = error_of(RADARS.replace("radius_m = 1500.0", "radius_m = 0", 2))
    assert two == "radars.toml: radars[0].radius_m: must be > 0, got 0; radars[1].radius_m: must be > 0, got 0"
    many = error_of(RADARS.replace("[[vehicles]]", "[[vehicles]]\nwings = 2"))
    assert many.count("unknown key") == 5
    assert many.endswith(" more)")


def test_broken_toml_names_the_line() -> None:
    assert "line" in error_of(RADARS + "\n[[[")


@pytest.mark.parametrize("content", [b"\xff\xfe\x00", b"name = 3"])
def test_files_that_are_no_scenarios(tmp_path: Path, content: bytes) -> None:
    file = tmp_path / "odd.toml"
    file.write_bytes(content)
    with pytest.raises(InputError, match=r"odd\.toml: "):
        load_scenario(str(file))


def test_a_missing_file_names_what_ships() -> None:
    with pytest.raises(InputError, match="mountains, radars, ridge, vee"):
        load_scenario("nowhere.toml")


def test_a_folder_is_no_scenario(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"directory"):
        load_scenario(str(tmp_path))


def test_a_byte_order_mark_does_no_harm(tmp_path: Path) -> None:
    file = tmp_path / "bom.toml"
    file.write_bytes(b"\xef\xbb\xbf" + RADARS.encode())
    assert load_scenario(str(file)).name == "radars"
