"""How planning time grows with the number of vehicles."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from gcs.figures import style
from gcs.theme import theme
from planner.bench.growth import Growth, exponent

POWER = 1.3


def draw_growth(growths: Sequence[Growth], path: Path) -> None:
    """Draw CPU time over the number of vehicles, beside n log n and n^1.3 from the same beginning. Raises OSError."""
    n, cpu_s = np.array([(growth.uavs, growth.cpu_s) for growth in growths]).T
    line = np.geomspace(n[0], n[-1], 50)
    with style.page(path, 4.4) as figure:
        axes = figure.subplots()
        axes.plot(n, cpu_s, color=style.VEHICLES[0], marker="o")
        nlogn, power = line * np.log(line) / (n[0] * np.log(n[0])), (line / n[0]) ** POWER
        axes.plot(line, cpu_s[0] * nlogn, color=theme().faint, linestyle=":")
        axes.plot(line, cpu_s[0] * power, color=theme().faint, linestyle=style.DASHES)
        axes.set_xscale("log")
        axes.set_yscale("log")
        axes.set_xticks(n, [f"{count:g}" for count in n])
        axes.minorticks_off()
        axes.set_yticks([0.5, 1, 2, 5, 10, 20], ["0.5", "1", "2", "5", "10", "20"])
        axes.set_ylim(0.8 * cpu_s.min(), 1.3 * max(cpu_s.max(), cpu_s[0] * power[-1]))
        axes.set_xlabel("vehicles in one plan")
        axes.set_ylabel("CPU time (s)")
        style.headline(figure, f"Planning many vehicles: time grows as n^{exponent(growths):.2f}")
        handles = [
            style.line_handle("measured, verified", color=style.VEHICLES[0], marker="o"),
            style.line_handle("n log n", color=theme().faint, linestyle=":"),
            style.line_handle(f"n^{POWER:g}", color=theme().faint, linestyle=style.DASHES),
        ]
        style.legend_beside(figure, handles)
