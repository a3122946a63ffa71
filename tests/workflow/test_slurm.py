"""The profile for Slurm: its plugin takes it, and jobs ask for what they take."""

import re

import pytest
import yaml
from helpers import ROOT, package, planned, run_ready
from pendula.configuration.cases import PaperCaseSection
from pendula.configuration.cost import estimate
from pendula.workflow.slurm_requests import requests_above_limits

PROFILE = yaml.safe_load((ROOT / "profiles/slurm/profile.yaml").read_text())
THIS_MACHINE = {"cores", "scheduler", "executor", "forked-modules"}
"""What profiles/default says of the jobs of one machine: a cluster has a queue of its own."""


def test_the_plugin_plans_the_same_jobs_as_a_run_on_one_machine(tmp_path):
    package("snakemake_executor_plugin_slurm", "-r profiles/slurm/requirements.txt")
    by_slurm = planned(ROOT, tmp_path, "--workflow-profile", str(ROOT / "profiles/slurm"))
    assert by_slurm == planned(ROOT, tmp_path)


def test_each_job_is_planned_in_its_allocation_as_it_was_outside():
    """A group is planned again inside of its job, where it may ask for more than Slurm gave."""
    assert PROFILE["cores"] == 1
    assert not {"groups", "group-components", "resources"} & PROFILE.keys()
    rules = "".join(path.read_text() for path in (ROOT / "workflow/rules").glob("*.smk"))
    assert not re.search(r"^\s+group:", rules, re.MULTILINE)


def test_what_fails_for_a_reason_is_not_tried_twice_but_what_lost_its_node_is():
    assert PROFILE["restart-times"] == 0 and PROFILE["slurm-requeue"] is True
    assert PROFILE["slurm-status-command"] == "squeue"  # which tells who was cancelled


PLANNED = """
include: "{project}/Snakefile"
for case in ("short", "long"):
    cost = resources_for(lambda wildcards: SETTINGS.cost_of(wildcards))
    print("asks", *(cost[name](case, attempt) for attempt in (1, 2) for name in cost))
for rule in ("trajectory", "trajectory_by_solver", "sweep", "sweep_by_second_solver", "own_checks"):
    print("of", rule, *sorted({{"mem_mb", "runtime"}} & set(workflow.get_rule(rule).resources)))
def tell():
    for job in workflow.dag.jobs:
        print("plans", job.rule.name, job.resources.mem_mb, job.resources.runtime)
atexit.register(tell)
"""
CASES = {
    "short": {"omega": 8, "end_time": 2},
    "long": {"omega": 8, "end_time": 20000, "half_width": 9000, "snapshot_step": 20},
}


@pytest.fixture(scope="module")
def plan(tmp_path_factory) -> str:
    """Return what a dry run says of its requests, some of them set by the user for a rule.

    This is a plan: .ci/slurm shows that Slurm gets such requests. Where a profile has such a
    setting too, Snakemake takes that of the command line alone.
    """
    folder = tmp_path_factory.mktemp("plan")
    (folder / "Snakefile").write_text(PLANNED.format(project=ROOT))
    (folder / "mine.yaml").write_text(yaml.safe_dump({"cases": CASES}))
    (folder / "slurm").mkdir()
    profile = {key: value for key, value in PROFILE.items() if "slurm" not in f"{key} {value}"}
    (folder / "slurm/profile.yaml").write_text(yaml.safe_dump(profile))
    command = ["", "-m", "snakemake", "--dry-run", "--workflow-profile", "slurm"]
    wish = ["--set-resources", "trajectory:mem_mb=4000", "map_fates:runtime=300"]
    targets = ["results/trajectories/fig4_small.nc", "fates", "sensitivity"]
    output = run_ready([*command, *wish, "--configfile", "mine.yaml", "--", *targets], folder)
    assert output.returncode == 0, output.stderr
    return output.stdout + output.stderr


def test_a_run_asks_for_what_it_is_estimated_to_take_and_for_more_when_tried_again(plan):
    lines = re.findall(r"(?m)^asks (\d+) (\d+) (\d+) (\d+)$", plan)
    short, long = (tuple(map(int, line)) for line in lines)
    assert short == (1001, 16, 2002, 32)
    cost = estimate(PaperCaseSection(**CASES["long"]).shown_problem())
    assert long[0] > 1e-6 * cost.memory + 300 and long[1] > 3 * cost.seconds / 60 > 20
    assert long[2:] == (2 * long[0], 2 * long[1])
    assert len(re.findall(r"(?m)^of \w+ mem_mb runtime$", plan)) == 5


def test_what_the_user_sets_for_a_rule_wins_and_leaves_others_as_they_were(plan):
    for asked in ("trajectory 4000 16", "map_fates 1000 300", "measure_sensitivity 1000 75"):
        assert f"\nplans {asked}\n" in plan


SINFO = "short*|2:00:00\nlong|2-00:00:30\nfree|infinite\nshort*|2:00:00\nbrief|30:00\n"
"""As sinfo lists four partitions, one in two rows since its nodes differ."""


@pytest.mark.parametrize(
    ("partitions", "minutes", "limit"),
    [
        *((None, 120, None), (None, 121, 120), ("short", 200, 120), ("long", 2880, None)),
        *(("long", 2881, 2880.5), ("free", 1e6, None), ("brief", 31, 30), (None, None, None)),
        *(("brief,short", 31, None), ("brief,short", 121, 120), ("unknown", 9999, None)),
    ],
)
def test_a_request_above_the_limit_of_its_partitions_is_told(partitions, minutes, limit):
    """Slurm would let such a job wait for ever, and Snakemake for the job."""
    requests = [("fates", partitions, 1), ("fates", partitions, minutes)]
    reasons = requests_above_limits(requests, SINFO)
    assert len(reasons) == (limit is not None)
    if reasons:
        assert f"fates requests {minutes} minutes" in reasons[0]
        assert f"allows only {limit:g}, so the job would never start" in reasons[0]
        assert f"Slurm's {partitions or 'default'} partition" in reasons[0]
    assert requests_above_limits(requests, "") == []  # where sinfo prints nothing


def test_the_lines_that_a_user_uncomments_leave_a_profile():
    text = (ROOT / "profiles/slurm/profile.yaml").read_text()
    chosen = yaml.safe_load(text.replace("  # slurm_", "  slurm_"))["default-resources"]
    assert chosen == {
        **PROFILE["default-resources"],
        "slurm_account": "'...'",
        "slurm_partition": "'...'",
    }


def test_the_profile_reruns_what_the_default_profile_does():
    default = yaml.safe_load((ROOT / "profiles/default/profile.yaml").read_text())
    assert all(PROFILE[key] == default[key] for key in default.keys() - THIS_MACHINE)


def test_the_plugin_is_pinned_and_no_part_of_the_environment():
    pins = (ROOT / "profiles/slurm/requirements.txt").read_text().splitlines()
    names = [pin.split("==")[0] for pin in pins if not pin.startswith("#")]
    assert all("==" in pin for pin in pins if not pin.startswith("#"))
    assert not any(name in (ROOT / "environment.txt").read_text() for name in names)
