"""Failures that the scenario has ordered, as events of a flight."""

from collections.abc import Iterator

from gcs.flight_record import Event
from missions.scenario import Scenario


def scheduled(scenario: Scenario) -> Iterator[Event]:
    """The beginning and the end of each failure that has an end; who is killed is lost, and told of as such."""
    for failure in scenario.failures:
        if failure.for_s is not None:
            for sysid in failure.vehicles or (None,):
                yield Event(failure.at_s, sysid, f"{failure.what}, as scheduled")
                yield Event(failure.at_s + failure.for_s, sysid, f"end of the {failure.what}")


def kills_s(scenario: Scenario) -> dict[int, float]:
    """By sysid, when each of those that the scenario kills is gone."""
    kills: dict[int, float] = {}
    for failure in scenario.failures:
        if failure.what == "kill":
            for sysid in failure.vehicles:
                kills[sysid] = min(failure.at_s, kills.get(sysid, failure.at_s))
    return kills
