"""The gains that each vehicle of a swarm is told."""

from missions.scenario import parse_scenario, read_scenario_text
from sitl.swarm import SwarmOptions, vehicle_configs

RADARS, _ = read_scenario_text("radars")
OPTIONS = SwarmOptions(seed=1, delay_s=0.2)


def test_a_vehicle_that_is_not_pinned_has_no_k0_and_all_else() -> None:
    scenario = parse_scenario(RADARS.replace("k0 = 0.01", "k0 = 0.01\npinned = [2]"), "custom.toml")
    gains = {config.sysid: config.gains for config in vehicle_configs(scenario, OPTIONS)}
    assert {sysid for sysid in gains if gains[sysid].k0 == 0.01} == {2}
    assert {sysid for sysid in gains if gains[sysid].k0 == 0.0} == set(range(1, 10)) - {2}
    assert {one[:3] for one in gains.values()} == {(0.2, 0.8, 0.4)}


def test_all_are_pinned_unless_told_otherwise() -> None:
    scenario = parse_scenario(RADARS, "radars.toml")
    assert all(config.gains.k0 == 0.01 for config in vehicle_configs(scenario, OPTIONS))
