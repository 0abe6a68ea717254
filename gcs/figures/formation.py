"""How well the formation held, over time."""

from pathlib import Path

from gcs.figures import style
from gcs.metrics.series import Series
from gcs.theme import theme
from missions.scenario import Scenario


def draw_formation(scenario: Scenario, series: Series, path: Path) -> None:
    """Draw formation error and least separation over time, of two vehicles or more."""
    t_s = series.tracks.t_s
    with style.page(path, 5.6) as figure:
        above, below = figure.subplots(2, 1, sharex=True)
        overall_m = series.error.overall_rms_m
        above.fill_between(t_s, series.error.max_m, color=style.VEHICLES[4], alpha=0.3, linewidth=0)
        above.plot(t_s, series.error.rms_m, color=style.VEHICLES[0], linewidth=1.2)
        above.set_title("Formation error" if overall_m is None else f"Formation error, {overall_m:.2f} m RMS in all")
        above.set_ylabel("error (m)")
        below.plot(t_s, series.separation_m, color=style.VEHICLES[2], linewidth=2.2)
        below.plot(t_s, series.planned_separation_m, color=theme().ink, linewidth=0.9, linestyle=style.DASHES)
        below.axhline(scenario.limits.separation_m, color=style.DANGER, linewidth=1.4)
        below.set_title("Least separation of any two")
        below.set_ylabel("distance (m)")
        below.set_xlabel("time since launch (s)")
        below.set_xlim(0.0, t_s[-1])
        above.set_ylim(bottom=0.0)
        below.set_ylim(bottom=0.0)
        style.headline(figure, f"{scenario.name}: the formation")
        style.legend_beside(
            figure,
            [
                style.line_handle("largest of the edges", color=style.VEHICLES[4], alpha=0.4, linewidth=7),
                style.line_handle("RMS over the edges", color=style.VEHICLES[0]),
                style.line_handle("separation flown", color=style.VEHICLES[2], linewidth=2.2),
                style.line_handle("separation planned", color=theme().ink, linewidth=0.9, linestyle=style.DASHES),
                style.line_handle(f"safe: {scenario.limits.separation_m:g} m", color=style.DANGER),
            ],
        )
