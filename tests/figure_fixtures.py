"""Small made-up datasets of the form that the simulations write: the plots need no simulation."""

import made_up_chaos
import numpy as np
import pytest
import xarray as xr
from made_up_checks import (
    cases,
    chain_growth,
    chart,
    samples,
    sharpness,
    short_chart,
    sweeps,
    threshold,
    windows,
    worst,
)
from made_up_unbounded import spread, thermal, window_map
from problems import problem_of

HALF_WIDTHS = [5, 10, 20]
PARAMETERS = {
    "epsilon": 1.0,
    "gamma": 1.0,
    "half_width": 2,
    "boundary": "dirichlet",
    "output_step": 0.5,
    "initial": '{"0": [1.0, 0.1]}',
}
WINDOWS = ["[10, 50]", "[10, 70]", "[10, 40]"]


def variable(dims, values, name):
    return dims, values, {"long_name": name, "units": "1"}


@pytest.fixture(scope="session")
def make_trajectory():
    """Return a function: a trajectory of 11 times, 5 sites, whose curves grow like `scale`."""

    def make(case="fig2_small", omega=8.0, scale=1.0, solver="ode45", end_time=5.0):
        tau = np.linspace(0, end_time, 11)
        norms = scale * np.array([2 + np.cos(tau), 1 + np.sin(tau) ** 2])
        modulus = norms[:, None, ::2] * np.exp(-np.abs(np.arange(-2, 3)))[None, :, None]
        return xr.Dataset(
            {
                "linf": variable(("component", "tau"), norms, "l-infinity norm"),
                "l2": variable(("component", "tau"), 3 * norms, "l2 norm"),
                "energy": variable("tau", 7 - 1e-7 * scale * tau, "energy"),
                "modulus": variable(("component", "site", "snapshot"), modulus, "modulus"),
                "snapshot_tau": variable("snapshot", tau[::2], "slow time of the snapshots"),
            },
            {
                "tau": variable("tau", tau, "slow time"),
                "component": variable("component", ["A", "B"], "component"),
                "site": variable("site", np.arange(-2, 3), "site"),
            },
            PARAMETERS | {"case": case, "omega": omega, "solver": solver},
        )

    return make


@pytest.fixture(scope="session")
def trajectories(make_trajectory):
    """Return two cases by four solvers; the implicit solvers are 2 % off from the start."""
    scales = {
        "ode45": 1.001, "crank_nicolson": 1.02, "delfour_fortin_payre": 1.02, "dop853": 1.0,
    }  # fmt: skip
    return {
        (case, solver): make_trajectory(case, scale=scale, solver=solver)
        for case in ("fig2_small", "fig2_large")
        for solver, scale in scales.items()
    }


@pytest.fixture(scope="session")
def make_sweep():
    """Return a function: a sweep whose every number tells where in the dataset it stands."""

    def make(omega=-4.0, case="fig5_left"):
        dims = ("half_width", "quantity", "statistic", "window")
        coordinates = (HALF_WIDTHS, ["A", "B", "pair"], ["max", "mean"], WINDOWS)
        shape = tuple(len(values) for values in coordinates)
        l2 = 1.0 + np.arange(np.prod(shape)).reshape(shape)
        return xr.Dataset(
            {"l2": variable(dims, l2, "l2 norm"), "linf": variable(dims, l2 / 100, "linf norm")},
            {
                dim: variable(dim, values, dim)
                for dim, values in zip(dims, coordinates, strict=True)
            },
            {key: PARAMETERS[key] for key in ("epsilon", "gamma", "boundary", "initial")}
            | {"omega": omega, "case": case, "solver": "ode45"},
        )

    return make


def own_checks(second):
    """Return of a case's checks what its figure shows: a second run, and when they part."""
    norms = second[["linf", "l2"]].rename(linf="second_linf", l2="second_l2")
    return norms.assign(divergence_time=variable((), 2.0, "first tau at which the runs differ"))


def certified_curve(case, omega):
    """Return a certified curve of a short chain, which takes no longer than to make one up."""
    from pendula.datasets.netcdf import as_xarray
    from pendula.problem import Constants, Problem
    from pendula.studies.certified.contents import curve_contents

    problem = Problem(
        constants=Constants(epsilon=1.0, gamma=1.0, omega=omega),
        half_width=2,
        boundary="dirichlet",
        initial=np.array([[1.0], [0.1]]),
        end_time=1.0,
        output_step=0.5,
        solver={"name": "polynomials"},
    )
    known = as_xarray(*curve_contents(case, problem))
    return as_xarray(*curve_contents(case, problem, reference=known))


def pendula_threshold():
    """Return the threshold of the pendula, which is computed as fast as it could be made up."""
    from pendula.datasets.netcdf import as_xarray
    from pendula.studies.pendula.threshold import threshold_contents

    mus, curve = [0.1, 0.3], np.linspace(-8.0, 12.0, 41)
    grid = [-4.0, -1.0, 5.0, 8.0], mus, 30, [-4.0, 0.0, 8.0], [0.0, 2.0, 3.0], curve
    return as_xarray(*threshold_contents(1.0, *grid))


def pendula_remainder():
    """Return made-up errors of the expansion, and horizons of which one is beyond its run."""
    mus, ends = np.array([0.4, 0.2, 0.1, 0.05]), np.array([0.5, 1.0, 2.0])
    over = ("expansion", "case", "mu", "end")
    errors = np.array([mus**3, mus**5])[:, None, :, None] * np.array([[2.0], [9.0]])[..., None]
    errors = errors * ends
    horizons = 1.0 / errors[..., 0]
    horizons[1, 0, 3] = np.inf
    error = variable(over, errors, "error of an angle")
    error[2]["units"] = "rad"
    return xr.Dataset(
        {
            "error": error,
            "order": variable(("expansion", "case", "end"), 3.0 + 0.0 * errors[:, :, 0], "order"),
            "visible_from": variable(over[:3], horizons, "slow time"),
            "omega": variable(("case",), [0.0, 8.0], "detuning Omega"),
        },
        {
            "expansion": variable("expansion", ["leading", "corrected"], "order of the expansion"),
            "case": variable("case", ["fig4_small", "fig2_large"], "case"),
            "mu": variable("mu", mus, "small parameter mu"),
            "end": variable("end", ends, "end of the time window"),
        },
        {"common_end": 1.0},
    )  # fmt: skip


def pendula_phases():
    """Return norms of two cases as pendula: short runs are as fast as made-up numbers."""
    from pendula.datasets.netcdf import as_xarray
    from pendula.studies.pendula.phases import measure_phases

    problems = {name: short_case(name) for name in ("fig2_small", "fig4_large")}
    return as_xarray(*measure_phases(problems, [0.1, 0.3], 2, "fig2_small", 1e-6, 1, 1))


def pendula_sea():
    """Return a sea of two members, and who of them goes over the top."""
    from pendula.datasets.netcdf import as_xarray
    from pendula.studies.pendula.over_the_top import measure_over_the_top
    from pendula.studies.pendula.sea import measure_sea

    problem, few = short_case("fig4_small"), (1e-3, 2, 1)
    sea = measure_sea(problem, [0.15], (2.0, 5.0), *few)
    passages = measure_over_the_top(problem, [0.15, 0.3], 8, *few, settled=1.0)
    return as_xarray(*sea), as_xarray(*passages)


def short_case(name):
    """Return a case of the paper on a short chain and for a short time."""
    loose = {"name": "taylor", "rtol": 1e-6, "atol": 1e-6}
    return problem_of(name, half_width=4, end_time=5.0, output_step=0.5, solver=loose)


@pytest.fixture(scope="session")
def swept_pairs(make_sweep):
    """Return a sweep by two solvers that agree."""
    return {"fig5_left": (make_sweep(-4.0), make_sweep(-4.0))}


@pytest.fixture(scope="session")
def gathered(make_trajectory, trajectories, make_sweep, swept_pairs):
    """Return what every figure draws, by the name of the figure."""
    from pendula.own_cases import figures as own
    from pendula.studies.certified import figures as certified
    from pendula.studies.chaos import figures as chaos
    from pendula.studies.chaos import lifetimes_figure
    from pendula.studies.chaos.ensembles import compare
    from pendula.studies.paper import chain_figure, figures, solvers
    from pendula.studies.pendula import (
        over_the_top_figure,
        phases_figure,
        remainder_figure,
        threshold_figure,
    )
    from pendula.studies.theory import bounds_figure
    from pendula.studies.theory import figures as theory
    from pendula.studies.unbounded import figures as unbounded
    from pendula.studies.unbounded import front_figure
    from pendula.studies.unbounded.front import measure_front
    from pendula.studies.unbounded.long_runs import measure_growth

    pair = (make_trajectory(), make_trajectory("fig2_large", scale=5.0))
    true = make_trajectory(end_time=5.0, scale=1.02)
    panels = (make_sweep(-4.0), make_sweep(0.0, "fig5_right"))
    leaving = (pair[0], make_trajectory("fig4_large", omega=0.0, scale=5.0))
    left = [pair[0], make_trajectory("fig4_large", omega=0.0, scale=5.1)]
    ensembles = made_up_chaos.ensembles()
    long, short = chart(), short_chart()
    references = {"fig2_small": true, "fig2_large": true}
    by_solvers = solvers.compare(trajectories, swept_pairs)
    maps = {"fig5_left": window_map(8.0), "fig5_right": window_map()}
    of_cases = dict(zip(made_up_chaos.CASES, pair, strict=True))
    of_sweeps = dict(zip(made_up_chaos.SWEEPS, panels, strict=True))
    named = dict(zip(made_up_chaos.SWEEPS, ["[10, 50]", "[10, 70]"], strict=True))
    compared = compare(ensembles, of_cases, of_cases, of_sweeps, named)
    runs = {"fig4_small": spread(0.5), "fig2_large": spread(0.0, members=1, omegas=(8.0,))}
    omegas = spread(0.5, variants=3, omegas=(-1.0, 2.0, 5.0))
    large = spread(0.5, omegas=(-4.0,))
    points = [(8, 1), (-4, 1), (0, 1)]
    return {
        "agreement": figures.gather_agreement(by_solvers),
        "chain": chain_figure.gather(),
        "drift": figures.gather_drift(by_solvers),
        "norms": figures.gather_norms(leaving, left, ensembles),
        "spacetime": figures.gather_spacetime(pair, figures.gather_norms(pair, [true, pair[1]])),
        "own_norms": own.gather_norms(pair[0], own_checks(true)),
        "own_spacetime": own.gather_spacetime(pair[0]),
        "own_sweep": own.gather_sweep(panels[0], mean_window="[10, 40]"),
        "sweeps": figures.gather_sweeps(*panels, "[10, 70]", "[10, 40]", ensembles=ensembles),
        "stability_chart": theory.gather_chart(long, short, windows(), points),
        "growth_rates": theory.gather_rates(long, short, threshold()),
        "pendula_threshold": threshold_figure.gather_threshold(pendula_threshold()),
        "certified_curves": certified.gather_curves(
            [certified_curve("fig2_small", 8.0), certified_curve("fig3_small", -4.0)]
        ),
        "pendula_remainder": remainder_figure.gather_remainder(pendula_remainder()),
        "pendula_phases": phases_figure.gather_phases(pendula_phases()),
        "pendula_over_the_top": over_the_top_figure.gather_over_the_top(*pendula_sea(), thermal()),
        "trust": figures.gather_trust(solvers.trust(trajectories, references)),
        "bounds": bounds_figure.gather_bounds(
            cases(), sweeps(), samples(), worst(), sharpness(), chain_growth()
        ),
        "lyapunov": chaos.gather_lyapunov(made_up_chaos.lyapunov()),
        "symmetry": chaos.gather_symmetry(made_up_chaos.symmetry(), made_up_chaos.lyapunov()),
        "ensembles": chaos.gather_ensembles(ensembles, compared),
        "lifetimes": lifetimes_figure.gather_lifetimes(made_up_chaos.lifetimes()),
        "growth_law": measure_growth(runs, thermal()),
        "front": front_figure.gather_front(measure_front(omegas, spread(0.5), large, thermal())),
        "window_map": unbounded.gather_window_map([*maps.values()], [*maps], [50.0, 50.0]),
    }
