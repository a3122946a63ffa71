"""A user's case of the pendula: its dataset, checks, figures and page, and what is left out."""

import numpy as np
import pytest
from latticode.configuration.files import ConfigurationError
from pendula import Case, check, draw_norms, draw_spacetime, draw_sweep, simulate, sweep
from pendula.own_cases import answers
from problems import as_the_workflow_writes

SWING = Case(omega=-4, model="pendula", mu=0.1, half_width=8, end_time=2)
OVER = SWING.changed(omega=0, initial={0: ("6j", 1)}, mu=0.2)


@pytest.fixture(scope="module")
def run():
    return simulate(SWING)


@pytest.fixture(scope="module")
def checks(run):
    return check(SWING, run)


def test_a_dataset_of_pendula_says_so_and_has_angles(run, tmp_path):
    written = as_the_workflow_writes(SWING, "case", tmp_path / "case.nc")
    assert written.identical(run.drop_vars("snapshot"))
    assert run.attrs["model"] == "pendula" and run.attrs["mu"] == 0.1 and "energy" not in run
    assert list(run["component"].values) == ["x", "y"]
    assert list(run["part"].values) == ["angle", "velocity"]
    assert all(run[name].attrs["units"] == "rad" for name in ("linf", "l2", "modulus", "final"))
    assert float(run["linf"].sel(component="x")[0]) == 0.2
    assert float(run["l2"].sel(component="y")[0]) == pytest.approx(0.02)
    angles = run["final"].sel(part="angle")
    np.testing.assert_allclose(run["linf"][:, -1], np.abs(angles).max("site"), rtol=0, atol=0)


def test_a_second_run_and_the_expansion_stand_beside_it(checks):
    assert float(checks["largest_difference"]) < 1e-11 and checks["divergence_time"] == np.inf
    assert checks["second_linf"].attrs["units"] == "rad"
    assert 0.2 <= float(checks["largest_angle"]) < 0.25 and checks["over_the_top"] == np.inf
    assert 1e-4 < float(checks["expansion_error"]) < 0.02
    assert not {"exponent", "gamma_0", "energy_drift"} & checks.data_vars.keys()


def test_its_figures_are_in_radians(run, checks):
    axes = draw_norms(run, checks).axes
    assert ["(rad)" in axes_of_panel.get_ylabel() for axes_of_panel in axes] == [True, True]
    assert r"$\mu = 0.1$" in axes[0].get_title("left")
    picture = draw_spacetime(run).axes
    assert "x_n" in picture[0].get_title("left") and "rad" in picture[2].get_ylabel()


def test_what_its_checks_say_has_a_meaning(run, checks):
    calm, over = (
        dict(answers.answer_questions(axes_of_panel, True))
        for axes_of_panel in (checks, check(OVER))
    )
    top = "a pendulum has gone over the top"
    assert calm[top] == "no" and over[top].startswith("yes") and "Lemma 1" not in str(calm)
    assert calm["the expansion (3) could be followed"] == "yes"
    assert answers.answer_questions(checks, False) == [
        ("motion", "the chain is at rest and stays so")
    ]


@pytest.fixture(scope="module")
def swept():
    return sweep(OVER, [2, 4], [(0, 1), (1, 2)])


def test_a_sweep_of_pendula_is_one_of_angles(swept):
    assert list(swept["quantity"].values) == ["x", "y", "pair"]
    assert swept["l2"].attrs["units"] == "rad" and swept.attrs["model"] == "pendula"
    alone = simulate(OVER.changed(half_width=4))
    peak = float(swept["linf"].sel(half_width=4, statistic="max", quantity="pair").max())
    assert peak == float(alone["linf"].max())
    axes = draw_sweep(swept).axes
    assert all(
        "(x, y)" in axes_of_panel.get_ylabel() and "(rad)" in axes_of_panel.get_ylabel()
        for axes_of_panel in axes
    )


def test_a_run_of_the_amplitudes_is_no_run_of_the_pendula():
    with pytest.raises(ConfigurationError, match="differs in model, mu"):
        check(SWING, simulate(Case(omega=-4, half_width=8, end_time=2)).assign(final=0))
