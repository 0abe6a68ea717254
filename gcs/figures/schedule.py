"""Progress of each vehicle against its plan."""

from pathlib import Path

from gcs.figures import style
from gcs.metrics.series import Series
from gcs.theme import theme
from missions.scenario import Scenario


def draw_schedule(scenario: Scenario, series: Series, path: Path) -> None:
    """Draw how far along its path each vehicle is, in per cent, and how far ahead of its plan, in metres."""
    schedule = series.schedule
    colours = style.vehicle_colours(scenario)
    with style.page(path, 5.8) as figure:
        above, below = figure.subplots(2, 1, sharex=True, height_ratios=[2, 3])
        for i, sysid in enumerate(series.tracks.sysids):
            per_cent = 100.0 / schedule.length_m[i]
            planned, deviation = schedule.planned_m[i], schedule.deviation_m[i]
            above.plot(schedule.t_s, (planned + deviation) * per_cent, color=colours[sysid], linewidth=2.0)
            below.plot(schedule.t_s, deviation, color=colours[sysid], linewidth=1.2)
        for i in range(len(series.tracks.sysids)):
            planned_share = schedule.planned_m[i] * 100.0 / schedule.length_m[i]
            above.plot(schedule.t_s, planned_share, color=theme().ink, linewidth=0.4, linestyle=style.DASHES)
        below.axhline(0.0, color=theme().ink, linewidth=0.9, linestyle=style.DASHES)
        above.set_title("Progress along its path")
        above.set_ylabel("path flown (%)")
        above.set_ylim(0.0, 102.0)
        below.set_title("Deviation from its plan")
        below.set_ylabel("ahead of plan (m)")
        below.set_xlabel("time since launch (s)")
        below.set_xlim(0.0, schedule.t_s[-1])
        style.headline(figure, f"{scenario.name}: the schedule")
        planned_handle = style.line_handle("planned", color=theme().ink, linewidth=0.9, linestyle=style.DASHES)
        style.legend_beside(figure, [*style.vehicle_handles(scenario), planned_handle])
