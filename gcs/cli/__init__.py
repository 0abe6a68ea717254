"""The command line: one command a file, imported when it is used, and its heavy packages inside it: help is quick."""

from typing import Annotated

import typer

from gcs.cli.later import Entry, LaterGroup
from gcs.cli.verbosity import Commands, VerboseOption, show_version, start_saying


class Skein(LaterGroup):
    """All commands, in the order in which help lists them."""

    entries = {  # noqa: RUF012 (never changed)
        "demo": Entry("demo:demo", "Plan, upload, fly and report, on simulated vehicles."),
        "plan": Entry("plan:plan", "Plan a path for every vehicle of a scenario and write a run."),
        "sim": Entry("sim:sim", "Leave a swarm running for any ground station."),
        "router": Entry("router:router", "Run the router of a swarm on several machines, until Ctrl-C."),
        "fly": Entry("fly:fly", "Fly a planned run, simulated or on vehicles that are there."),
        "rehearse": Entry("rehearse:rehearse", "Fly a plan in this process, thousands of times real time."),
        "report": Entry("report:report", "Write a flown run as one HTML page that needs no network."),
        "console": Entry("console:console", "Show a swarm in the browser, as it flies or as it flew, and steer it."),
        "export": Entry("export:export", "Write missions as files for autopilots, stations and maps."),
        "check": Entry("check:check", "Check mission files, each alone and all flown at once."),
        "replay": Entry("replay:replay", "Play telemetry logs back to any ground station."),
        "bench": Entry("bench:bench", "Compare searches, stations and speeds with their peers."),
        "margin": Entry("margin:margin", "Say how late corrections may come, and which gains suit."),
        "reproduce": Entry("reproduce:reproduce", "Make the paper's figures 4 to 12 and tables 3 and 6 again."),
        "schema": Entry("schema:schema", "Print the JSON Schema of scenario files, for editors."),
        "upload": Entry("upload:upload", "Upload missions, read each back and compare."),
        "download": Entry("download:download", "Download missions, fences and rally points."),
        "clear": Entry("clear:clear", "Clear missions, fences or rally points."),
        "arm": Entry("orders:arm", "Arm; a refusal comes with the vehicle's reason."),
        "disarm": Entry("orders:disarm", "Disarm; in flight only with --force."),
        "mode": Entry("orders:mode", "Change the flight mode, and see it in the vehicle's heartbeats."),
        "rtl": Entry("orders:rtl", "Return to launch: mode RTL, seen in the vehicle's heartbeats."),
        "abort": Entry("orders:abort", "Bring every vehicle home and confirm each."),
        "status": Entry("status:status", "Say what each vehicle does."),
        "companion": Entry("companion:companion", "Keep one vehicle with its neighbours, from beside it."),
        "import": Entry("import_files:import_files", "Read mission files of other ground stations."),
        "params": Entry("params:params", "Read, change, save and load parameters."),
        "signing": Entry("signing:signing", "Make a signing key, give it to vehicles, take it away."),
        "study": Entry("study:study", "Study the formation law over many flights."),
    }


app = Commands(
    name="skein",
    cls=Skein,
    no_args_is_help=True,
    add_completion=True,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
)
VersionOption = Annotated[
    bool, typer.Option("--version", callback=show_version, is_eager=True, help="Print versions, and end.")
]


@app.callback()
def skein(verbose: VerboseOption = 0, version: VersionOption = False) -> None:
    """Plan, upload and fly formation missions for fixed-wing aircraft over MAVLink."""
    start_saying(verbose)
