"""The table that a campaign prints."""

from collections.abc import Sequence

from rich.markup import escape
from rich.table import Table

from gcs.campaign.campaign import Campaign
from gcs.campaign.summary import Setting


def campaign_table(campaign: Campaign, settings: Sequence[Setting]) -> Table:
    """Every combination of the axes' values, a row each; an axis with one value is in the title."""
    fixed = {key: values for key, values in campaign.axes.items() if len(values) == 1}
    varied = [key for key in campaign.axes if key not in fixed]
    title = ", ".join(
        [
            f"Campaign of {campaign.scenario.name}",
            f"seeds {campaign.seeds[0]} to {campaign.seeds[-1]}",
            *(f"{key} {values[0]}" for key, values in fixed.items()),
        ]
    )
    caption = "RMS formation error: median, 95 % and largest; largest spread of arrivals; least distances"
    table = Table(title=escape(title), caption=caption, title_justify="left", caption_justify="left")
    for heading in varied:
        table.add_column(escape(heading.rpartition(".")[2]), overflow="fold", max_width=28)
    for heading in ("flights", "median m", "95 % m", "max m", "spread s", "separation m", "ground m", "incomplete"):
        table.add_column(heading, justify="right")
    for setting in settings:
        errors = setting.rms_error_m or (None, None, None)
        table.add_row(
            *(escape(setting.values[key]) for key in varied),
            str(setting.flights),
            *(_shown(error, ".2f") for error in errors),
            _shown(setting.arrival_spread_s, ".2f"),
            _shown(setting.min_separation_m, ".0f"),
            _shown(setting.min_clearance_m, ".0f"),
            f"[red]{setting.incomplete}[/red]" if setting.incomplete else "0",
        )
    return table


def _shown(value: float | None, form: str) -> str:
    return "-" if value is None else format(value, form)
