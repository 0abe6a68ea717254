"""The colour of a link: how old the corrections are that come over it."""

Rgb = tuple[int, int, int]

FRESH: Rgb = (0, 114, 178)
LATE: Rgb = (230, 159, 0)
STALE: Rgb = (193, 39, 45)
UNKNOWN: Rgb = (150, 150, 150)
"""P. Okabe and Ito's blue and orange, and the house's red, which colour-blind readers tell apart."""


def link_colour(age_s: float | None, margin_s: float, stale_s: float) -> Rgb:
    """Blue for new corrections, orange at the delay margin, red where they count no more; grey when none has come.

    Args:
        age_s: of the newest that counts.
        margin_s: delay margin of the formation.
        stale_s: age at which one counts no more.
    """
    if age_s is None:
        return UNKNOWN
    if age_s <= margin_s:
        return _between(FRESH, LATE, age_s / margin_s if margin_s > 0.0 else 1.0)
    return _between(LATE, STALE, min(1.0, (age_s - margin_s) / max(stale_s - margin_s, 1e-9)))


def _between(one: Rgb, other: Rgb, share: float) -> Rgb:
    red, green, blue = (round((1.0 - share) * a + share * b) for a, b in zip(one, other, strict=True))
    return red, green, blue
