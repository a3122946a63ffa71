"""What GitHub runs: on every push and pull request the tests, and each week every Python."""

import os
import re

import pytest
import yaml
from helpers import ROOT

WORKFLOWS = {
    path.stem: yaml.load(path.read_text(), yaml.BaseLoader)  # in which `on` is a word
    for path in (ROOT / ".github/workflows").glob("*.yml")
}


def steps_of(name: str) -> list[dict]:
    return [step for job in WORKFLOWS[name]["jobs"].values() for step in job["steps"]]


@pytest.mark.parametrize(("name", "command"), [("tests", ".ci/run"), ("figures", ".ci/figures")])
def test_a_push_and_a_pull_request_run_the_tests_and_the_figures(name, command):
    assert WORKFLOWS[name]["on"].keys() >= {"push", "pull_request"}
    assert command in [step.get("run") for step in steps_of(name)]
    assert os.access(ROOT / command, os.X_OK)


@pytest.mark.parametrize("name", WORKFLOWS)
def test_a_workflow_only_reads_and_takes_actions_by_their_hashes(name):
    assert WORKFLOWS[name]["permissions"] == {"contents": "read"}
    used = [step["uses"] for step in steps_of(name) if "uses" in step]
    assert used and all(re.fullmatch(r"[\w/-]+@[0-9a-f]{40}", line) for line in used)


def test_versions_runs_on_every_python_that_it_installs():
    (installed,) = [
        step["with"]["python-version"].split()
        for step in steps_of("versions")
        if "setup-python" in step.get("uses", "")
    ]
    loop = re.search(r"for each in (.*3\.11 pinned.*); do", (ROOT / ".ci/elsewhere").read_text())[1]
    assert set(re.findall(r'"(3\.\d+) ', loop)) == set(installed) >= {"3.11", "3.14", "3.15"}
    assert installed[-1] == "3.11"  # which is `python3`
