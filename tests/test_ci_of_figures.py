"""CI makes the figures as the README says, by actions that cannot change under it."""

import re
from pathlib import Path

import yaml

ROOT = Path(__file__).resolve().parents[1]


def test_ci_finds_the_run_command_of_the_readme():
    text = (ROOT / "README.md").read_text()
    (block,) = re.findall(r"<!-- run command -->\n```\n(.*?)\n```", text)
    assert block.startswith("python3 -m venv") and block.endswith("&& snakemake")
    script = (ROOT / ".ci/figures").read_text()
    assert "<!-- run command -->" in script and "snakemake figure_diff" in script


def test_the_workflow_runs_it_and_keeps_the_page():
    workflow = yaml.safe_load((ROOT / ".github/workflows/figures.yml").read_text())
    steps = workflow["jobs"]["figures"]["steps"]
    assert any(step.get("run") == ".ci/figures" for step in steps)
    assert steps[-1]["if"] == "always()" and "results/figure_diff" in steps[-1]["with"]["path"]
    used = [step["uses"] for step in steps if "uses" in step]
    assert all(re.fullmatch(r"actions/[\w-]+@[0-9a-f]{40}", action) for action in used)


def test_the_baseline_is_small_and_holds_the_pictures_of_the_readme():
    files = [path for path in (ROOT / "tests/baseline").rglob("*") if path.is_file()]
    compared = [path for path in files if path.parent.name not in ("reference", "proofs")]
    assert sum(path.stat().st_size for path in compared) < 27e6
    assert all(path.stat().st_size < 1.1e6 for path in compared)
