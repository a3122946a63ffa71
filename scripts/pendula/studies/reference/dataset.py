"""A verified reference as a dataset: multiprecision numbers, each rounded once to double."""

import numpy as np

from pendula.datasets.netcdf import Variable
from pendula.datasets.trajectories import COMPONENTS, describe_run
from pendula.problem import Problem
from pendula.simulation.lattice import Reduction, spread

from .run import Run
from .verify import Discrepancy

MIRRORED = Reduction(even=True, synchronised=False)


def as_variables(run: Run, apart: Discrepancy) -> dict[str, Variable]:
    """Return the variables; times are exact, `amplitude` may start any run as an exact state."""
    series = ("component", "tau")
    reach = run.amplitude.shape[2] - 1
    return {
        "tau": Variable(("tau",), run.tau, "slow time"),
        "component": COMPONENTS,
        "linf": Variable(series, run.linf.astype(float), "l-infinity norm over the chain"),
        "l2": Variable(series, run.l2.astype(float), "l2 norm over the chain"),
        "energy": Variable(("tau",), run.energy.astype(float), "energy H of equation (8)"),
        "discrepancy": Variable(
            ("tau",), apart.norms, "largest difference of a norm from that of the second run"
        ),
        "part": Variable(("part",), ["re", "im"], "part of the amplitude"),
        "site": Variable(("site",), np.arange(-reach, reach + 1), "site of the chain"),
        "snapshot_tau": Variable(("snapshot",), run.snapshot_tau, "slow time of the snapshots"),
        "amplitude": Variable(
            ("part", "component", "site", "snapshot"), _amplitude(run), "amplitude on a site"
        ),
        "amplitude_discrepancy": Variable(
            ("snapshot",), apart.amplitude, "largest difference from the second run's amplitudes"
        ),
    }


def _amplitude(run: Run) -> np.ndarray:
    """Return amplitudes (part, component, site, snapshot) on the whole chain, in doubles."""
    rows = run.amplitude.astype(float).transpose(1, 2, 0)
    return np.stack([spread(rows[part::2], MIRRORED) for part in (0, 1)])


def as_case(name: str, problem: Problem, run: Run, check: Run, apart: Discrepancy, decimal: bool):
    """Return the attributes: the case, the controls of both runs, what they agree on."""
    return {
        **describe_run(name, problem, {"name": "heyoka", **_controls(run)}),
        **{f"second_run_{key}": value for key, value in _controls(check).items()},
        "parameters_mean": "the printed decimals" if decimal else "the doubles nearest to them",
        "energy_drift": apart.energy_drift,
        "largest_discrepancy": float(apart.norms.max()),
    }


def _controls(run: Run) -> dict:
    return {
        "bits": run.bits,
        "order": run.order,
        "tolerance": run.tolerance,
        "steps": run.steps,
    }
