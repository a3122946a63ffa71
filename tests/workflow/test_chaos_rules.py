"""The datasets and figures of chaos, as the quick run makes them."""

import pytest
import xarray as xr
from helpers import edit, planned

CHECKS = ["lyapunov", "symmetry", "ensembles", "lifetimes", "members", "ensembles_uneven"]
FIGURES = CHECKS[:4]
MEASURES = {f"measure_{name}" for name in CHECKS[:5]}


@pytest.mark.parametrize("name", CHECKS)
def test_the_dataset_is_there_with_names_and_units(finished, name):
    with xr.open_dataset(finished / f"results/checks/{name}.nc") as data:
        assert data.data_vars
        for key, variable in data.variables.items():
            assert variable.attrs["long_name"] and variable.attrs["units"], key


@pytest.mark.parametrize("name", FIGURES)
def test_the_figure_is_there_with_its_data(finished, name):
    assert (finished / f"results/figures/{name}.png").read_bytes().startswith(b"\x89PNG")
    assert (finished / f"results/figures/{name}.pdf").read_bytes().startswith(b"%PDF")
    with xr.open_dataset(finished / f"results/figures/{name}.nc") as data:
        assert data.data_vars


def test_the_tangent_equations_rerun_what_follows_them_and_nothing_else(finished, clone):
    edit(clone / "scripts/pendula/models/tangent.py", "Rows of one state", "The rows of one state")
    jobs = planned(clone, finished)
    # lost evenness has the solver of the tangents
    assert jobs.keys() & MEASURES == {"measure_lyapunov", "measure_symmetry"}
    assert not jobs.keys() & {"trajectory", "sweep"}


def test_a_new_omega_reruns_the_cases_of_chaos(finished, clone):
    edit(clone / "config/config.yaml", "{<<: *large, omega: 0}", "{<<: *large, omega: 0.5}")
    follows = {*MEASURES, "chaos_figures", "ensembles"} - {"measure_lifetimes"}
    assert planned(clone, finished).keys() >= follows  # lives are those of the small case
