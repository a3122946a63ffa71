"""One full run of the quick configuration, by the real snakemake."""

import json

import numpy as np
import xarray as xr
from helpers import ROOT
from pendula.configuration.schema import PAPER_CASES, PAPER_SWEEPS
from pendula.datasets.digest import fingerprint


def test_every_picture_shows_what_is_described_beside_it(full_run):
    described = sorted((full_run / "results/figures").glob("*.json"))
    assert len(described) >= 30
    for path in described:
        mark = fingerprint(path.read_text(encoding="utf-8")).encode()
        png, pdf = (path.with_suffix(kind).read_bytes() for kind in (".png", ".pdf"))
        assert png.startswith(b"\x89PNG") and pdf.startswith(b"%PDF")
        assert mark in png and mark in pdf, path.name


def test_a_trajectory_keeps_the_data_contract(full_run):
    with xr.open_dataset(full_run / "results/trajectories/fig3_large.nc") as data:
        assert data["linf"].dims == data["l2"].dims == ("component", "tau")
        assert data["energy"].dims == ("tau",)
        assert list(data["component"].values) == ["A", "B"]
        np.testing.assert_allclose(np.diff(data["tau"]), 0.025, rtol=1e-9)
        assert set(range(5)) <= set(data["tau"].values)
        assert data.attrs["omega"] == -4 and data.attrs["solver"] == "ode45"
        assert data.attrs["solver_rtol"] == 1e-7 and data.attrs["right_hand_sides"] > 0
        assert json.loads(data.attrs["initial"]) == {"0": [5.0, 1.0]}


def test_every_case_and_sweep_exists_by_both_solvers_of_the_paper(full_run):
    for name in PAPER_CASES:
        for solver in ("crank_nicolson", "delfour_fortin_payre"):
            path = full_run / f"results/trajectories/{name}.{solver}.nc"
            with xr.open_dataset(path) as data:
                assert data.attrs["solver"] == solver
    for name in PAPER_SWEEPS:
        with xr.open_dataset(full_run / f"results/sweeps/{name}.crank_nicolson.nc") as data:
            assert data.attrs["solver"] == "crank_nicolson"
            assert dict(data.sizes) == {
                "half_width": 3, "quantity": 3, "statistic": 2, "window": 2
            }  # fmt: skip


def test_datasets_carry_nothing_of_the_machine(full_run):
    with xr.open_dataset(full_run / "results/trajectories/fig2_small.nc") as data:
        text = json.dumps({k: str(v) for k, v in data.attrs.items()})
    assert str(full_run) not in text and str(ROOT) not in text and "20" + "2" not in text
