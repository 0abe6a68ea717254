"""The command line: one command a file. Heavy packages are imported inside the commands, so that help is quick."""

from typing import Annotated

import typer

from gcs.cli.bench import bench
from gcs.cli.check import check
from gcs.cli.clear import clear
from gcs.cli.companion import companion
from gcs.cli.demo import demo
from gcs.cli.download import download
from gcs.cli.export import export
from gcs.cli.fly import fly
from gcs.cli.import_files import import_files
from gcs.cli.margin import margin
from gcs.cli.orders import abort, arm, disarm, mode, rtl
from gcs.cli.params import params
from gcs.cli.plan import plan
from gcs.cli.rehearse import rehearse
from gcs.cli.replay import replay
from gcs.cli.report import report
from gcs.cli.reproduce import reproduce
from gcs.cli.router import router
from gcs.cli.schema import schema
from gcs.cli.signing import signing
from gcs.cli.sim import sim
from gcs.cli.status import status
from gcs.cli.study import study
from gcs.cli.upload import upload
from gcs.cli.verbosity import Commands, VerboseOption, show_version, start_saying

app = Commands(
    name="skein",
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,  # its help takes three times as long to come
    context_settings={"help_option_names": ["-h", "--help"]},
)
VersionOption = Annotated[
    bool, typer.Option("--version", callback=show_version, is_eager=True, help="Print versions, and end.")
]


@app.callback()
def skein(verbose: VerboseOption = 0, version: VersionOption = False) -> None:
    """Plan, upload and fly formation missions for fixed-wing aircraft over MAVLink."""
    start_saying(verbose)


ON_THIS_MACHINE = (
    demo,
    plan,
    sim,
    router,
    fly,
    rehearse,
    report,
    export,
    check,
    replay,
    bench,
    margin,
    reproduce,
    schema,
)
WITH_VEHICLES = (upload, download, clear, arm, disarm, mode, rtl, abort, status, companion)
for command in ON_THIS_MACHINE + WITH_VEHICLES:
    app.command()(command)
app.command("import")(import_files)
app.add_typer(params)
app.add_typer(signing)
app.add_typer(study)
