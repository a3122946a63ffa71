"""What users of Snakemake try first, as the table in docs/reproduce.md tells it.

Every key of every case is edited in tests/edits/edits.py, which takes half an hour.
"""

import yaml
from helpers import ROOT, command_of, planned, run_ready
from latticode.datasets.netcdf import read


def test_a_snakefile_from_elsewhere_writes_where_one_is(tmp_path):
    command = ["", "-m", "snakemake", "-n", "-s", str(ROOT / "workflow/Snakefile"), "fig1"]
    result = run_ready(command, tmp_path)
    assert "Drawing results/figures/fig1.png" in result.stdout + result.stderr
    assert [path.name for path in tmp_path.iterdir()] == [".snakemake"]


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
    *("checks/members.nc", "checks/lyapunov.nc", "unbounded/fig3_large.nc"),
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
