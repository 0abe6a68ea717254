"""Scenarios whose keys contradict each other are refused, with what to do."""

import pytest

from missions.errors import InputError
from missions.scenario import parse_scenario, read_scenario_text

TEXT = {name: read_scenario_text(name)[0] for name in ("mountains", "radars", "vee")}


@pytest.mark.parametrize(
    ("name", "old", "new", "message"),
    [
        (
            "mountains",
            "target = [25000.0, 24000.0, 2500.0]",
            "target = [30000.0, 30000.0, 1630.0]",
            r"vehicles\[3\]\.target: 12\d m inside the ground at \(30000, 30000\); raise z to at least 18\d\d m",
        ),
        (
            "radars",
            "target = [25000.0, 23500.0, 2500.0]",
            "target = [25000.0, 23500.0, 50.0]",
            r"vehicles\[3\]\.target: 50 m above the ground, limits\.clearance_m is 100; raise z to at least 100 m",
        ),
        (
            "radars",
            "target = [25000.0, 23500.0, 2500.0]",
            "target = [20000.0, 18600.0, 1500.0]",
            r"vehicles\[3\]\.target: .* is within 100 m of obstacles\[2\]",
        ),
        (
            "radars",
            "target = [25000.0, 23500.0, 2500.0]",
            "target = [25000.0, 24100.0, 2500.0]",
            r"vehicles\[5\]\.target: 100 m from vehicles\[3\]'s",
        ),
        (
            "radars",
            "origin = [0.0, 14000.0, 0.0]",
            "origin = [0.0, 12050.0, 0.0]",
            r"vehicles\[3\]\.origin: 50 m from vehicles\[1\]'s, and both start together",
        ),
        ("vee", "behind_m = 106.07, left_m = 106.07", "behind_m = 20.0, left_m = 20.0", r"vehicles\[1\]\.slot: 28 m"),
        ("radars", "k0 = 0.01", "k0 = 0.01\npinned = [1, 10]", r"formation\.pinned: there is no vehicle 10"),
        ("radars", "origin = [0.0, 10000.0, 0.0]\n", "", r"vehicles\[0\]: needs origin and target, or a slot"),
        ("vee", "[route]", "[other]", r"other: unknown key"),
        (
            "vee",
            "slot = { behind_m = 0.00, left_m = 0.00 }",
            "origin = [0.0, 0.0, 0.0]\ntarget = [9000.0, 0.0, 300.0]",
            r"vehicles\[0\]: has no slot but others have",
        ),
        (
            "radars",
            "[airframe]",
            "[route]\nground_speed_m_s = 28.0\npoints = [[0.0, 0.0, 0.0], [9000.0, 0.0, 0.0]]\n[airframe]",
            r"route: no vehicle has a slot on it",
        ),
    ],
)
def test_contradictions_are_named(name: str, old: str, new: str, message: str) -> None:
    assert old in TEXT[name]
    with pytest.raises(InputError, match=message):
        parse_scenario(TEXT[name].replace(old, new, 1), f"{name}.toml")


def test_origins_in_the_ground_are_lifted_to_it() -> None:
    text = TEXT["mountains"].replace("origin = [0.0, 10000.0, 0.0]", "origin = [4000.0, 10000.0, -50.0]", 1)
    scenario = parse_scenario(text, "mountains.toml")
    assert scenario.origin_m(scenario.vehicles[0])[2] > 0


def test_slots_lie_beside_the_ends_of_the_route() -> None:
    scenario = parse_scenario(TEXT["vee"], "vee.toml")
    lead, left = scenario.vehicles[0], scenario.vehicles[1]
    assert scenario.origin_m(lead) == (0.0, 0.0, 0.0)
    x, y, _ = scenario.origin_m(left)
    assert (x, y) == pytest.approx((-106.07, 106.07))
    (ax, ay, _), (bx, by, _) = scenario.target_m(lead), scenario.target_m(left)
    assert (bx - ax, by - ay) == pytest.approx((-106.07, 106.07))
