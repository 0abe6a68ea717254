"""The tables of `skein margin`."""

from typing import Any

from rich.table import Table

ROWS = 12
"""Of modes; of more, those with the least margins are shown."""
MAINLY = 0.8
"""Vehicles are named that have this share of what swings."""


def title_line(scenario: str, figures: dict[str, Any]) -> str:
    """What is studied."""
    law = "bare law (15)" if figures["law"] == "bare" else "law as flown"
    count, pinned = len(figures["vehicles"]), len(figures["pinned"])
    pins = "all" if pinned == count else f"{pinned} of {count}"
    graph = f"{figures['graph']} of {count}, weights {figures['weights']}, h_p = 1 for {pins}"
    return f"{scenario}: {graph}, {law}; times in s"


def margin_table(figures: dict[str, Any]) -> Table:
    """The margins of each mode and of the whole."""
    table = Table(title="Delay margins", title_justify="left")
    for heading in ("lambda", "modes", "continuous", "sampled", "aircraft"):
        table.add_column(heading, justify="right")
    modes = figures["modes"]
    if len(modes) > ROWS:
        least = sorted(modes, key=lambda mode: (mode["aircraft_s"] is None, mode["aircraft_s"]))[:ROWS]
        modes = [mode for mode in modes if mode in least]
    for mode in modes:
        value = "all" if mode["eigenvalue"] is None else f"{mode['eigenvalue']:.4f}"
        table.add_row(value, str(mode["multiplicity"]), *_margins(mode))
    table.add_section()
    table.add_row("formation", "", *_margins(figures))
    return table


def limiting_line(figures: dict[str, Any]) -> str:
    """Which mode begins to grow first, and who swings in it."""
    mode = figures["limiting_mode"]
    if mode is None:
        return "Every delay is stable."
    what = "the whole" if mode["eigenvalue"] is None else f"lambda {mode['eigenvalue']:.4f}"
    w = mode["frequency_rad_s"]
    pace = "" if w is None else f" at {w:.2f} rad/s"
    return f"Limiting mode ({mode['of']}): {what} swings{pace}, {_who(mode['swing'])}"


def gains_table(figures: dict[str, Any]) -> Table:
    """Present and suggested gains, and what they are worth to aircraft at the delay."""
    table = Table(title=f"Aircraft at a delay of {figures['delay_s']:g} s", title_justify="left")
    for heading in ("gains", "k1", "k2", "k3", "k0", "margin", "decays in", "on schedule in"):
        table.add_column(heading, justify="left" if heading == "gains" else "right")
    for name, gains in (("present", figures["gains"]), ("suggested", figures["suggested_gains"])):
        damping = figures["damping"][name]
        decay = "grows" if damping["decay_rate_per_s"] < 0.0 else _seconds(damping["decay_time_s"], "never")
        table.add_row(
            name,
            *(f"{gains[key]:.3g}" for key in ("k1", "k2", "k3", "k0")),
            _seconds(damping["aircraft_s"], "any"),
            decay,
            _seconds(damping["common_decay_time_s"], "never"),
        )
    return table


def _margins(figures: dict[str, Any]) -> list[str]:
    return [_seconds(figures[f"{level}_s"], "any", 4) for level in ("continuous", "sampled", "aircraft")]


def _seconds(value: float | None, without: str, digits: int = 2) -> str:
    return without if value is None else f"{value:.{digits}f}"


def _who(swing: dict[str, float]) -> str:
    """The vehicles with most of the energy, or that all have about as much."""
    shares = sorted(swing.items(), key=lambda item: -item[1])
    if shares[0][1] < 1.5 / len(shares):
        return "all vehicles about alike"
    named, together = [], 0.0
    for sysid, share in shares[:4]:
        if together < MAINLY:
            named.append(f"{sysid} ({share:.0%})")
        together += share
    return "mostly vehicles " + ", ".join(named) if len(named) > 1 else f"mostly vehicle {named[0]}"
