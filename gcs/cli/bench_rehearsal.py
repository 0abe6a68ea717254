"""`skein bench --rehearsal`: how fast nine aircraft are rehearsed, beside the flight of their endpoints."""

from dataclasses import asdict

from rich.table import Table

from gcs.cli.errors import FELL_SHORT

SCENARIO = "radars"
RUNS, QUICK_RUNS = 20, 3


def bench_rehearsal(quick: bool, json: bool) -> None:
    """Measure and print; exit with 1 if the two did not fly the same."""
    from gcs.bench.rehearsal_speed import measure_rehearsal
    from gcs.cli import output
    from gcs.cli.planning import search_with_progress
    from gcs.cli.progress import working
    from missions.scenario import load_scenario

    scenario = load_scenario(SCENARIO)
    plan = search_with_progress(scenario, None, None)
    with working("Rehearsing and flying", brief=True):
        speed = measure_rehearsal(scenario, plan, QUICK_RUNS if quick else RUNS, output.progress.print)
    if json:
        output.print_json(asdict(speed))
    else:
        table = Table("what", "figure", title=f"{speed.scenario}: {speed.vehicles} aircraft", title_justify="left")
        table.add_row("simulated", f"{speed.rehearsal_sim_s:.0f} s")
        table.add_row("rehearsed on one core, best", f"{speed.rehearsal_cpu_s:.3f} s of CPU")
        table.add_row("rehearsed on one core, median", f"{speed.rehearsal_median_cpu_s:.3f} s of CPU")
        table.add_row("rehearsal, times real time", f"{speed.rehearsal_factor:.0f}")
        table.add_row("flown by endpoints on all cores", f"{speed.flight_wall_s:.1f} s")
        table.add_row("endpoints, times real time", f"{speed.flight_factor:.0f}")
        table.add_row("times as fast", f"{speed.rehearsal_factor / speed.flight_factor:.0f}")
        table.add_row("compiled, or read from the cache", f"{speed.compile_s:.1f} s")
        table.add_row("the same trajectories, bit for bit", "yes" if speed.same_trajectory else "[red]no[/red]")
        output.print_wide(table)
    if not speed.same_trajectory:
        raise SystemExit(FELL_SHORT)
