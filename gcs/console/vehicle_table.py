"""The table of vehicles, as HTML of the page."""

from collections.abc import Callable, Sequence
from html import escape
from typing import Any

from matplotlib.colors import to_hex

from gcs.console.moment import Row

HEADINGS = ("vehicle", "mode", "item", "m/s", "AMSL m", "error m", "link")
STYLE = (
    "<style>.skein{width:100%;border-collapse:collapse;font-size:11px;font-variant-numeric:tabular-nums}"
    ".skein th{font-weight:600;text-align:right;padding:2px 4px;opacity:.75;white-space:nowrap}"
    ".skein td{text-align:right;padding:2px 4px;white-space:nowrap;border-top:1px solid rgba(128,128,128,.25)}"
    ".skein :is(th,td):nth-child(-n+2){text-align:left}"
    ".skein tr.chosen td{background:rgba(128,128,128,.22)}.skein td.ill{color:#d6453d;font-weight:600}"
    ".skein-all{max-height:330px;overflow-y:auto}.skein thead th{position:sticky;top:0;background:inherit}"
    ".skein td:last-child{max-width:76px;overflow:hidden;text-overflow:ellipsis}"
    ".skein i{display:inline-block;width:9px;height:9px;border-radius:5px;margin-right:5px}</style>"
)


def table_html(rows: Sequence[Row], colour_of: Callable[[int], Any], selected: int | None) -> str:
    """The table.

    Args:
        rows: a vehicle each.
        colour_of: a vehicle's colour, as matplotlib has it.
        selected: the vehicle whose row stands out.
    """
    head = "".join(f"<th>{heading}</th>" for heading in HEADINGS)
    body = "".join(_row(row, to_hex(colour_of(row.sysid)), row.sysid == selected) for row in rows)
    table = f'<table class="skein"><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>'
    return f'{STYLE}<div class="skein-all">{table}</div>'


def _row(row: Row, colour: str, selected: bool) -> str:
    mark = "" if row.well else ' class="ill"'
    cells = (
        f'<td><i style="background:{colour}"></i>{row.sysid} {escape(row.name)}</td>',
        f"<td{mark}>{escape(row.mode)}</td>",
        f"<td>{_item(row)}</td>",
        f"<td>{_number(row.speed_m_s, 1)}</td>",
        f"<td>{_number(row.altitude_m, 0)}</td>",
        f"<td>{_number(row.error_m, 1)}</td>",
        f"<td>{escape(row.link)}</td>",
    )
    return f'<tr class="{"chosen" if selected else ""}" data-sysid="{row.sysid}">{"".join(cells)}</tr>'


def _item(row: Row) -> str:
    if row.item is None:
        return ""
    current, last = row.item
    return str(current) if last is None else f"{current}/{last}"


def _number(value: float | None, decimals: int) -> str:
    return "" if value is None else f"{value:.{decimals}f}"
