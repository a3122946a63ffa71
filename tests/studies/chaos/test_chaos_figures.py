"""The figures of chaos: exponents, lost evenness, ensembles."""

import numpy as np
import pytest
from made_up_chaos import RATES, SIZE
from pendula.studies.chaos import figures, lifetimes_figure


def test_the_running_rate_is_growth_over_time(gathered):
    running = gathered["lyapunov"]["running"]
    assert float(running["tau"][0]) > 0
    np.testing.assert_allclose(running.isel(tau=-1), RATES, rtol=1e-12)


def test_every_case_and_parity_has_a_line_of_its_own(gathered):
    running, spectrum, divergence_time = figures.draw_lyapunov(gathered["lyapunov"]).axes
    assert len(running.get_lines()) == RATES.size
    _, short, longer = (line.get_ydata() for line in spectrum.get_lines())
    np.testing.assert_array_equal(short[:12], np.linspace(2, -2, 12))
    np.testing.assert_array_equal(longer, np.linspace(2, -2, 20))
    dots = [line for line in divergence_time.get_lines() if line.get_linestyle() == "None"]
    assert [*dots[-1].get_xdata(), *dots[-1].get_ydata()] == [16.0, 17.0]


def test_the_predicted_odd_part_grows_with_the_odd_change_up_to_the_whole(gathered):
    predicted = gathered["symmetry"]["predicted"]
    expected = SIZE * np.exp(RATES[1, 1] * 5.0)
    assert float(predicted.sel(predicted_tau=5.0)[1]) == pytest.approx(expected)
    assert float(predicted["predicted_tau"].max()) == 10.0 and float(predicted.max()) <= 1.0


def test_the_odd_part_is_drawn_for_rounding_and_every_member(gathered):
    for axes in figures.draw_symmetry(gathered["symmetry"]).axes:
        assert len(axes.get_lines()) == 4 and axes.get_yscale() == "log"


def test_ensembles_show_the_pair_and_the_paper_s_run(gathered):
    data = gathered["ensembles"]
    assert data["l2"].isel(case=0, tau=0).values.tolist() == [20.0, 21.0, 22.0, 23.0, 24.0]
    # the made-up trajectory has l2 norms 9 and 3 at the start
    assert float(data["run"].isel(case=0, tau=0)) == pytest.approx(np.hypot(9.0, 3.0))
    assert data["swept_window"].values.tolist() == ["[10, 50]", "[10, 70]"]


def test_a_run_is_within_its_band_or_not(gathered):
    data = gathered["ensembles"]
    low, high = (data["l2"].sel(quantile=quantile) for quantile in (0.05, 0.95))
    late = data["tau"] >= float(data["tau"].max()) / 2
    for case in data["case"].values:
        norm = data["run"].sel(case=case)[late]
        within = (norm >= low.sel(case=case)[late]) & (norm <= high.sel(case=case)[late])
        assert float(data["run_inside"].sel(case=case)) == pytest.approx(float(within.mean()))


def test_swept_means_are_drawn_with_their_deviation_beside_the_run(gathered):
    data = gathered["ensembles"]
    below = figures.draw_ensembles(data).axes[-1]
    (bars,) = below.containers
    mean = data["l2_mean"].isel(sweep=1).values
    assert bars.lines[0].get_ydata().tolist() == mean.tolist()
    (low, high), *_ = bars.lines[2][0].get_segments()
    assert high[1] - low[1] == pytest.approx(0.2 * mean[0])
    assert (
        below.get_lines()[-1].get_ydata().tolist()
        == data["swept_run"].isel(sweep=1).values.tolist()
    )


def test_lives_are_drawn_where_they_are_known_and_as_bounds_where_they_are_not(gathered):
    shares, lives = lifetimes_figure.draw_lifetimes(gathered["lifetimes"]).axes
    assert len(shares.get_lines()) == 3
    medians, rates = lives.containers
    np.testing.assert_array_equal(medians.lines[0].get_xydata(), [[1.0, 5.0], [7.0, 50.0]])
    np.testing.assert_allclose(rates.lines[0].get_ydata(), [110.0])
    median, mean = (line for line in lives.get_lines() if line.get_marker() == "^")
    np.testing.assert_array_equal(median.get_xydata(), [[10.0, 100.0]])
    np.testing.assert_allclose(mean.get_ydata(), [1010.0])
