"""-v: more of what happens, on standard error, of `skein` and of each of its commands; and --version.

Modules log to loggers of their own names; without -v nobody listens, and nothing is formatted.
"""

import functools
import inspect
from collections.abc import Callable
from typing import TYPE_CHECKING, Annotated, Any, TypeVar

import typer

if TYPE_CHECKING:
    import logging

Function = TypeVar("Function", bound=Callable[..., Any])

FLOORS = ("gcs", "planner", "sitl", "missions")
"""Whose loggers are heard; those of other packages are of no use to operators."""

VerboseOption = Annotated[
    int,
    typer.Option(
        "--verbose",
        "-v",
        count=True,
        show_default=False,
        metavar="",
        help="Say more on standard error: files, versions, links, transfers, timings; -vv for each step of them.",
    ),
]


class Commands(typer.Typer):
    """Commands that take -v, each of them, with help in plain text: richer help takes three times as long to come."""

    def __init__(self, *, add_completion: bool = False, **options: Any) -> None:
        super().__init__(add_completion=add_completion, rich_markup_mode=None, **options)

    def command(self, name: str | None = None, **options: Any) -> Callable[[Function], Function]:
        """As of typer.Typer."""
        register = super().command(name, **options)

        def decorate(function: Function) -> Function:
            register(_with_verbosity(function))
            return function

        return decorate


def _with_verbosity(command: Callable[..., Any]) -> Callable[..., Any]:
    """A command with one option more."""

    @functools.wraps(command)
    def verbosely(*args: Any, verbose: int, **options: Any) -> Any:
        say_more(verbose)
        return command(*args, **options)

    mine = inspect.Parameter("verbose", inspect.Parameter.KEYWORD_ONLY, default=0, annotation=VerboseOption)
    signature = inspect.signature(command)
    verbosely.__signature__ = signature.replace(parameters=[*signature.parameters.values(), mine])  # type: ignore[attr-defined]
    verbosely.__annotations__ = {**command.__annotations__, "verbose": VerboseOption}
    return verbosely


_verbosity = 0


def start_saying(count: int) -> None:
    """Begin a command line with so many -v before the command."""
    global _verbosity
    if _verbosity:  # another command line in this process
        _listen_with(None, 0)
    _verbosity = 0
    say_more(count)


def say_more(count: int) -> None:
    """So many more -v: with one in all progress is logged on standard error, with two details as well."""
    global _verbosity
    first = _verbosity == 0
    _verbosity += count
    if count:
        _listen(first)


def is_verbose() -> bool:
    """Whether -v was given."""
    return _verbosity > 0


def _listen(first: bool) -> None:
    import logging
    import platform

    from gcs.cli import output
    from gcs.versions import versions

    class Teller(logging.Handler):
        """Prints beside whatever moves on the console."""

        def emit(self, record: logging.LogRecord) -> None:
            output.progress.print(self.format(record), style="dim", markup=False, soft_wrap=True)

    teller = Teller()
    teller.setFormatter(logging.Formatter("%(asctime)s.%(msecs)03d %(name)s: %(message)s", "%H:%M:%S"))
    _listen_with(teller, logging.INFO if _verbosity == 1 else logging.DEBUG)
    if first:
        named = ", ".join(f"{name} {number}" for name, number in versions().items())
        logging.getLogger(__name__).info("%s; %s", named, platform.platform())


def _listen_with(handler: "logging.Handler | None", level: int) -> None:
    import logging

    for floor in FLOORS:
        logger = logging.getLogger(floor)
        logger.setLevel(level)
        logger.handlers = [] if handler is None else [handler]


def show_version(wanted: bool) -> None:
    """Print the versions that matter, and end, when that is wanted."""
    if wanted:
        from gcs.versions import versions

        for name, number in versions().items():
            typer.echo(f"{name} {number}")
        raise typer.Exit
