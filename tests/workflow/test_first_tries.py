"""What users of Snakemake try first, as the table in docs/reproduce.md tells it.

Every key of every case is edited in tests/edits.py, which takes half an hour.
"""

from hashlib import sha256

import pytest
import yaml
from helpers import ROOT, command_of, planned, run_ready, snakemake
from latticode.datasets.netcdf import read


def bytes_of(folder):
    files = sorted(folder.glob("results/figures/fig1.*"))
    assert len(files) == 4
    return [sha256(path.read_bytes()).hexdigest() for path in files]


@pytest.fixture(scope="module")
def drawn(made_once):
    """Return a folder with Fig 1, drawn by Snakemake's own executor beside a job that fails.

    In the environment of a notebook whose backend for figures is not installed.
    """

    def make(folder):
        settings = {"cases": {"wild": {"omega": 0, "solver": {"name": "auto", "error": 1e-12}}}}
        options = ("--executor", "local", "--cores", "1", "--keep-going")
        words = (*options, "results/trajectories/wild.nc", "fig1")
        backend = "module://no_such_module.backend_inline"
        result = snakemake(ROOT, folder, *words, settings=settings, MPLBACKEND=backend)
        assert result.returncode == 1
        (folder / "said.txt").write_text(result.stderr)

    return made_once("drawn", make)


def test_cores_and_the_executor_change_no_byte(drawn, full_run):
    assert bytes_of(drawn) == bytes_of(full_run)


def test_keep_going_makes_what_does_not_rest_on_a_failed_job_and_says_at_the_end_why_it_failed(
    drawn,
):
    *_, reason, more = (said := (drawn / "said.txt").read_text()).splitlines()
    log = drawn / "results/logs/trajectories/wild.log"
    assert reason.startswith("auto: runs in double precision agree to ")
    assert more == f"  (more in {log})" and said.count("auto: runs in") == 1
    assert log.read_text().startswith(f"failed: {reason[:40]}") and "Traceback" in log.read_text()
    assert not list(drawn.glob("results/trajectories/*")) and bytes_of(drawn)


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


def test_another_workflow_uses_this_one_as_a_module(tmp_path):
    (tmp_path / "Snakefile").write_text(MODULE.format(root=ROOT))
    picture = "elsewhere/results/figures/fig1.png"
    done = run_ready(["", "-m", "snakemake", "--cores", "1", picture], tmp_path)
    assert done.returncode == 0 and f"Drawing {picture}" in done.stdout + done.stderr, done.stderr
    assert (tmp_path / picture).read_bytes().startswith(b"\x89PNG")
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
