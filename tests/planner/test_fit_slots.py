"""Formations of all patterns and widths on random routes and through gaps: proven apart, or refused with a reason."""

import math
import re

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from missions.errors import InputError
from missions.scenario import Scenario, load_scenario
from missions.scenario.check import problems
from missions.scenario.shape import PATTERNS
from planner.fit_slots import SCALE_STEP, fit_slots
from planner.plan import plan
from planner.slots import AS_IN_PATTERN, SINGLE_FILE, route_of
from planner.verify import verify

VEE = load_scenario("vee")
GAP_X_M = 9000.0
STRAIGHT = tuple((x, 0.0, 250.0 if x else 0.0) for x in (0.0, 5000.0, GAP_X_M, 13000.0, 18000.0))


def formation(pattern: str, count: int, size_m: float, points: object = STRAIGHT, **changes: object) -> Scenario:
    """The V's scenario with another shape and route; `size_m` is its width, or the spacing of a column."""
    kept = {
        name: getattr(VEE, name) for name in Scenario.model_fields if name not in ("vehicles", "shape", "route", "area")
    }
    measure = "spacing_m" if pattern == "column" else "width_m"
    return Scenario.model_validate(
        {
            **kept,
            "area": {"x_m": (-60e3, 60e3), "y_m": (-60e3, 60e3), "z_m": (0.0, 600.0)},
            "shape": {"pattern": pattern, "count": count, measure: size_m},
            "route": {"points": points, "ground_speed_m_s": 28.0},
            **changes,
        }
    )


def gate(gap_m: float) -> list[dict[str, float]]:
    """Two towers, one on either side of the middle of `STRAIGHT`."""
    return [{"x_m": GAP_X_M, "y_m": side * (gap_m / 2 + 1e3), "radius_m": 1e3, "height_m": 500.0} for side in (1, -1)]


@settings(max_examples=15, deadline=None)
@given(
    pattern=st.sampled_from([name for name in PATTERNS if name != "custom"]),
    count=st.integers(2, 9),
    width=st.floats(math.log(50.0), math.log(2000.0)).map(math.exp),
    legs=st.lists(st.tuples(st.floats(3000.0, 7000.0), st.floats(-50.0, 50.0)), min_size=2, max_size=4),
)
def test_any_formation_is_proven_apart_at_every_instant_or_refused(
    pattern: str, count: int, width: float, legs: list[tuple[float, float]]
) -> None:
    x, y, heading = 0.0, 0.0, 0.0
    points = [(x, y, 0.0)]
    for length, turn in legs:
        heading += math.radians(turn)
        x, y = x + length * math.cos(heading), y + length * math.sin(heading)
        points.append((x, y, 250.0))
    scenario = formation(pattern, count, max(width / count, 80.0) if pattern == "column" else width, points)
    if next(problems(scenario), None) is not None:
        assert width < count * VEE.limits.separation_m * 1.01
        return
    reason = ""
    try:
        result = plan(scenario)
    except InputError as error:
        reason = str(error)
    if reason:
        assert re.match(r"vee: route\.points\[.*no narrower formation helps", reason)
        return
    report = verify(result, scenario)
    assert report.violations == ()
    assert min(uav.separation_m for uav in report.uavs) >= scenario.limits.separation_m - 0.05
    references = list(result.references(scenario).values())
    t = np.arange(0.0, min(reference.duration_s for reference in references), 0.2)
    positions = np.array([reference.positions(t) for reference in references])
    for i in range(1, count):
        apart = np.linalg.norm(positions[i:] - positions[:-i], axis=2)
        assert apart.min() >= scenario.limits.separation_m - 0.1


def test_the_shipped_v_is_flown_at_full_width() -> None:
    fit = fit_slots(VEE, route_of(VEE)).fit
    assert fit.scale.tolist() == [1.0] * 4
    assert fit.stagger.tolist() == [AS_IN_PATTERN] * 4


@pytest.mark.parametrize(("gap_m", "widest"), [(900.0, 0.7), (600.0, 0.4)])
def test_a_gap_narrows_the_corner_within_it_as_little_as_it_must(gap_m: float, widest: float) -> None:
    """A V of 1000 m through gaps whose towers keep 100 m free: (gap - 200 m) / 1000 m is left."""
    scenario = formation("vee", 9, 1000.0, obstacles=gate(gap_m))
    result = plan(scenario)
    assert result.slot_scale[2] == pytest.approx(widest, abs=SCALE_STEP)
    assert result.slot_scale[2] <= widest
    assert [scale for k, scale in enumerate(result.slot_scale) if k != 2] == [1.0] * 4
    assert set(result.slot_stagger) == {AS_IN_PATTERN}


def test_a_line_abreast_staggers_where_narrowing_brings_it_too_near_to_each_other() -> None:
    result = plan(formation("line_abreast", 9, 1000.0, obstacles=gate(600.0)))
    assert result.slot_scale[2] < 0.4
    assert result.slot_stagger[2] > AS_IN_PATTERN
    assert result.slot_stagger[0] == result.slot_stagger[-1] == AS_IN_PATTERN


def test_the_narrowest_gap_is_passed_in_single_file() -> None:
    result = plan(formation("line_abreast", 5, 600.0, obstacles=gate(202.0)))
    assert result.slot_scale[2] == 0.0
    assert SINGLE_FILE in result.slot_stagger or result.slot_stagger[2] == 1


def test_terrain_narrows_too_and_the_formation_opens_again() -> None:
    hills = [
        {"height_m": 500.0, "x_m": GAP_X_M, "y_m": side * 750.0, "decline_x_m": 600.0, "decline_y_m": 400.0}
        for side in (1, -1)
    ]
    result = plan(formation("vee", 9, 1000.0, terrain={"peaks": hills}))
    assert 0.5 < result.slot_scale[2] < 0.8
    assert result.slot_scale[3] == 1.0


def test_the_side_of_the_area_narrows_only_who_is_beside_it() -> None:
    area = {"x_m": (-60e3, 60e3), "y_m": (-60e3, 420.0), "z_m": (0.0, 600.0)}
    bent = [(x, y, z) for (x, _, z), y in zip(STRAIGHT, (-400.0, 0.0, 100.0, 0.0, -400.0), strict=True)]
    result = plan(formation("vee", 9, 1000.0, bent, area=area))
    assert result.slot_scale[2] == pytest.approx(0.64, abs=SCALE_STEP)
    assert result.slot_scale[0] == result.slot_scale[-1] == 1.0


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"obstacles": gate(150.0)}, r"route.points\[2\].*lead: too near to an obstacle at \("),
        (
            {"points": ((0.0, 0.0, 0.0), (5000.0, 0.0, 250.0), (5100.0, 3000.0, 250.0))},
            r"route.points\[1\]: lead: turns by 88",
        ),
        ({"points": ((0.0, 0.0, 0.0), (9000.0, 0.0, 250.0), (15e3, 0.0, 250.0))}, "lead: leg 1 is 9003 m long"),
    ],
)
def test_what_fits_at_no_width_names_corner_slot_and_reason(changes: dict[str, object], message: str) -> None:
    scenario = formation("vee", 5, 600.0, **changes)  # type: ignore[arg-type]
    with pytest.raises(InputError, match=r"vee: route\.points\[") as caught:
        plan(scenario)
    assert caught.match(message)
    assert caught.match("no narrower formation helps")
