"""The table of vehicles, as HTML."""

import re

from gcs.console.moment import Row
from gcs.console.vehicle_table import HEADINGS, table_html

FULL = Row(3, "left", "AUTO", (4, 9), 21.96, 1499.6, -1.26, "0.20 s")


def cells(html: str) -> list[list[str]]:
    """Text of each cell of each vehicle's row."""
    rows = re.findall(r"<tr class=.*?</tr>", html)
    return [[re.sub("<.*?>", "", cell) for cell in re.findall(r"<td.*?</td>", row)] for row in rows]


def test_a_row_says_all_that_is_known_of_a_vehicle_rounded_for_people() -> None:
    assert cells(table_html([FULL], lambda _: "#123456", None)) == [
        ["3 left", "AUTO", "4/9", "22.0", "1500", "-1.3", "0.20 s"]
    ]


def test_what_is_not_known_is_left_empty() -> None:
    (row,) = cells(table_html([Row(7, "", "")], lambda _: "red", None))
    assert row == ["7 ", *[""] * (len(HEADINGS) - 1)]
    (row,) = cells(table_html([Row(7, "", "AUTO", item=(2, None))], lambda _: "red", None))
    assert row[2] == "2"


def test_what_vehicles_are_called_is_never_markup() -> None:
    evil = "<script>alert('&')</script>"
    html = table_html([Row(1, evil, evil, link=evil)], lambda _: "red", None)
    assert "<script>" not in html
    assert html.count("&lt;script&gt;alert(&#x27;&amp;&#x27;)&lt;/script&gt;") == 3


def test_each_has_its_colour_and_the_chosen_one_stands_out() -> None:
    rows = [Row(sysid, "", "AUTO") for sysid in (1, 2)]
    html = table_html(rows, {1: "red", 2: (0.0, 0.0, 1.0)}.__getitem__, 2)
    assert re.findall(r"background:(#\w+)", html) == ["#ff0000", "#0000ff"]
    assert re.findall(r'<tr class="(\w*)" data-sysid="(\d)">', html) == [("", "1"), ("chosen", "2")]


def test_who_needs_attention_is_marked() -> None:
    html = table_html([Row(1, "", "AUTO"), Row(2, "", "lost", well=False)], lambda _: "red", None)
    assert re.findall(r'<td class="ill">(\w+)</td>', html) == ["lost"]
