"""Help is quick, since commands are imported when they are used; and says what they say."""

import subprocess
import sys
from collections.abc import Callable

import pytest
import typer
from typer.testing import Result

from gcs.cli import Skein, app

Run = Callable[..., Result]


def test_help_imports_no_command() -> None:
    program = (
        "import sys; from gcs.cli import app\n"
        "try: app(['--help'])\n"
        "except SystemExit: pass\n"
        "print(sorted(name for name in sys.modules if name.startswith(('gcs.', 'numpy', 'asyncio', 'missions'))))"
    )
    result = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True, timeout=60)
    assert result.stdout.splitlines()[-1] == "['gcs.cli', 'gcs.cli.later', 'gcs.cli.verbosity']"


@pytest.mark.parametrize("name", Skein.entries)
def test_the_list_says_of_a_command_what_its_own_help_begins_with(name: str, skein: Run) -> None:
    told = skein(name, "--help")
    assert told.exit_code == 0
    assert told.stdout.startswith(f"Usage: skein {name} ")
    words = " ".join(told.stdout.split())
    assert Skein.entries[name].summary in words


@pytest.mark.parametrize("name", Skein.entries)
def test_every_command_has_an_example_and_takes_v_and_json(name: str, skein: Run) -> None:
    group = typer.main.get_command(app)
    context = group.commands[name].make_context(name, [], resilient_parsing=True)  # type: ignore[attr-defined]
    within = getattr(context.command, "commands", {name: context.command})
    for one in within.values():
        options = [option for parameter in one.params for option in parameter.opts]
        assert "--verbose" in options
        if name not in ("schema", "console"):  # prints JSON as it is; is for a browser
            assert "--json" in options
        assert "Example: skein " in one.help


def test_a_command_misspelt_is_told_its_name(skein: Run) -> None:
    result = skein("rehearze")
    assert result.exit_code == 2
    assert "Did you mean 'rehearse'?" in result.stderr
