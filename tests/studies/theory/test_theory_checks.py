"""Every check holds; what decides the claims on theory in exact cases, and a figure draws."""

import numpy as np
import pytest
import xarray as xr
from accepted import changed, dataset, datasets
from helpers import ROOT
from pendula.datasets.checks import broken, variable
from pendula.datasets.netcdf import read
from pendula.ledger.claim import all_claims, decide
from pendula.ledger.criterion import Verdict
from pendula.studies.theory import figures
from pendula.studies.theory.checks import CHECKS
from pendula.studies.theory.settings import GROUPS

CLAIM = {claim.name: claim for claim in all_claims()}


@pytest.mark.parametrize("name", CHECKS)
def test_check_holds(name, checked):
    assert broken(checked(name)) == {}


@pytest.mark.parametrize("name", CHECKS)
def test_check_holds_at_the_sizes_of_the_full_run(name):
    """They take a minute, so that the accepted results stand for them."""
    assert broken(read(ROOT / f"tests/baseline/checks/{name}.nc").to_dict()) == {}


def test_groups_hold_every_check_once():
    assert sorted(name for group in GROUPS.values() for name in group) == sorted(CHECKS)


@pytest.mark.parametrize("value", [2.0, np.nan, np.inf])
def test_values_above_tolerance_or_no_numbers_break_a_check(value):
    check = {"data_vars": {"error": variable([0.0, value], ("x",), "error", tolerance=1.0)}}
    assert "error" in broken(check)


@pytest.mark.parametrize(
    ("second", "error", "verdict"),
    [
        (0.2, 0.01, Verdict.CAVEAT),
        (0.0, 0.01, Verdict.NOT_REPRODUCED),
        (0.0, 0.5, Verdict.UNDECIDED),  # limits wider than what lies between two exponents
        (0.2, 0.5, Verdict.UNDECIDED),
    ],
)
def test_a_second_integral_is_seen_where_exponents_are_resolved(second, error, verdict):
    sizes = np.array([0.0, second, 0.5, 0.7, 0.9, 1.2, 1.5])
    values = np.concatenate([sizes, -sizes])
    along = ("spectrum_case", "spectrum_half_width", "index")
    spectra = xr.Dataset(
        {
            "exponents": (along, values.reshape(1, 1, -1)),
            "exponents_error": (along, np.full((1, 1, values.size), error)),
        },
        {"spectrum_case": ["fig4_small"], "spectrum_half_width": [3]},
    )
    assert CLAIM["one_integral"].decide(spectra).verdict == verdict


def test_the_region_of_theorem_2_is_that_of_the_data():
    claim, sweep, run = CLAIM["fig5_theorem_2"], "sweeps/fig5_left", "trajectories/fig3_small"
    finding = decide(claim, datasets(claim.needs))
    assert finding.verdict == Verdict.CAVEAT and "bonds" in finding.because
    tiny = dataset(run).assign({name: scale * dataset(run)[name]
                                for name, scale in (("l2", 0.3), ("energy", 0.09))})  # fmt: skip
    inside = changed({"in": sweep, "scale": "l2", "by": 0.3}) | {run: tiny}
    assert decide(claim, datasets(claim.needs) | inside).verdict == Verdict.CONFIRMED


def test_relative_errors_are_those_of_growing_cells():
    charts = [dataset(f"checks/{name}").astype(float) for name in ("chart", "short_chart")]
    off = [one.assign(measured=1.01 * one["finite_rate"],
                      exact_flow=1.01 * (1.0 + 1e-9) * one["finite_rate"])
           for one in charts]  # fmt: skip
    data = figures.gather_rates(*off, dataset("checks/threshold"))
    assert data.sizes["cell"] == sum(one["finite_rate"].size for one in charts)
    of_long = data["cell"][data["chain"] == "long"]
    assert (data["sites"].sel(cell=of_long) == int(charts[0]["sites"])).all()
    errors = {line.get_label(): line for line in figures.draw_rates(data).axes[1].get_lines()}
    fastest = errors["fastest mode"].get_ydata()
    assert len(fastest) == int((data["finite_rate"] > 0).sum())
    np.testing.assert_allclose(fastest, 0.01, rtol=1e-6)
    assert errors["linear flow of the data"].get_ydata() == pytest.approx(1e-9, rel=1e-5)
