"""Each rule gives its function what this takes, and a rule that does not is refused by name."""

import json
from importlib import import_module

import pytest
from helpers import ROOT, edit, run_ready, snakemake
from pendula.contract.arguments import OF_THE_JOB, check_names

LISTED = """
import json
include: "{project}/Snakefile"
def names_of(rule):
    inputs = [name for name, _ in rule.input._allitems() if name]
    outputs = [name for name, _ in rule.output._allitems() if name]
    return inputs + outputs + list(rule.params.keys())
def call_of(rule):
    call = rule.params.call
    return call(SimpleWildcards()) if callable(call) else call
class SimpleWildcards:
    part = "theory"
rules_with_calls = [rule for rule in workflow.rules if "call" in rule.params.keys()]
table = {{rule.name: [call_of(rule)[0], rule.script, names_of(rule)] for rule in rules_with_calls}}
print("TABLE" + json.dumps(table))
"""


@pytest.fixture(scope="module")
def table(tmp_path_factory) -> dict:
    """Return by rule the function that it calls, its script, and what it gives by name."""
    folder = tmp_path_factory.mktemp("rules")
    (folder / "Snakefile").write_text(LISTED.format(project=ROOT))
    done = run_ready(["", "-m", "snakemake", "-n", "fig1", "--cores", "1"], folder)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout.partition("TABLE")[2].splitlines()[0])


def function_that_takes(call: str, script: str):
    """Return the function that takes the arguments of a rule: of a figure it gathers the data."""
    module, _, name = call.rpartition(".")
    if script.endswith("figure.py"):
        name = f"gather{name.removeprefix('draw')}"
    return getattr(import_module(module), name)


def test_each_rule_gives_its_function_all_that_it_takes_and_nothing_else(table):
    assert len(table) > 55
    for rule, (call, script, names) in table.items():
        arguments = [name for name in names if name not in OF_THE_JOB]
        check_names(function_that_takes(call, script), arguments, rule)


@pytest.mark.parametrize(
    ("rules", "old", "new", "target", "sentence"),
    [
        (
            "newton",
            "mus=REMAINDER.mus",
            "mu=REMAINDER.mus",
            "pendula/remainder.nc",
            "measure_remainder has no parameter 'mu'; did you mean 'mus'?",
        ),
        (
            "theory",
            "points=SETTINGS.points_of_cases(),",
            "points=SETTINGS.points_of_cases(),\n        colour=1,",
            "figures/stability_chart.png",
            "gather_chart has no parameter 'colour'",
        ),
    ],
)
def test_a_misspelt_parameter_of_a_dataset_and_one_that_no_figure_takes_are_refused(
    clone, full_run, tmp_path, rules, old, new, target, sentence
):
    edit(clone / f"workflow/rules/{rules}.smk", old, new)
    folder = tmp_path / "run"
    (folder / "results/checks").mkdir(parents=True)
    for kind in ("checks", "kernels"):
        (folder / "results" / kind).mkdir(parents=True, exist_ok=True)
        for path in (full_run / "results" / kind).glob("*"):
            (folder / "results" / kind / path.name).write_bytes(path.read_bytes())
    options = ("--rerun-triggers", "mtime", "--allowed-rules", *_rules_of(rules))
    result = snakemake(clone, folder, f"results/{target}", *options)
    assert result.returncode == 1
    assert sentence in result.stderr


def _rules_of(rules: str) -> tuple[str, ...]:
    return ("measure_remainder",) if rules == "newton" else ("stability_chart",)
