"""The errors of measured growth rates, of which the accepted datasets hold too few digits."""

import numpy as np
import pytest
from accepted import dataset
from pendula.studies.theory import figures


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
