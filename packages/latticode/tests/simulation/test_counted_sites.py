"""Chains of the sites 0..N-1, of any number: against NumPy and SciPy, and what is said of them."""

import numpy as np
import pytest
import xarray as xr
from latticode import Case, Model, abs2, check, draw_spacetime, lap, simulate, survey, sweep
from latticode.configuration.files import ConfigurationError
from latticode.configuration.schema import load
from numpy_lattice import slope_of, solution

ENDS = ("dirichlet", "free", "periodic", "antiperiodic")
DNLS = "def i_dt(p, u):\n    return lap(u) + p.V * u + abs2(u) * u\n"


def dnls(p, u):
    return lap(u) + p.V * u + abs2(u) * u


def ring(sites, **keys):
    start = np.random.default_rng(sites).normal(size=(sites, 2)) @ (0.5, 0.5j)
    model = Model(fields="u", parameters={"V": lambda n: 0.1 * n}, i_dt=dnls)
    return Case(
        model=model,
        sites=sites,
        boundary=keys.pop("boundary", "periodic"),
        initial={n: [u] for n, u in enumerate(start)},
        end_time=2,
        **keys,
    ), start


@pytest.mark.parametrize("sites", [1, 2, 7, 8, 31, 32])
@pytest.mark.parametrize("boundary", ENDS)
def test_chains_of_any_length_follow_scipy(sites, boundary):
    case, start = ring(sites, boundary=boundary)
    run = simulate(case)
    assert run["site"].values.tolist() == list(range(sites))
    slope = slope_of(DNLS, {"V": 0.1 * np.arange(sites)}, boundary, 1, "i_dt")
    exact = solution(slope, start, 2.0)
    final = run["final"].values[:, 0]
    assert np.abs(final[0] + 1j * final[1] - exact).max() < 1e-10
    assert float(run["l2"][0, -1]) == pytest.approx(np.linalg.norm(exact), rel=1e-12)


@pytest.mark.parametrize("solver", ["dop853", "ode45", "crank_nicolson"])
def test_the_norms_of_an_even_number_of_sites_count_each_site(solver):
    case, start = ring(6)
    controls = {"name": solver} | ({"step": 0.0125} if solver == "crank_nicolson" else {})
    run = simulate(case.changed(solver=controls))
    assert float(run["l2"][0, 0]) == pytest.approx(np.linalg.norm(start), rel=1e-14)
    assert float(run["l2"][0, -1]) == pytest.approx(np.linalg.norm(start), rel=1e-4)


def test_a_conserved_density_is_summed_over_an_even_number_of_sites():
    def conserved(p, u):
        return {"P": abs2(u), "current": (1j * u.conj() * u.right).real}

    model = Model(fields="u", parameters={}, i_dt=lambda p, u: lap(u), conserved=conserved)
    start = np.random.default_rng(1).normal(size=(8, 2)) @ (1, 1j)
    for boundary in ("periodic", "dirichlet"):
        initial = {n: [u] for n, u in enumerate(start)}
        case = Case(model=model, sites=8, boundary=boundary, initial=initial, end_time=1)
        sums = simulate(case)["conserved"].isel(tau=0)
        right = np.roll(start, -1) if boundary == "periodic" else np.append(start[1:], 0)
        expected = [np.sum(np.abs(start) ** 2), np.sum((1j * start.conj() * right).real)]
        np.testing.assert_allclose(sums, expected, rtol=1e-13)


def test_data_that_look_even_are_not_cut_in_half():
    model = Model(fields="u", parameters={}, i_dt=lambda p, u: lap(u) + abs2(u) * u)
    settings = {"model": model, "boundary": "free", "end_time": 5}
    counted = simulate(Case(sites=9, initial={4: [1.5]}, **settings))
    centred = simulate(Case(half_width=4, initial={0: [1.5]}, **settings))
    np.testing.assert_array_equal(counted["final"].values, centred["final"].values)
    assert counted.attrs["sites"] == 9 and "half_width" not in counted.attrs


def test_checks_surveys_and_figures_take_them():
    model = Model(fields="u", parameters={"c": 1.0}, i_dt=lambda p, u: p.c * lap(u) + abs2(u) * u)
    case = Case(model=model, sites=6, boundary="periodic", initial={0: [1.5]}, end_time=5)
    checked = check(case)
    assert float(checked["largest_difference"]) < 1e-11
    assert checked["site"].values.tolist() == [0, 1, 2, 3, 4, 5]
    members = {"count": 3, "size": 1e-3, "seed": 1}
    surveyed = survey(case, {"c": [0.5, 1.0], "initial.0.0": [1.0, 2.0]}, members=members)
    assert surveyed["max_l2"].shape == (2, 2, 3, 1) and bool(np.isfinite(surveyed["max_l2"]).all())
    assert draw_spacetime(simulate(case)) is not None


def test_a_configuration_takes_them_too(tmp_path):
    (tmp_path / "mine.py").write_text(
        "from latticode import abs2, lap\nfields = ('u',)\nparameters = {'V': 0.0}\n" + DNLS
    )
    case = {"model": str(tmp_path / "mine.py"), "sites": 4, "initial": {3: [1]}}
    settings = load({"cases": {"mine": case}})
    assert settings.problem("mine")["site_count"] == 4
    with pytest.raises(ConfigurationError, match="replace it by half_width, which a sweep changes"):
        load({"cases": {"mine": case}, "sweeps": {"long": {"case": "mine", "half_widths": [9]}}})


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        ({"sites": 4, "half_width": 2}, "sites: cannot be combined with half_width"),
        ({"sites": 0}, "sites: is 0; it must be at least 1"),
        (
            {"sites": 4, "initial": {4: [1]}},
            "site 4 is outside the chain",
        ),
        ({"sites": 4, "initial": {-1: [1]}}, "is outside the chain of the sites 0 to 3"),
        ({"half_width": None}, "half_width: is empty; give half_width or sites"),
        ({"N": 4}, "give half_width, or sites in your own models"),
    ],
)
def test_what_cannot_be_a_chain_is_refused(keys, message):
    model = Model(fields="u", parameters={}, i_dt=lambda p, u: lap(u))
    with pytest.raises(ConfigurationError, match=message):
        Case(**{"model": model, "initial": {0: [1]}, **keys})


def test_a_case_changes_from_one_way_to_the_other():
    model = Model(fields="u", parameters={}, i_dt=lambda p, u: lap(u))
    case = Case(model=model, initial={0: [1]})
    assert list(case.changed(sites=3).chain) == [0, 1, 2]
    assert list(case.changed(sites=3).changed(half_width=1).chain) == [-1, 0, 1]
    with pytest.raises(ConfigurationError, match="half_width"):
        sweep(case.changed(sites=3), [2, 4], windows=[(1, 5)])
    assert isinstance(simulate(case.changed(sites=3, end_time=1)), xr.Dataset)
