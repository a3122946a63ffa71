"""The datasets and figures of chaos, as the quick run makes them."""

import pytest
import xarray as xr

CHECKS = ["lyapunov", "symmetry", "ensembles", "lifetimes", "members", "ensembles_uneven"]
FIGURES = CHECKS[:4]


@pytest.mark.parametrize("name", CHECKS)
def test_the_dataset_is_there_with_names_and_units(full_run, name):
    with xr.open_dataset(full_run / f"results/checks/{name}.nc") as data:
        assert data.data_vars
        for key, variable in data.variables.items():
            assert variable.attrs["long_name"] and variable.attrs["units"], key


@pytest.mark.parametrize("name", FIGURES)
def test_the_figure_is_there_with_its_data(full_run, name):
    assert (full_run / f"results/figures/{name}.png").read_bytes().startswith(b"\x89PNG")
    assert (full_run / f"results/figures/{name}.pdf").read_bytes().startswith(b"%PDF")
    with xr.open_dataset(full_run / f"results/figures/{name}.nc") as data:
        assert data.data_vars
