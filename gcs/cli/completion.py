"""What the shell completes beside options, choices and files: scenarios, runs, modes, searches."""

from importlib import resources
from pathlib import Path


def scenarios(incomplete: str) -> list[str]:
    """The scenarios that ship; the shell completes files where none of them fits."""
    folder = resources.files("missions") / "scenarios"
    names = (entry.name for entry in folder.iterdir())
    return sorted(
        name.removesuffix(".toml") for name in names if name.endswith(".toml") and name.startswith(incomplete)
    )


def runs(incomplete: str) -> list[str]:
    """Folders of planned runs that begin so, and those in a folder that begins so."""
    found = [plan.parent for depth in ("", "*/") for plan in Path().glob(f"{_literal(incomplete)}*/{depth}plan.json")]
    return sorted(map(str, found))


def sources(incomplete: str) -> list[str]:
    """Scenarios and runs."""
    return scenarios(incomplete) + runs(incomplete)


def modes(incomplete: str) -> list[str]:
    """Flight modes."""
    from sitl.modes import Mode

    return [name for name in Mode.__members__ if name.startswith(incomplete)]


def methods(incomplete: str) -> list[str]:
    """Searches that make plans."""
    return [name for name in ("skein", "pso", "qpso", "hybrid", "published") if name.startswith(incomplete)]


def _literal(text: str) -> str:
    """The text with nothing special for glob in it, and relative: what begins with a slash is left to the shell."""
    return "".join(f"[{c}]" if c in "*?[" else c for c in text).lstrip("/")
