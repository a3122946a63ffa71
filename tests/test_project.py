"""The project agrees with itself: pins, records of code, and words that must not stand in it."""

import ast
import re
from pathlib import Path

import code_records
import pytest
import yaml
from pendula import sources
from pendula.studies import STUDIES

ROOT = Path(__file__).resolve().parents[1]


def test_tests_stand_in_an_empty_folder():
    """In the project's own they would read a user's results."""
    assert not list(Path.cwd().iterdir())


def test_the_conda_environment_has_the_same_pins():
    pins = (ROOT / "environment.txt").read_text().split()
    conda = yaml.safe_load((ROOT / "workflow/envs/pinned.yaml").read_text())
    assert conda["dependencies"][-1]["pip"] == pins
    assert all(re.fullmatch(r"[\w.-]+==[\w.]+", pin) for pin in pins)


ALONE = "check_certificate.py"
"""A program for strangers, who have neither the library nor Snakemake: no rule runs it."""
SCRIPTS = sorted(
    name
    for path in sources.SCRIPTS.glob("*/*.py")
    if path.parent.name != "pendula"
    and (name := path.relative_to(sources.SCRIPTS).as_posix()) != ALONE
)
"""Every script of a rule, as `folder/name.py`: base names alone repeat."""


DRAWING = [name for name in SCRIPTS if re.match("(?!own/).*/draw_", name)]
"""A sweep of one's own is checked by the job that draws it, and so depends on more."""


@pytest.fixture
def recorded(tmp_path, monkeypatch):
    """Return a function: the files that the record of a script lists, below scripts/pendula."""
    monkeypatch.chdir(tmp_path)

    def files(*script: str, of: str = "") -> set[str]:
        text = Path(code_records.code(*script, of=of)).read_text()
        return {line.split()[1].removeprefix("scripts/pendula/") for line in text.splitlines()}

    return files


def test_a_record_lists_the_modules_that_a_script_reaches(recorded):
    assert {
        *("environment.txt", "scripts/job.py", "scripts/trajectories/simulate_case.py"),
        *("__init__.py", "models/__init__.py", "models/amplitudes.py"),
        *("simulation/simulate.py", "integrators/dop853_coefficients.py"),
    } <= recorded("trajectories/simulate_case.py")


PAGES = ("drawing/", "report/", "figure_diff/", "archive/", "ledger/")


@pytest.mark.parametrize(
    "script",
    [
        *("trajectories/simulate_case.py", "trajectories/compile_solver.py"),
        *("sweeps/sweep_case.py", "reference/integrate_reference.py"),
        *("chaos/measure_lyapunov.py", "chaos/measure_ensembles.py"),
        *("unbounded/spread_case.py", "unbounded/map_windows.py", "hard_cases/run_hard_cases.py"),
    ],
)
def test_what_computes_does_not_depend_on_what_is_drawn_or_written(recorded, script):
    """Nor on the configuration's room, whose every edit would rerun the simulations."""
    files = recorded(script)
    assert not [file for file in files if file.startswith((*PAGES, "configuration/"))]
    assert not [file for file in files if file.endswith((".j2", ".css", ".js"))]


def test_what_draws_does_not_depend_on_how_it_was_integrated(recorded):
    foreign = ("integrators/", "models/", "report/", "figure_diff/", "archive/")
    files = {(script, file) for script in DRAWING for file in recorded(script)}
    assert [pair for pair in files if pair[1].startswith(foreign)] == []


def test_importing_a_package_drags_in_no_other_room():
    """What an `__init__.py` imports is in the record of every job that imports from the package."""
    packages = list(sources.SCRIPTS.glob("pendula/**/__init__.py"))
    assert len(packages) > 10
    for init in packages:
        above = {folder / "__init__.py" for folder in init.parent.parents}
        others = {path for path in sources.modules_of(init) if init.parent not in path.parents}
        assert others <= above, init


SIMULATING = ["trajectories/simulate_case.py", "sweeps/sweep_case.py"]


@pytest.mark.parametrize("script", SIMULATING)
def test_what_simulates_depends_on_the_equations_and_on_how_they_are_compiled(recorded, script):
    equations = {"models/amplitudes.py", "models/amplitudes_series.py"}
    assert equations | {"compiled.py"} <= recorded(script)


def test_what_draws_depends_on_the_style(recorded):
    assert DRAWING
    assert [name for name in DRAWING if "drawing/style.py" not in recorded(name)] == []


@pytest.mark.parametrize("script", ["theory/run_checks.py", "theory/check_observed.py"])
def test_a_check_of_the_theory_depends_on_its_equations(recorded, script):
    assert "studies/theory/equations.py" in recorded(script)


def test_a_record_lists_the_templates_beside_the_modules(recorded):
    files = recorded("report/write_report.py")
    names = ("style.css", "script.js", "templates/base.html.j2")
    assert {f"report/page/{name}" for name in names} <= files
    assert not any("__pycache__" in file or file.endswith("taylor.cpp") for file in files)


def test_a_record_lists_the_modules_that_are_found_by_the_list_of_studies(recorded):
    files = recorded("report/write_report.py", "section")
    of_studies = {file for file in files if re.match("studies/.*/section", file)}
    told = [
        one for one in STUDIES if (sources.SCRIPTS / f"pendula/studies/{one}/section.py").exists()
    ]
    names = ("section.py", "section.html.j2")
    parts = {f"studies/paper/section_{part}.py" for part in ("breathers", "solvers")}
    assert of_studies == {f"studies/{study}/{name}" for study in told for name in names} | parts


def test_a_record_may_be_of_one_study_alone(recorded):
    files = recorded("ledger/decide_claims.py", "chaos/claims", of="chaos")
    claims = {file for file in files if "/claims" in file}
    own = ("claims", "claims_own", "claims_swept")
    assert claims == {f"studies/chaos/{name}.py" for name in own}


def test_a_script_has_one_record_whoever_asks_for_it(recorded):
    recorded("ledger/decide_claims.py", "chaos/claims", of="chaos")
    recorded("ledger/decide_claims.py", "paper/claims", of="paper")
    with pytest.raises(ValueError, match="is recorded with"):
        recorded("ledger/decide_claims.py", "paper/claims", of="chaos")


def test_a_template_belongs_to_the_record_of_its_package_alone(tmp_path):
    for name in ("page", "other"):
        package = tmp_path / "scripts" / name
        (package / "templates").mkdir(parents=True)
        (package / "__init__.py").touch()
        (package / "templates" / f"{name}.j2").touch()
    modules = [tmp_path / "scripts/page/__init__.py"]
    assert sources.attached_to(modules) == [tmp_path / "scripts/page/templates/page.j2"]


def test_a_template_named_after_a_module_belongs_to_this_module_alone(tmp_path):
    names = ("__init__.py", "section.py", "compute.py", "section.html.j2", "shared.css")
    init, section, compute, template, style = paths = [tmp_path / name for name in names]
    for path in paths:
        path.touch()
    assert sources.attached_to([init, section]) == [template, style]
    assert sources.attached_to([init, compute]) == [style]


@pytest.mark.parametrize(
    "statement",
    [
        *("import pendula.drawing.style", "from pendula.drawing import style"),
        *("from pendula.drawing.style import styled", "from ..drawing import style"),
        *("from ..drawing.style import styled", "def later():\n    from ..drawing import style"),
    ],
)
def test_a_record_follows_every_kind_of_import(tmp_path, monkeypatch, statement):
    monkeypatch.setattr(sources, "SCRIPTS", tmp_path)
    here, room = tmp_path / "pendula/studies/draw.py", tmp_path / "pendula/drawing"
    room.mkdir(parents=True)
    here.parent.mkdir()
    for path in (room / "__init__.py", room / "style.py", room / "other.py"):
        path.touch()
    here.write_text(statement)
    assert sources.modules_of(here) == [room / "__init__.py", room / "style.py", here]


def imports_in(tree) -> list[str]:
    kinds = ast.Import, ast.ImportFrom
    return sorted(ast.dump(node) for node in sources._statements(tree) if isinstance(node, kinds))


def test_a_record_has_the_imports_that_python_finds():
    """Not everything is parsed, so that what is left out must hold no import."""
    modules = sources.SCRIPTS.rglob("*.py")
    texts = {module: module.read_text(encoding="utf-8") for module in modules}
    assert len(texts) > 100
    parsed = {module: ast.parse(text) for module, text in texts.items()}
    read = {module: sources._tree_of(text) for module, text in texts.items()}
    assert [one for one in texts if imports_in(read[one]) != imports_in(parsed[one])] == []
    assert sum(map(size, read.values())) < 0.2 * sum(map(size, parsed.values()))


def size(tree) -> int:
    return sum(1 for _ in sources._statements(tree))


@pytest.mark.parametrize(
    "text",
    [
        *("if a: import job", "import os; import job", "import os, \\\n    job\n"),
        *("from pendula import (\n    problem,  # why\n    compiled,\n)", "import  job"),
        *("from pendula import *", "from .  import style", "x = 1; from . import style"),
        *('"""Say import once."""\nimport job', "\timport job", "import job  # the import"),
    ],
)
def test_an_import_of_any_shape_is_found(text):
    text = f"def f():\n{text}" if text.startswith("\t") else text
    assert imports_in(sources._tree_of(text)) == imports_in(ast.parse(text)) != []


def test_a_record_is_left_alone_while_nothing_changes(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    record = Path(code_records.code("paper/draw_chain.py"))
    before = record.stat().st_mtime_ns
    assert code_records.code("paper/draw_chain.py") == record.as_posix()
    assert record.stat().st_mtime_ns == before


def test_a_call_that_only_looks_writes_its_records_elsewhere(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(code_records, "only_looks", True)
    elsewhere = Path(code_records.code("paper/draw_chain.py"))
    assert elsewhere.is_file() and not list(tmp_path.iterdir())
    monkeypatch.setattr(code_records, "only_looks", False)
    record = Path(code_records.code("paper/draw_chain.py"))
    assert record.read_text() == elsewhere.read_text()
    monkeypatch.setattr(code_records, "only_looks", True)
    assert code_records.code("paper/draw_chain.py") == record.as_posix()


def test_a_record_that_cannot_be_written_says_so_in_a_sentence(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "results").write_text("mine")
    said = []
    monkeypatch.setattr(code_records, "stop", said.append)
    code_records.code("paper/draw_chain.py")
    assert "results is a file and no folder; move it" in str(said[0])


def test_no_part_of_a_reproduction_depends_on_the_benchmarks(recorded):
    files = {(script, file) for script in SCRIPTS for file in recorded(script)}
    assert [pair for pair in files if pair[1].startswith("benchmarks/")] == []


def test_a_record_of_a_benchmark_lists_what_it_measures_with(recorded):
    files = recorded("benchmarks/jobs/measure_work_precision.py")
    names = ("__init__.py", "timing.py", "peers_in_python.py", "taylor.cpp")
    assert {f"benchmarks/{name}" for name in names} <= files
    assert "simulation/simulate.py" in files


JOBS = [f"../{path.relative_to(ROOT)}" for path in sorted((ROOT / "benchmarks/jobs").glob("*.py"))]


def uses_of_snakemake(tree: ast.AST) -> int:
    return sum(isinstance(n, ast.Name) and n.id == "snakemake" for n in ast.walk(tree))


def test_scripts_touch_snakemake_only_under_the_main_guard():
    for script in [*SCRIPTS, *JOBS]:
        tree = ast.parse((sources.SCRIPTS / script).read_text())
        assert 0 < uses_of_snakemake(tree) == uses_of_snakemake(tree.body[-1]), script


def test_the_library_does_not_know_snakemake():
    for path in (sources.SCRIPTS / "pendula").rglob("*.py"):
        text = path.read_text()
        assert "snakemake" not in text or not uses_of_snakemake(ast.parse(text)), path


def test_ci_finds_the_test_command_of_the_readme():
    """The command stands alone between the mark and the end of its block."""
    text = (ROOT / "README.md").read_text()
    (block,) = re.findall(r"<!-- test command -->\n```\n(.*?)\n```", text)
    assert block.startswith("python3 -m venv") and block.endswith("-m pytest")
    assert "<!-- test command -->" in (ROOT / ".ci/run").read_text()
