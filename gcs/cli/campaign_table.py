"""The table that a campaign prints."""

from collections.abc import Iterator, Sequence

from rich import box
from rich.markup import escape
from rich.table import Table

from gcs.campaign.axes import labels
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
            *(f"{key} {next(iter(labels(values).values()))}" for key, values in fixed.items()),
        ]
    )
    table = Table(title=escape(title), title_justify="left", box=box.SIMPLE_HEAD, pad_edge=False, collapse_padding=True)
    short = {key: labels(values) for key, values in campaign.axes.items()}
    for heading in varied:
        table.add_column(escape(heading.rpartition(".")[2]), no_wrap=True)
    for heading in ("n", "median", "95 %", "max", "spread", "apart", "short"):
        table.add_column(heading, justify="right", no_wrap=True)
    for setting in settings:
        errors = setting.rms_error_m or (None, None, None)
        table.add_row(
            *(escape(short[key][setting.values[key]]) for key in varied),
            str(setting.flights),
            *(_shown(error, ".3g") for error in errors),
            _shown(setting.arrival_spread_s, ".3g"),
            _shown(setting.min_separation_m, ".0f"),
            f"[red]{setting.incomplete}[/red]" if setting.incomplete else "0",
        )
    return table


def legend(campaign: Campaign) -> Iterator[str]:
    """What the columns are, and a line for each value that the table only numbers."""
    yield "Of n flights: median, 95 % and largest of the RMS formation error in m; largest spread of arrivals in s;"
    yield "least separation in m; how many fell short of all vehicles' arrival."
    for key, values in campaign.axes.items():
        for text, label in labels(values).items():
            if text != label:
                yield f"{key} {label}: {text}"


def _shown(value: float | None, form: str) -> str:
    return "-" if value is None else format(value, form)
