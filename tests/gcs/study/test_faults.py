"""Random schedules are the same for the same seed, and scenarios take them."""

from collections.abc import Sequence

from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from gcs.study.faults import MOST_KILLED, draw_faults
from missions.scenario import load_scenario
from missions.scenario.check import problems

RADARS = load_scenario("radars")
swarms = st.sets(st.integers(1, 250), min_size=3, max_size=9).map(sorted)


@settings(max_examples=30, deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(seed=st.integers(0, 2**40), sysids=swarms)
def test_schedules_repeat_and_leave_two_vehicles_or_more(seed: int, sysids: Sequence[int]) -> None:
    faults = draw_faults(seed, sysids, 500.0)
    assert faults == draw_faults(seed, sysids, 500.0)
    killed = {sysid for failure in faults.failures if failure.what == "kill" for sysid in failure.vehicles}
    assert len(killed) <= MOST_KILLED
    assert len(set(sysids) - killed) >= 2


def test_every_kind_of_failure_is_drawn_and_scenarios_take_them() -> None:
    sysids = [vehicle.sysid for vehicle in RADARS.vehicles]
    drawn = [draw_faults(seed, sysids, 1200.0) for seed in range(60)]
    assert {failure.what for faults in drawn for failure in faults.failures} == {"kill", "freeze", "silence", "split"}
    assert 10 < sum(faults.channel.bursts is not None for faults in drawn) < 50
    for faults in drawn:
        changed = RADARS.model_copy(update={"channel": faults.channel, "failures": faults.failures})
        assert list(problems(changed)) == []
        assert type(changed).model_validate(changed.model_dump(by_alias=True)) is not None
