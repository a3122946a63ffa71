"""Small made-up datasets of the form that the simulations write: the plots need no simulation."""

import made_up_chaos
import numpy as np
import pytest
import xarray as xr
from made_up_checks import cases, chart, samples, short_chart, sweeps, threshold, windows, worst
from made_up_unbounded import spread, thermal, window_map

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
    """Return two cases by three solvers, of which Crank-Nicolson is 2 % off from the start."""
    scales = {"ode45": 1.001, "crank_nicolson": 1.02, "dop853": 1.0}
    return {
        (case, solver): make_trajectory(case, scale=scale, solver=solver)
        for case in ("fig2_small", "fig2_large")
        for solver, scale in scales.items()
    }


@pytest.fixture(scope="session")
def make_sweep():
    """Return a function: a sweep whose every number tells where in the dataset it stands."""

    def make(omega=-4.0):
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
            | {"omega": omega},
        )

    return make


def own_checks(second):
    """Return of a case's checks what its figure shows: a second run, and when they part."""
    norms = second[["linf", "l2"]].rename(linf="second_linf", l2="second_l2")
    return norms.assign(parting=variable((), 2.0, "first tau at which the runs differ"))


@pytest.fixture(scope="session")
def gathered(make_trajectory, trajectories, make_sweep):
    """Return what every module draws: {module name: dataset}."""
    from pendula.studies.chaos import (
        figure_ensembles as ensembles,
    )
    from pendula.studies.chaos import (
        figure_lyapunov as lyapunov,
    )
    from pendula.studies.chaos import (
        figure_symmetry as symmetry,
    )
    from pendula.studies.own import (
        figure_norms as own_norms,
    )
    from pendula.studies.own import (
        figure_spacetime as own_spacetime,
    )
    from pendula.studies.own import (
        figure_sweep as own_sweep,
    )
    from pendula.studies.paper import (
        figure_agreement as agreement,
    )
    from pendula.studies.paper import (
        figure_chain as chain_drawing,
    )
    from pendula.studies.paper import (
        figure_energy as energy,
    )
    from pendula.studies.paper import (
        figure_trust as trust,
    )
    from pendula.studies.paper import (
        figures_norms as norms,
    )
    from pendula.studies.paper import (
        figures_spacetime as spacetime,
    )
    from pendula.studies.paper import figures_sweeps as sweep_plot
    from pendula.studies.theory import (
        figure_bounds as bounds,
    )
    from pendula.studies.theory import (
        figure_growth_rates as growth_rates,
    )
    from pendula.studies.theory import (
        figure_stability_chart as stability_chart,
    )
    from pendula.studies.unbounded import figure_front as front
    from pendula.studies.unbounded import figure_growth_law as growth_law
    from pendula.studies.unbounded import figure_window_map as map_plot

    pair = (make_trajectory(), make_trajectory("fig2_large", scale=5.0))
    true = make_trajectory(end_time=5.0, scale=1.02)
    panels = (make_sweep(-4.0), make_sweep(0.0))
    long, short = chart(), short_chart()
    points = [(8, 1), (-4, 1), (0, 1)]
    return {
        "agreement": agreement.gather(trajectories),
        "chain_drawing": chain_drawing.gather(),
        "energy": energy.gather(trajectories),
        "norms": norms.gather(pair, [true, true]),
        "spacetime": spacetime.gather(*pair),
        "own_norms": own_norms.gather(pair[0], own_checks(true)),
        "own_spacetime": own_spacetime.gather(pair[0]),
        "own_sweep": own_sweep.gather(panels[0], mean_window="[10, 40]"),
        "sweeps": sweep_plot.gather(*panels, "[10, 70]", "[10, 40]"),
        "stability_chart": stability_chart.gather(long, short, windows(), points),
        "growth_rates": growth_rates.gather(long, short, threshold()),
        "trust": trust.gather(trajectories, {"fig2_small": true, "fig2_large": true}),
        "bounds": bounds.gather(cases(), sweeps(), samples(), worst()),
        "lyapunov": lyapunov.gather(made_up_chaos.lyapunov()),
        "symmetry": symmetry.gather(made_up_chaos.symmetry(), made_up_chaos.lyapunov()),
        "ensembles": ensembles.gather(
            made_up_chaos.ensembles(),
            dict(zip(made_up_chaos.CASES, pair, strict=True)),
            dict(zip(made_up_chaos.CASES, pair, strict=True)),
            dict(zip(made_up_chaos.SWEEPS, panels, strict=True)),
            dict(zip(made_up_chaos.SWEEPS, ["[10, 50]", "[10, 70]"], strict=True)),
        ),
        "growth_law": growth_law.gather(
            {"fig4_small": spread(0.5), "fig2_large": spread(0.0, members=1, omegas=(8.0,))},
            thermal(),
        ),
        "front": front.gather(
            spread(0.5, variants=3, omegas=(-1.0, 2.0, 5.0)),
            spread(0.5),
            spread(0.5, omegas=(-4.0,)),
            thermal(),
        ),
        "window_map": map_plot.gather({"fig5_left": window_map(8.0), "fig5_right": window_map()}),
    }
