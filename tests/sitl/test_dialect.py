"""What endpoint and rehearsal share keeps to the dialect that plain Python and numba compute bit for bit alike."""

import ast
import inspect
from types import ModuleType

import pytest

import missions.airframe
import missions.environment.raster
import missions.environment.terrain
import missions.reference.path
import missions.reference.smoothing
import sitl.aircraft.actuators
import sitl.aircraft.gusts
import sitl.aircraft.linearisation
import sitl.aircraft.point_mass
import sitl.avoidance.course
import sitl.avoidance.manoeuvre
import sitl.avoidance.nearest
import sitl.avoidance.rule
import sitl.flight
import sitl.formation.law
import sitl.guidance.loiter_law
import sitl.guidance.path_errors
import sitl.guidance.path_law

SHARED: dict[ModuleType, tuple[str, ...]] = {
    missions.airframe: ("dynamic_pressure_area", "drag_n", "thrust_max_n", "lift_max_n"),
    missions.environment.raster: ("cell_and_share", "raster_height_and_slope"),
    missions.environment.terrain: (
        "datum_wave_m",
        "datum_wave_slope",
        "analytic_height_m",
        "ground_height_m",
        "ground_height_and_slope",
    ),
    missions.reference.path: ("path_at",),
    missions.reference.smoothing: ("quadratic_at",),
    sitl.aircraft.actuators: ("lagged",),
    sitl.aircraft.gusts: ("start_gusts", "step_gusts", "wind_at"),
    sitl.aircraft.linearisation: ("controls_for",),
    sitl.aircraft.point_mass: ("point_mass_rates", "rk4_step", "air_velocity", "with_air_velocity"),
    sitl.avoidance.course: ("lead_in", "raised_in", "predict", "scheduled_at"),
    sitl.avoidance.manoeuvre: (
        "going_on",
        "aside",
        "yielding_acceleration",
        "drift_of",
        "surplus_of",
        "pace_alone",
        "return_speed",
        "means",
        "climb_left",
        "pace_of",
    ),
    sitl.avoidance.nearest: ("least_distance",),
    sitl.avoidance.rule: ("has_right_of_way", "nearest", "decide"),
    sitl.flight: (
        "launched",
        "launched_along",
        "in_next_wind",
        "ground_velocity",
        "path_accelerations",
        "airspeed_at",
        "moved",
    ),
    sitl.formation.law: ("correction", "formation_acceleration"),
    sitl.guidance.loiter_law: ("from_centre_m", "to_go_m", "on_approach", "loiter_accelerations"),
    sitl.guidance.path_errors: ("path_errors",),
    sitl.guidance.path_law: (
        "clamp",
        "across_acceleration",
        "up_acceleration",
        "speed_acceleration",
        "speed_before_height",
        "limited",
    ),
}
FUNCTIONS = [getattr(module, name) for module, names in SHARED.items() for name in names]
SAME_EVERYWHERE = {
    "sqrt",
    "sin",
    "cos",
    "tan",
    "atan",
    "atan2",
    "asin",
    "tanh",
    "exp",
    "log",
    "floor",
    "copysign",
    "pi",
}
"""Of math; measured bit for bit equal. math.hypot and powers are not."""


@pytest.mark.parametrize("function", FUNCTIONS, ids=lambda f: f"{f.__module__}.{f.__name__}")
def test_only_operations_that_agree_are_used(function: object) -> None:
    for node in ast.walk(ast.parse(inspect.getsource(function))):  # type: ignore[arg-type]
        assert not isinstance(node, ast.Pow), "x * x, not x ** 2"
        if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name) and node.value.id == "math":
            assert node.attr in SAME_EVERYWHERE
        if isinstance(node, ast.Name):
            assert node.id not in {"np", "sum", "pow", "hypot"}
