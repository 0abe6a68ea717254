"""A campaign's folder: a run that was planned, with what was flown of it beside.

DIR/{scenario.toml, plan.json, missions/, campaign.json, runs.csv, figures/}
"""

import json
from pathlib import Path

from gcs.campaign.campaign import Campaign
from gcs.run_folder import RunFolder, make_run_folder
from missions.errors import InputError

IDENTITY = "campaign.json"


def campaign_folder(out: Path | None, name: str) -> RunFolder:
    """The folder of a campaign that was begun before, or a new one.

    Raises:
        InputError: it cannot be made, or holds something else.
    """
    if out is not None and (out / IDENTITY).is_file():
        return RunFolder(out)
    return make_run_folder(out, name)


def claim(run: RunFolder, campaign: Campaign, scenario_text: str) -> Path:
    """Keep scenario, plan and identity of a campaign in its folder; returns where its table is.

    Raises:
        InputError: the folder is another campaign's, or cannot be written to.
    """
    file = run.path / IDENTITY
    mine = campaign.identity()
    if file.is_file():
        try:
            theirs = json.loads(file.read_text(encoding="utf-8"))
            different = [key for key in mine if theirs.get(key) != mine[key]]
        except (OSError, ValueError, AttributeError) as error:
            raise InputError(f"{file}: cannot be read: {error}; name a new folder with --out") from None
        for key in different:
            raise InputError(
                f"{run.path}: its rows are of another campaign: {key} is {_short(mine[key])} here and "
                f"{_short(theirs.get(key))} there; name a new folder with --out"
            )
    else:
        run.write_json(IDENTITY, mine)
    run.write_plan(scenario_text, campaign.scenario, campaign.plan)
    try:
        run.figures.mkdir(exist_ok=True)
    except OSError as error:
        raise InputError(f"{run.figures}: {error.strerror}") from None
    return run.path / "runs.csv"


def _short(value: object) -> str:
    return ", ".join(value) or "none" if isinstance(value, list) else str(value)[:12]
