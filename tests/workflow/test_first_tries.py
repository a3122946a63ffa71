"""What users of Snakemake try first, as the table in docs/reproduce.md tells it.

Every key of every case is edited in tests/edits/edits.py, which takes half an hour.
"""

import os
import subprocess

import yaml
from helpers import ROOT, command_of, planned, run_ready, snakemake
from latticode.datasets.netcdf import read


def test_a_snakefile_from_elsewhere_writes_where_one_is(tmp_path):
    command = ["", "-m", "snakemake", "-n", "-s", str(ROOT / "workflow/Snakefile"), "fig1"]
    result = run_ready(command, tmp_path)
    assert "Drawing results/figures/fig1.png" in result.stdout + result.stderr
    assert [path.name for path in tmp_path.iterdir()] == [".snakemake"]


def test_a_folder_may_have_braces_in_its_name(clone, tmp_path):
    """Snakemake would take what is in them for a wildcard, in the paths of environments."""
    folder = clone.rename(tmp_path / "x{y}")
    result = snakemake(folder, folder, "fig1")
    assert result.returncode == 0, result.stderr
    assert (folder / "results/figures/fig1.png").exists()


STORAGE = """
from snakemake_interface_storage_plugins import storage_object, storage_provider
class StorageProvider(storage_provider.StorageProviderBase): ...
class StorageObject(storage_object.StorageObjectRead, storage_object.StorageObjectWrite): ...
StorageProvider.__abstractmethods__ = frozenset()
"""
"""What passes for a storage of Snakemake until a file is asked of it."""


def test_a_default_storage_is_refused_by_a_sentence(tmp_path):
    (plugin := tmp_path / "snakemake_storage_plugin_made_up").mkdir()
    (plugin / "__init__.py").write_text(STORAGE)
    options = "--default-storage-provider", "made-up", "--default-storage-prefix", "x", "fig1"
    command = command_of(ROOT, tmp_path, ROOT / "config/quick.yaml", *options)
    done = subprocess.run(
        command, env={**os.environ, "PYTHONPATH": str(tmp_path)}, capture_output=True, text=True
    )
    assert done.returncode == 1 and "Traceback" not in done.stderr
    assert "--default-storage-provider made-up is not supported here" in done.stderr
    assert "UndefinedPathvarException" not in done.stderr


MODULE = """
module pendula:
    snakefile:
        "{root}/Snakefile"
    prefix:
        "elsewhere/"

use rule * from pendula as pendula_*
"""


def test_another_workflow_uses_this_one_as_a_module_to_the_same_bytes(full_run, tmp_path):
    """By Snakemake's own executor, and as in a notebook whose backend is not installed here."""
    (tmp_path / "Snakefile").write_text(MODULE.format(root=ROOT))
    picture, backend = "elsewhere/results/figures/fig1.png", "module://no_such_module.inline"
    command = ["", "-m", "snakemake", "--executor", "local", "--cores", "1", picture]
    done = run_ready(command, tmp_path, MPLBACKEND=backend)
    assert done.returncode == 0 and f"Drawing {picture}" in done.stdout + done.stderr, done.stderr
    drawn, expected = (
        {path.name: path.read_bytes() for path in (folder / "results").glob("*/fig1.*")}
        for folder in (tmp_path / "elsewhere", full_run)
    )
    assert drawn == expected and len(drawn) == 4
    assert (tmp_path / "elsewhere/results/logs/figures/fig1.log").exists()


def test_the_page_of_snakemake_has_each_figure_with_its_caption_and_each_dataset(finished):
    page = finished / "page.html"
    ended = snakemake(ROOT, finished, "--report", str(page), "fig2", "stability_chart")
    assert ended.returncode == 0, ended.stderr
    text = page.read_text()
    assert "fig2: Norms of A (red) and of B (blue)" in text
    assert "fig2_small: Norms and energy of fig2_small against time" in text
    assert "chart: Growth rates on 21 sites" in text
    assert "Drawn by" in text and "Computed by" in text


def test_a_deleted_file_is_made_again_and_nothing_else(finished):
    (finished / "results/figures/fig5.pdf").unlink()
    assert planned(ROOT, finished, "figures") == {"norms_by_half_width": 1, "figures": 1}


EDITED = {
    "fig2_small": {"end_time": 6, "boundary": "free"},
    "fig2_large": {"half_width": 20},
    "fig3_small": {"epsilon": 2, "snapshot_step": None},
    "fig3_large": {"initial": {1: [1, "0.5j"], -3: [0.2, 0]}},
    "fig4_small": {"omega": 7.5, "gamma": 0.5, "solver": "auto"},
    "fig4_large": {"initial": {0: [1, 1]}, "output_step": 0.05},
}
"""Edits of the paper's cases that once broke studies: they run on what the case has become."""
RUN_ON_EDITED = (
    "checks/members.nc",
    "checks/lyapunov.nc",
    "unbounded/fig3_large.nc",
    "pendula/over_the_top.nc",
)


def test_studies_run_on_what_edited_cases_have_become(finished):
    (edits := finished / "edit.yaml").write_text(yaml.safe_dump({"cases": EDITED}))
    targets = [f"results/{name}" for name in RUN_ON_EDITED]
    command = command_of(ROOT, finished, ROOT / "config/quick.yaml", *targets)
    ended = run_ready([*command, str(edits)])
    assert ended.returncode == 0, ended.stdout + ended.stderr
    lyapunov = read(finished / "results/checks/lyapunov.nc")
    assert lyapunov["gamma"].sel(case=["fig2_small", "fig4_small"]).values.tolist() == [1.0, 0.5]


def test_a_copy_of_the_project_with_the_packages_of_another_is_refused(clone, tmp_path):
    """Its rules would run the code of the other copy, and nobody would notice."""
    result = snakemake(clone, tmp_path, "--dry-run", "fig1", PYTHONPATH="")
    output = result.stdout + result.stderr
    assert result.returncode == 1 and "Traceback" not in output
    assert f"Python imports the project from {ROOT}, not from this copy" in output
    assert f"pip install -e {clone}" in output
