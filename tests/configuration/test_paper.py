"""Where a configuration is not the paper's, and which datasets and claims that concerns."""

import copy
import json
import subprocess
from pathlib import Path

import keep
import pytest
from helpers import skip
from latticode.configuration.files import gather
from pendula.configuration.messages import STUDIES, load
from pendula.configuration.paper import differences, paper, reason, rests_on
from pendula.jobs.decide import all_claims
from pendula.studies.theory.checks import CHECKS
from replication.ledger.verdicts import needed

ROOT = Path(__file__).resolve().parents[2]
EDITS = {
    "omega": 1.0,
    "gamma": 0.5,
    "epsilon": 2.0,
    "boundary": "periodic",
    "initial": {"0": ["2+0j", "0.1+0j"]},
    "half_width": 20,
    "end_time": 60.0,
    "output_step": 0.05,
    "solver": {"name": "dop853", "rtol": 1e-13, "atol": 1e-13},
}
"""Another value for each key of a case that decides its solution."""


def edited(*place, value) -> dict:
    """Return the paper's configuration with one value changed."""
    configuration = copy.deepcopy(paper())
    inner = configuration
    for key in place[:-1]:
        inner = inner[key]
    inner[place[-1]] = value
    return configuration


def test_the_committed_configuration_is_the_papers():
    if subprocess.run(["git", "diff", "--quiet", "HEAD", "--", "config"], cwd=ROOT).returncode == 1:
        skip("config/*.yaml were edited", "git checkout config")
    assert keep.configuration() == paper(), "run `python docs/keep.py config` if this is meant"
    assert differences(paper()) == {}
    files = [ROOT / f"config/{name}.yaml" for name in ("config", *STUDIES)]
    configuration = json.loads(load(gather(files, {})).model_dump_json())
    assert "long" in configuration["breathers"]["fates"] and differences(configuration) == {}
    assert differences(edited("cases", "mine", value={"omega": 1.0})) == {}


@pytest.mark.parametrize("case", paper()["cases"])
@pytest.mark.parametrize("key", EDITS)
def test_whatever_rests_on_an_edited_case_is_told_apart(case, key):
    differs = differences(edited("cases", case, key, value=EDITS[key]))
    assert list(differs) == [f"cases.{case}.{key}"]
    output = reason(differs, [f"trajectories/{case}"])
    assert output.startswith(f"the configuration differs in {case}.{key} (")
    for claim in all_claims():
        own_cases = [name for name in claim.needs if name.split(".")[0] == f"trajectories/{case}"]
        direct = f"trajectories/{case}" in claim.needs or (own_cases and key != "solver")
        assert not direct or reason(differs, claim.needs, claim.on) == output, claim.name
    other_names = [
        f"trajectories/{other_name}" for other_name in paper()["cases"] if other_name != case
    ]
    assert reason(differs, other_names) == ""


@pytest.mark.parametrize(
    ("place", "value", "differs"),
    [
        (("chaos", "members", "seed"), 77, False),
        (("chaos", "members", "members"), 64, False),
        (("chaos", "members", "members"), 8, True),
        (("chaos", "members", "tolerance"), 1e-10, False),
        (("chaos", "members", "tolerance"), 1e-3, True),
        (("cases", "fig2_small", "snapshot_step"), 0.2, False),
        (("sweeps", "fig5_left", "windows"), [[10, 60]], True),
    ],
)
def test_other_draws_and_finer_ones_are_of_the_same_case(place, value, differs):
    assert bool(differences(edited(*place, value=value))) is differs


def test_every_dataset_of_the_ledger_rests_on_keys_that_are_there():
    for name in needed(all_claims()):
        assert rests_on(name) or name.partition("/")[2] in ("identities", *CHECKS), name
        for path in rests_on(name):
            inner = paper()
            for key in path.split("."):
                assert key in inner, (name, path)
                inner = inner[key]
