"""The project agrees with itself: pins, records of code, and words that must not stand in it."""

import ast
import re
from pathlib import Path

import code_records
import pytest
import yaml
from pendula import sources
from pendula.configuration.messages import load

ROOT = Path(__file__).resolve().parents[1]


def test_the_conda_environment_has_the_same_pins():
    pins = (ROOT / "environment.txt").read_text().split()
    conda = yaml.safe_load((ROOT / "workflow/envs/pinned.yaml").read_text())
    assert conda["dependencies"][-1]["pip"] == pins
    assert all(re.fullmatch(r"[\w.-]+==[\w.]+", pin) for pin in pins)


def test_a_record_lists_the_modules_that_a_script_reaches(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    text = Path(code_records.code("trajectories/simulate_case.py")).read_text()
    files = {line.split()[1] for line in text.splitlines()}
    assert {
        "environment.txt",
        "scripts/job.py",
        "scripts/trajectories/simulate_case.py",
        "scripts/pendula/models/amplitudes.py",
        "scripts/pendula/integrators/dop853_tableau.py",
    } <= files
    assert not any("plots" in file or "parameters" in file for file in files)


def test_a_record_lists_the_templates_beside_the_modules(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    text = Path(code_records.code("report/write_report.py")).read_text()
    files = {line.split()[1] for line in text.splitlines()}
    folder = "scripts/pendula/report"
    assert {
        f"{folder}/style.css",
        f"{folder}/script.js",
        f"{folder}/templates/base.html.j2",
    } <= files
    assert not any("__pycache__" in file or file.endswith("taylor.cpp") for file in files)


def test_a_template_belongs_to_the_record_of_its_package_alone(tmp_path):
    for name in ("page", "other"):
        package = tmp_path / "scripts" / name
        (package / "templates").mkdir(parents=True)
        (package / "__init__.py").touch()
        (package / "templates" / f"{name}.j2").touch()
    modules = [tmp_path / "scripts/page/__init__.py"]
    assert sources.attached_to(modules) == [tmp_path / "scripts/page/templates/page.j2"]


def test_a_record_is_left_alone_while_nothing_changes(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    record = Path(code_records.code("paper/draw_chain.py"))
    before = record.stat().st_mtime_ns
    assert code_records.code("paper/draw_chain.py") == record.as_posix()
    assert record.stat().st_mtime_ns == before


SCRIPTS = sorted((ROOT / "scripts").glob("*/*.py"))


@pytest.mark.parametrize("path", SCRIPTS, ids=lambda path: f"{path.parent.name}/{path.name}")
def test_scripts_touch_snakemake_only_under_the_main_guard(path):
    if path.parent.name == "pendula":
        assert "snakemake." not in path.read_text()
        return
    tree = ast.parse(path.read_text())
    guard = tree.body[-1]
    inside = {id(node) for node in ast.walk(guard)}
    names = [n for n in ast.walk(tree) if isinstance(n, ast.Name) and n.id == "snakemake"]
    assert names and all(id(name) in inside for name in names)


def test_the_case_shown_in_the_documents_is_valid():
    blocks = re.findall(r"```yaml\n(.*?)```", (ROOT / "docs/own_cases.md").read_text(), re.DOTALL)
    settings = {}
    for block in blocks:
        settings |= yaml.safe_load(block)
    loaded = load(settings)
    assert loaded.problem("mine")["initial"] == {0: (2, -0.3 + 0.4j), 3: (0.5, 0)}
    assert loaded.sweeps["mine_wider"].case == "mine"


def test_ci_finds_the_test_command_of_the_readme():
    """The command stands alone between the mark and the end of its block."""
    text = (ROOT / "README.md").read_text()
    (block,) = re.findall(r"<!-- test command -->\n```\n(.*?)\n```", text)
    assert block.startswith("python3 -m venv") and block.endswith("-m pytest")
    assert "<!-- test command -->" in (ROOT / ".ci/run").read_text()
