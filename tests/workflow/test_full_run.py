"""One full run of the quick configuration, by the real snakemake."""

import json

import numpy as np
import xarray as xr
from helpers import ROOT
from pendula.datasets.digest import fingerprint

CASES = [f"fig{n}_{size}" for n in (2, 3, 4) for size in ("small", "large")]
SWEEPS = [f"fig{n}_{side}" for n in (5, 6) for side in ("left", "right")]
FIGURES = ["fig1", "fig2", "fig3", "fig4", "fig5", "fig6", "fig2_spacetime", "energy_drift"]


def test_every_figure_is_there_with_its_data(full_run):
    for name in FIGURES:
        png = (full_run / f"results/figures/{name}.png").read_bytes()
        pdf = (full_run / f"results/figures/{name}.pdf").read_bytes()
        assert png.startswith(b"\x89PNG") and pdf.startswith(b"%PDF")
        with xr.open_dataset(full_run / f"results/figures/{name}.nc") as data:
            assert data.data_vars
        described = (full_run / f"results/figures/{name}.json").read_text(encoding="utf-8")
        assert all(fingerprint(described).encode() in picture for picture in (png, pdf))


def test_a_trajectory_keeps_the_data_contract(full_run):
    with xr.open_dataset(full_run / "results/trajectories/fig3_large.nc") as data:
        assert data["linf"].dims == data["l2"].dims == ("component", "tau")
        assert data["energy"].dims == ("tau",)
        assert list(data["component"].values) == ["A", "B"]
        np.testing.assert_allclose(np.diff(data["tau"]), 0.025, rtol=1e-9)
        assert set(range(5)) <= set(data["tau"].values)
        for name, variable in data.variables.items():
            assert variable.attrs["long_name"] and variable.attrs["units"], name
        assert data.attrs["omega"] == -4 and data.attrs["solver"] == "ode45"
        assert data.attrs["solver_rtol"] == 1e-7 and data.attrs["right_hand_sides"] > 0
        assert json.loads(data.attrs["initial"]) == {"0": [5.0, 1.0]}


def test_every_case_and_sweep_exists_by_both_solvers_of_the_paper(full_run):
    for name in CASES:
        assert (full_run / f"results/trajectories/{name}.nc").exists()
        for solver in ("crank_nicolson", "delfour_fortin_payre"):
            path = full_run / f"results/trajectories/{name}.{solver}.nc"
            with xr.open_dataset(path) as data:
                assert data.attrs["solver"] == solver
    for name in SWEEPS:
        assert (full_run / f"results/sweeps/{name}.nc").exists()
        with xr.open_dataset(full_run / f"results/sweeps/{name}.crank_nicolson.nc") as data:
            assert data.attrs["solver"] == "crank_nicolson"
            assert dict(data.sizes) == {
                "half_width": 3, "quantity": 3, "statistic": 2, "window": 2
            }  # fmt: skip


def test_the_solvers_table_speaks_of_every_case(full_run):
    table = (full_run / "results/tables/solvers.md").read_text()
    assert all(f"| {name} |" in table for name in CASES)


def test_datasets_carry_nothing_of_the_machine(full_run):
    with xr.open_dataset(full_run / "results/trajectories/fig2_small.nc") as data:
        text = json.dumps({k: str(v) for k, v in data.attrs.items()})
    assert str(full_run) not in text and str(ROOT) not in text and "20" + "2" not in text
