"""The recipe of the container: the same Python and pins as everywhere, nothing but the project."""

import json
import re
from pathlib import Path

import yaml

ROOT = Path(__file__).resolve().parents[1]
RECIPE = (ROOT / "workflow/envs/Containerfile").read_text()


def test_it_has_the_python_of_the_other_environments():
    conda = yaml.safe_load((ROOT / "workflow/envs/pinned.yaml").read_text())
    (python,) = [str(word) for word in conda["dependencies"] if str(word).startswith("python ")]
    (base,) = re.findall(r"^ARG BASE=\S+/python:([\d.]+)-slim-\w+$", RECIPE, re.MULTILINE)
    assert python == f"python ={base}" and "FROM ${BASE}" in RECIPE


def test_it_installs_the_pins_and_nothing_else():
    assert "COPY environment.txt /project/environment.txt" in RECIPE
    assert re.findall(r"pip install (.*)", RECIPE) == ["--no-cache-dir -r /project/environment.txt"]


def test_it_starts_snakemake_with_results_in_the_mounted_folder():
    (words,) = re.findall(r"^ENTRYPOINT (\[.*\])$", RECIPE, re.MULTILINE)
    assert json.loads(words)[1:] == ["-m", "snakemake", "--directory", "/out"]
    assert '-v "$PWD/out:/out"' in (ROOT / "docs/cluster.md").read_text()


def test_no_results_and_no_history_go_into_it():
    left_out = (ROOT / ".dockerignore").read_text().split()
    assert {".git", ".snakemake", ".venv", "results"} <= set(left_out)
