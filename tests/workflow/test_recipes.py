"""The steps of ARCHITECTURE.md to add a claim and a figure, played as they are written."""

import json
import re
from pathlib import Path
from textwrap import dedent

import pytest
from helpers import ROOT, edit, planned, snakemake

PAGE = (ROOT / "ARCHITECTURE.md").read_text(encoding="utf-8")
BLOCK = re.compile(r"^( *)```\w*\n(?P<text> *# (?P<path>\S+\.\w+)\n.*?)^\1```$", re.M | re.S)
"""A block whose first line names the file in which it belongs."""
FILES = {match["path"]: dedent(match["text"]) for match in BLOCK.finditer(PAGE)}


def add(clone: Path, path: str) -> None:
    """Write a block into its file, behind what is there already."""
    file = clone / path
    before = file.read_text() if file.exists() else ""
    file.write_text(f"{before}\n\n{FILES[path].partition(chr(10))[2]}")


def test_the_page_has_a_block_for_each_file_of_both_recipes():
    assert FILES.keys() == {
        "scripts/pendula/studies/theory/claims_leading_wave.py",
        "scripts/pendula/studies/theory/excess_figure.py",
        "workflow/rules/theory.smk",
    }


def test_a_claim_in_a_new_module_is_decided(finished, clone):
    """Its datasets follow from the claim itself: no rule lists them."""
    add(clone, "scripts/pendula/studies/theory/claims_leading_wave.py")
    result = snakemake(clone, finished, "results/claims/theory.json")
    assert result.returncode == 0, result.stderr
    rows = json.loads((finished / "results/claims/theory.json").read_text())["rows"]
    (row,) = [row for row in rows if row["name"] == "threshold_is_reached"]
    assert row["verdict"] == "confirmed" and row["controls"][0]["passes"]
    assert row["decided_by"] == ["checks/threshold"]


def test_a_claim_on_a_dataset_that_no_rule_makes_is_refused(full_run, clone):
    path = "scripts/pendula/studies/theory/claims_leading_wave.py"
    add(clone, path)
    edit(clone / path, 'checks("threshold")', 'checks("treshold")')
    result = snakemake(clone, full_run, "--dry-run", "results/claims/theory.json")
    assert result.returncode == 1
    assert "results/checks/treshold.nc" in result.stdout + result.stderr


def test_a_figure_is_drawn_and_is_part_of_a_full_run(finished, clone):
    for path in ("scripts/pendula/studies/theory/excess_figure.py", "workflow/rules/theory.smk"):
        add(clone, path)
    edit(
        clone / "Snakefile",
        '    "lifetimes",\n    "fates",\n',
        '    "lifetimes",\n    "fates",\n    "excess",\n',
    )
    assert planned(clone, finished, "figures")["excess"] == 1
    result = snakemake(clone, finished, "excess")
    assert result.returncode == 0, result.stderr
    description = json.loads((finished / "results/figures/excess.json").read_text())
    assert len(description["panels"][0]["curves"]) == 2
    for kind in ("png", "pdf", "nc"):
        assert (finished / f"results/figures/excess.{kind}").stat().st_size > 0


@pytest.mark.parametrize("step", ["tests/wrong_changes.yaml", "tests/accepted_figures.py"])
def test_the_files_of_the_other_steps_are_there(step):
    assert f"`{step}`" in PAGE and (ROOT / step).exists()
