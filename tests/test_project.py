"""The project agrees with itself: pins, code that jobs rest on, words that must not stand in it."""

import re
import tomllib
from pathlib import Path

import pytest
import yaml
from latticode.kernels import sources
from pendula.sources import SCRIPTS

ROOT = Path(__file__).resolve().parents[1]
PACKAGES = [sources.ROOTS[name] / name for name in ("latticode", "replication", "pendula")]


def test_the_conda_environment_has_the_same_pins_of_what_jobs_import():
    lines = (ROOT / "environment.txt").read_text().splitlines()
    own_packages, pins = lines[:3], lines[3:]
    assert all(
        (ROOT / entry.removeprefix("-e ") / "pyproject.toml").exists() for entry in own_packages
    )
    assert all(re.fullmatch(r"[\w.-]+==[\w.]+", pin) for pin in pins)
    conda = yaml.safe_load((ROOT / "workflow/envs/pinned.yaml").read_text())
    homes = [ROOT, ROOT / "packages/latticode"]
    each = [tomllib.loads((home / "pyproject.toml").read_text()) for home in homes]
    library = [entry for home in each for entry in home["project"]["dependencies"]]
    library = [re.match(r"[\w-]+", package)[0] for package in library]
    imported = {*library, *sources.PACKAGES, "snakemake"}
    assert set(conda["dependencies"][-1]["pip"]) == {
        pin for pin in pins if pin.split("==")[0] in imported
    }


RULES = "".join(path.read_text() for path in sorted((ROOT / "workflow/rules").glob("*.smk")))
CALLED = sorted(set(re.findall(r'"((?:pendula|replication|benchmarks)\.[\w.]+)"', RULES)))
"""Every function that a rule calls."""
DRAWING = [name for name in CALLED if ".studies." in name and ".draw" in name]
COMPUTING = [
    "paper.runs.run_case",
    "paper.runs.run_sweep",
    "paper.compile_solver.compile_solver",
    "reference.verified_run.make_reference",
    "chaos.lyapunov.measure_lyapunov",
    "chaos.ensembles.measure_ensembles",
    "unbounded.long_runs.spread_case",
    "hard_cases.outcomes.run_hard_cases",
]


def files_behind(function: str) -> set[str]:
    """Return the files that a job rests on which calls this function, below scripts/pendula."""
    modules = sources.modules_of(*sources.files_of_module(function.rpartition(".")[0]))
    files = [*modules, *sources.attached_to(modules)]
    return {path.relative_to(ROOT).as_posix().removeprefix("scripts/pendula/") for path in files}


LIBRARY = "packages/latticode/latticode"
PAGES = (f"{LIBRARY}/drawing/", "drawing.py", "jobs/", "scripts/replication/")
ATTRIBUTES = ("scripts/replication/__init__.py", "scripts/replication/variables.py")
"""What a computing module needs of the general rooms, to say what its variables are."""


@pytest.mark.parametrize("function", COMPUTING)
def test_what_computes_does_not_depend_on_what_is_drawn_or_written(function):
    """Nor on the configuration's room, whose every edit would rerun the simulations."""
    assert f"pendula.studies.{function}" in CALLED
    files = files_behind(f"pendula.studies.{function}")
    assert not [
        file for file in files - set(ATTRIBUTES) if file.startswith((*PAGES, "configuration/"))
    ]
    assert not [file for file in files if file.endswith((".j2", ".css", ".js"))]


def test_what_draws_depends_on_no_model_no_run_and_no_page():
    """It depends on the methods for their names and colours, so their edits redraw figures."""
    assert len(DRAWING) > 10
    general = [f"scripts/replication/{room}/" for room in ("report", "figure_diff", "archive")]
    runs = [f"{LIBRARY}/{room}/" for room in ("simulation", "generation", "localised")]
    foreign = ("models/", *runs, *general)
    files = {(name, file) for name in DRAWING for file in files_behind(name)}
    assert [pair for pair in files if pair[1].startswith(foreign)] == []
    assert [name for name in DRAWING if (name, f"{LIBRARY}/drawing/style.py") not in files] == []


METHODS = ROOT / "packages/latticode/latticode/integrators/methods/__init__.py"
"""Where a line adds a method; each imports its kernels inside a function."""


def test_importing_a_package_drags_in_no_other_room():
    """What an `__init__.py` imports is in the record of every job that imports from the package.

    That of the replication names its folder to the library, which follows imports by such names.
    """
    named = set(sources.modules_of(SCRIPTS / "pendula/sources.py"))
    packages = [init for home in PACKAGES for init in home.rglob("__init__.py")]
    assert len(packages) > 10
    for init in packages:
        above = {folder / "__init__.py" for folder in init.parent.parents}
        imported = {path for path in sources.modules_of(init) if init.parent not in path.parents}
        assert imported <= above | named or init == METHODS, init
