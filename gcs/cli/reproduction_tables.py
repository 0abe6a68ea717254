"""The tables of `skein reproduce` for people; they fit 80 columns."""

from typing import Any

from rich.table import Table

NUMBERS = {"mountains": 3, "radars": 6}
"""Of the paper's tables, by scenario."""


def distance_table(result: dict[str, Any]) -> Table:
    """Table 3 or 6: distances travelled."""
    name = result["scenario"]
    table = _table(
        f"Table {NUMBERS[name]}: {name}, kilometres; plans of seed {result['seeds'][0]}",
        ["UAV", "origin", "target", "line", "planned", "flown", "f", "f skein"],
    )
    for row in result["table"]:
        flown = row["flown_km"]
        table.add_row(
            row["name"],
            _point(row["origin_km"]),
            _point(row["target_km"]),
            *(f"{row[key]:.2f}" for key in ("straight_km", "planned_km")),
            "-" if flown is None else f"{flown:.2f}",
            *(f"{row[key]:.2f}" for key in ("hybrid_f_km", "skein_f_km")),
        )
    return table


def method_table(result: dict[str, Any]) -> Table:
    """How the methods compare."""
    seeds = len(result["seeds"])
    table = _table(
        f"{result['scenario']}: sum of f over all UAVs, km, {seeds} seeds",
        ["method", "iter.", "eval.", "lower\nquartile", "\nmedian", "upper\nquartile", "hybrid is\nbetter in"],
    )
    for method in result["methods"]:
        iterations = method["iterations"]
        hybrid = method["method"] == "hybrid"
        table.add_row(
            method["method"],
            "-" if iterations is None else str(iterations),
            str(method["evaluations"]),
            *("none" if value is None else f"{value:.2f}" for value in method["total_km"]),
            "-" if hybrid else f"{method['seeds_hybrid_is_better']} of {seeds}",
        )
    return table


def _point(values: list[float]) -> str:
    return ",".join(f"{round(value, 3):g}" for value in values)


def _table(title: str, headings: list[str]) -> Table:
    table = Table(title=title, title_justify="left")
    for i, heading in enumerate(headings):
        table.add_column(heading, justify="left" if i == 0 else "right")
    return table
