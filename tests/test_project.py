"""The project agrees with itself: pins, code that jobs rest on, words that must not stand in it."""

import ast
import io
import re
import tokenize
import tomllib
from pathlib import Path

import pytest
import yaml
from latticode.kernels import sources
from pendula.sources import SCRIPTS

ROOT = Path(__file__).resolve().parents[1]
PACKAGES = [sources.ROOTS[name] / name for name in ("latticode", "pendula")]
STUDIES_FOLDER = SCRIPTS / "pendula/studies"


def test_the_conda_environment_has_the_same_pins_of_what_jobs_import():
    lines = (ROOT / "environment.txt").read_text().splitlines()
    own, pins = lines[:2], lines[2:]
    assert all((ROOT / one.removeprefix("-e ") / "pyproject.toml").exists() for one in own)
    assert all(re.fullmatch(r"[\w.-]+==[\w.]+", pin) for pin in pins)
    conda = yaml.safe_load((ROOT / "workflow/envs/pinned.yaml").read_text())
    homes = [ROOT, ROOT / "packages/latticode"]
    each = [tomllib.loads((home / "pyproject.toml").read_text()) for home in homes]
    library = [one for home in each for one in home["project"]["dependencies"]]
    library = [re.match(r"[\w-]+", package)[0] for package in library]
    imported = {*library, *sources.PACKAGES, "snakemake"}
    assert set(conda["dependencies"][-1]["pip"]) == {
        pin for pin in pins if pin.split("==")[0] in imported
    }


RULES = "".join(path.read_text() for path in sorted((ROOT / "workflow/rules").glob("*.smk")))
CALLED = sorted(set(re.findall(r'"((?:pendula|benchmarks)\.[\w.]+)"', RULES)))
"""Every function that a rule calls."""
DRAWING = [name for name in CALLED if ".studies." in name and ".draw" in name]
COMPUTING = [
    *("paper.runs.run_case", "paper.runs.run_sweep", "paper.compile_solver.compile_solver"),
    *("reference.verified_run.reference_contents", "chaos.lyapunov.measure_lyapunov"),
    *("chaos.ensembles.measure_ensembles", "unbounded.long_runs.spread_case"),
    *("unbounded.transverse.solve_transverse", "hard_cases.outcomes.hard_cases_contents"),
]


def files_behind(function: str) -> set[str]:
    """Return the files that a job rests on which calls this function, below scripts/pendula."""
    modules = sources.modules_of(*sources.files_of_module(function.rpartition(".")[0]))
    files = [*modules, *sources.attached_to(modules)]
    return {path.relative_to(ROOT).as_posix().removeprefix("scripts/pendula/") for path in files}


LIBRARY = "packages/latticode/latticode"
PAGES = (f"{LIBRARY}/drawing/", "drawing.py", "report/", "figure_diff/", "archive/", "ledger/")


@pytest.mark.parametrize("function", COMPUTING)
def test_what_computes_does_not_depend_on_what_is_drawn_or_written(function):
    """Nor on the configuration's room, whose every edit would rerun the simulations."""
    assert f"pendula.studies.{function}" in CALLED
    files = files_behind(f"pendula.studies.{function}")
    assert not [file for file in files if file.startswith((*PAGES, "configuration/"))]
    assert not [file for file in files if file.endswith((".j2", ".css", ".js"))]


def test_what_draws_does_not_depend_on_how_it_was_integrated():
    assert len(DRAWING) > 10
    foreign = (f"{LIBRARY}/integrators/", "models/", "report/", "figure_diff/", "archive/")
    files = {(name, file) for name in DRAWING for file in files_behind(name)}
    assert [pair for pair in files if pair[1].startswith(foreign)] == []
    assert [name for name in DRAWING if (name, f"{LIBRARY}/drawing/style.py") not in files] == []


def test_importing_a_package_drags_in_no_other_room():
    """What an `__init__.py` imports is in the record of every job that imports from the package.

    That of the replication names its folder to the library, which follows imports by such names.
    """
    named = set(sources.modules_of(SCRIPTS / "pendula/sources.py"))
    packages = [init for home in PACKAGES for init in home.rglob("__init__.py")]
    assert len(packages) > 10
    for init in packages:
        above = {folder / "__init__.py" for folder in init.parent.parents}
        others = {path for path in sources.modules_of(init) if init.parent not in path.parents}
        assert others <= above | named, init


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
    monkeypatch.setitem(sources.ROOTS, "pendula", tmp_path)
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
    sizes = []
    for module in [module for home in (SCRIPTS, PACKAGES[0]) for module in home.rglob("*.py")]:
        text = module.read_text(encoding="utf-8")
        trees = sources._tree_of(text), ast.parse(text)
        assert imports_in(trees[0]) == imports_in(trees[1]), module
        sizes.append([sum(1 for _ in sources._statements(tree)) for tree in trees])
    read, whole = map(sum, zip(*sizes, strict=True))
    assert len(sizes) > 100 and read < 0.2 * whole


def test_no_part_of_a_reproduction_depends_on_the_benchmarks():
    of_library = [name for name in CALLED if name.startswith("pendula.")]
    files = {(name, file) for name in of_library for file in files_behind(name)}
    assert [pair for pair in files if pair[1].startswith("benchmarks/")] == []
    files = files_behind("benchmarks.jobs.measure_work_precision")
    names = ("__init__.py", "timing.py", "peers_in_python.py", "taylor.cpp")
    assert {f"benchmarks/{name}" for name in names} <= files


LAYOUT = {tokenize.NL, tokenize.COMMENT, tokenize.INDENT, tokenize.DEDENT, tokenize.NEWLINE}


def tokens_of(text: str) -> list[str]:
    """Return what Python makes of a module, without comments, layout and statements of strings."""
    found = list(tokenize.generate_tokens(io.StringIO(text).readline))
    found = [one for one in found if one.type not in LAYOUT - {tokenize.NEWLINE}]
    ends = [True, *(one.type == tokenize.NEWLINE for one in found), True]
    alone = [ends[i] and ends[i + 2] for i in range(len(found))]
    pairs = zip(found, alone, strict=True)
    kept = [one for one, only in pairs if not (only and one.type == tokenize.STRING)]
    return [one.string for one in kept if one.type != tokenize.NEWLINE]


def test_what_is_left_out_of_the_hash_of_code_is_no_code():
    for module in [
        one for home in (SCRIPTS, *PACKAGES[:1], ROOT / "benchmarks") for one in home.rglob("*.py")
    ]:
        text = module.read_text(encoding="utf-8")
        assert tokens_of(sources.bare(text)) == tokens_of(text), module


@pytest.mark.parametrize(
    ("text", "same"),
    [
        ('def f():\n    """Say."""\n    return 1\n', True),
        ("def f():\n    # why\n\n    return 1  # one\n", True),
        ("def f():\n    return 2\n", False),
        ("def f():\n    return '# 1'\n", False),
        ('def f():\n    return """1"""\n', False),
        ("def f():\n  return 1\n", False),
    ],
)
def test_comments_and_docstrings_do_not_count(text, same):
    assert (sources.bare(text) == sources.bare("def f():\n    return 1\n")) is same


def test_the_hash_of_code_follows_modules_templates_and_packages(tmp_path, monkeypatch):
    monkeypatch.setitem(sources.ROOTS, "pendula", tmp_path)
    page = tmp_path / "pendula/page"
    page.mkdir(parents=True)
    (tmp_path / "pendula/other.py").write_text("X = 1\n")
    (page / "page.j2").write_text("words")
    (page / "__init__.py").write_text("from pendula import other\n")

    def digest():
        for one in (sources.digest_of_code, sources._digest_of_bare, sources.digest_of,
                    sources._versions, sources._imports_of, sources._beside):  # fmt: skip
            one.cache_clear()
        return sources.digest_of_code(page / "__init__.py")

    found = [digest()]
    (tmp_path / "pendula/other.py").write_text("X = 2\n")
    found.append(digest())
    (page / "page.j2").write_text("other words")
    found.append(digest())
    monkeypatch.setattr(sources, "version", lambda name: "0")
    found.append(digest())
    assert len(set(found)) == 4
