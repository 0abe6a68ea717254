"""`skein bench --chain`: how far a place is moved on its way from plan to file to vehicle to telemetry."""

from typing import TYPE_CHECKING

from rich.table import Table

from gcs.cli.errors import FELL_SHORT

if TYPE_CHECKING:
    from gcs.bench.position_chain import PositionChain

QUICK = ("vee",)


def bench_chain(quick: bool, json: bool) -> None:
    """Plan, write, read, fly, compare, and print; exit with 1 if the whole is off by more than it may be."""
    from gcs.bench.position_chain import measure_chain
    from gcs.cli import output
    from gcs.cli.progress import working
    from missions.scenario import load_scenario, shipped_scenarios
    from planner.plan import plan

    names, chains = QUICK if quick else shipped_scenarios(), []
    with working("Planning and flying", count=len(names)) as bar:
        for name in names:
            scenario = load_scenario(name)
            chains.append(measure_chain(scenario, plan(scenario)))
            bar.advance()
    if json:
        output.print_json({"chains": [chain.as_json() for chain in chains]})
    else:
        for chain in chains:
            output.print_wide(chain_table(chain))
    if not all(chain.holds for chain in chains):
        raise SystemExit(FELL_SHORT)


def chain_table(chain: "PositionChain") -> Table:
    """The largest error of each stage and of the whole, millimetres."""
    table = Table(title=f"{chain.scenario}: largest errors of positions", title_justify="left")
    table.add_column("stage")
    for heading in ("compared", "across mm", "up mm", "in space mm"):
        table.add_column(heading, justify="right", no_wrap=True)
    for index, stage in enumerate((*chain.stages, chain.whole)):
        errors = (stage.horizontal_m, stage.vertical_m, stage.distance_m)
        table.add_row(stage.name, f"{stage.compared}", *(f"{1e3 * error:.2f}" for error in errors))
        if index == len(chain.stages) - 1:
            table.add_section()
    return table
