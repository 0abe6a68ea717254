"""Pictures on light paper and on dark: vehicles have the same colours on both, and all can be read."""

from pathlib import Path

import pytest
from matplotlib.colors import to_rgb
from PIL import Image

from gcs.figures import style
from gcs.theme import DARK, LIGHT, Theme, drawn_dark, theme


def contrast(one: str, other: str) -> float:
    """WCAG 2's contrast ratio of two colours."""

    def luminance(colour: str) -> float:
        linear = [c / 12.92 if c <= 0.03928 else ((c + 0.055) / 1.055) ** 2.4 for c in to_rgb(colour)]
        return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]

    darker, lighter = sorted((luminance(one), luminance(other)))
    return (lighter + 0.05) / (darker + 0.05)


@pytest.mark.parametrize("now", [LIGHT, DARK])
def test_text_and_lines_stand_out_from_the_paper(now: Theme) -> None:
    assert contrast(now.ink, now.paper) > 12.0
    assert contrast(now.faint, now.paper) > 3.0
    for colour in (*style.VEHICLES, style.DANGER, style.RADAR):
        assert contrast(colour, now.paper) > 2.1, colour
    if now is DARK:
        assert min(contrast(colour, now.paper) for colour in style.VEHICLES) > 3.0


def test_dark_holds_within_its_block_alone(tmp_path: Path) -> None:
    papers = []
    for dark in (True, False):
        with drawn_dark(dark), style.page(tmp_path / "page.png", 2.0) as figure:
            axes = figure.subplots()
            axes.set_xlabel("time (s)")
        papers.append(Image.open(tmp_path / "page.png").convert("RGB").getpixel((3, 3)))
        assert theme() is LIGHT
    assert papers == [tuple(round(255 * part) for part in to_rgb(now.paper)) for now in (DARK, LIGHT)]
