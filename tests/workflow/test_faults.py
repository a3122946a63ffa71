"""Bad input and accidents: a clear message, a non-zero exit, and no half-written result."""

import subprocess
import sys

import pytest
from helpers import NOISE, ROOT, planned, snakemake, snakemake_with


def test_a_bad_configuration_stops_before_any_job(tmp_path):
    settings = {"cases": {"mine": {"omgea": 3, "half_width": -2, "solver": "dop835"}}, "swepes": {}}
    result = snakemake_with(settings, ROOT, tmp_path)
    assert result.returncode == 1
    for part in (
        "the configuration has 5 faults:\n  ",
        "cases.mine.omega: is missing",
        "cases.mine.omgea: is not a known key; did you mean 'omega'?",
        "cases.mine.half_width: is -2; it must be at least 0",
        "did you mean 'dop853'?",
        "swepes: is not a known key; did you mean 'sweeps'?",
    ):
        assert part in result.stderr
    assert not [word for word in NOISE if word in result.stderr]
    assert not (tmp_path / "results/trajectories").exists()


def test_a_case_of_ones_own_needs_a_few_lines(tmp_path):
    settings = {
        "cases": {
            "mine": {
                "omega": 6.5,
                "gamma": 0.7,
                "epsilon": 1.3,
                "half_width": 20,
                "boundary": "dirichlet",
                "initial": {0: [2.0, "-0.3+0.4j"], 3: [0.5, 0.0]},
                "end_time": 4,
                "solver": "dop853",
            }
        }
    }
    result = snakemake_with(settings, ROOT, tmp_path, "results/trajectories/mine.nc")
    assert result.returncode == 0, result.stderr
    for made in ("kernels/dop853.txt", "trajectories/mine.nc"):
        assert f"ing results/{made}\n" in result.stderr
    import xarray as xr

    with xr.open_dataset(tmp_path / "results/trajectories/mine.nc") as data:
        assert data.attrs["gamma"] == 0.7 and data.attrs["solver"] == "dop853"
        assert float(data["l2"].sel(component="A").isel(tau=0)) == pytest.approx(4.25**0.5)
        assert float(data["linf"].sel(component="B").isel(tau=0)) == pytest.approx(0.5)


def test_a_failing_job_says_why_on_the_screen_and_keeps_the_traceback_in_its_log(tmp_path):
    chaotic = {"omega": 0, "solver": {"name": "auto", "error": 1e-12}}
    settings = {"cases": {"wild": chaotic}}
    result = snakemake_with(settings, ROOT, tmp_path, "results/trajectories/wild.nc")
    log = (tmp_path / "results/logs/trajectories/wild.log").read_text()
    assert result.returncode != 0
    assert log.startswith("failed: auto: runs in double precision agree to ") and "Traceback" in log
    *_, reason, more = result.stderr.splitlines()
    assert reason.startswith("auto: runs in double precision agree to ")
    assert more == f"  (more in {tmp_path}/results/logs/trajectories/wild.log)"
    assert "Traceback" not in result.stderr and result.stderr.count("auto: runs in") == 1
    assert not (tmp_path / "results/trajectories/wild.nc").exists()


def test_a_damaged_dataset_is_named_with_the_way_out(finished):
    dataset = finished / "results/trajectories/fig3_small.nc"
    dataset.write_bytes(dataset.read_bytes()[:1000])
    (finished / "results/figures/fig3.png").unlink()
    result = snakemake(ROOT, finished, "fig3")
    assert result.returncode != 0
    assert f"{dataset} is damaged" in result.stderr
    assert "delete it and run snakemake" in result.stderr
    dataset.unlink()
    jobs = planned(ROOT, finished)
    assert (jobs["trajectory"], jobs["norms_in_time"]) == (1, 1)
    assert not jobs.keys() & {"trajectory_by_solvers", "sweep"}


MODULE = """
module pendula:
    snakefile:
        "{root}/Snakefile"
{prefix}

use rule * from pendula as pendula_*
"""


@pytest.mark.parametrize("folder", ["", "elsewhere/"])
def test_another_workflow_uses_this_one_as_a_module(tmp_path, folder):
    prefix = f'    prefix:\n        "{folder}"\n' if folder else ""
    (tmp_path / "Snakefile").write_text(MODULE.format(root=ROOT, prefix=prefix))
    picture = f"{folder}results/figures/fig1.png"
    done = subprocess.run(
        [sys.executable, "-m", "snakemake", "--cores", "1", picture],
        cwd=tmp_path, capture_output=True, text=True,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert (tmp_path / picture).read_bytes().startswith(b"\x89PNG")
    assert (tmp_path / f"{folder}results/logs/figures/fig1.log").exists()
