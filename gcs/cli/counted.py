"""How many there are of something, in words."""


def counted(count: int, what: str) -> str:
    """A number of things: "1 item", "3 items"."""
    return f"{count} {what}" if count == 1 else f"{count} {what}s"
