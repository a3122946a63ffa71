"""Comparison of the paper's solvers: energy drift, second solver, errors against references.

Section 5 states the order of the energy drift of ode45, and that a second solver gives no
significant differences. Here all solvers integrate each case, and two datasets store the results
for figures, claims and the article.
"""

from collections.abc import Collection, Iterator, Mapping

import numpy as np
import xarray as xr
from latticode.datasets.netcdf import as_xarray
from latticode.datasets.stated import shared_by
from latticode.datasets.trajectories import trajectory_contents
from latticode.measures.difference import (
    ABSENT,
    NORMS,
    VISIBLE,
    difference,
    divergence_time,
    is_of_same_case,
    known_until,
)
from latticode.measures.norms import drift, total_power
from latticode.simulation.simulate import simulate
from replication.ledger.cutoff import Cutoff
from replication.variables import ALL_TIMES, FEW_CHOICES, PROVEN, REGULAR, SCATTERED, mark, missing

from pendula.problem import PaperProblem

FIRST, SECOND, HALVED = "ode45", "crank_nicolson", "crank_nicolson_halved"
TRIED = FIRST, SECOND, "taylor"
"""The solvers whose runs are compared with the references."""
UNKNOWNS = {"complex": FIRST, "real": "ode45_real"}
"""The paper's first solver, with complex or with real unknowns (see `integrators.ode45`)."""
STATED_DRIFT = {"small": 1e-6, "large": 1e-4}
"""The energy drift that the paper states, by the size of the initial data in the case's name."""
# ASSUME: "up to the order of 10^-k" allows up to twice that number.
ORDER = Cutoff(2.0, '"up to the order of": up to twice the number')

COMPARED = {
    "drift": "drift of the energy, |H(tau) - H(0)|",
    "of": "definition of the drift: absolute, or relative to |H(0)|",
    "largest_drift": "largest drift of the energy",
    "stated_drift": "order of the drift that the paper states",
    "second_step": "step of the second solver",
    "second_difference": "largest difference of the norms between the paper's two solvers",
    "second_divergence": "first tau at which these norms differ visibly, infinite if never",
    "second_l2": "l2 norm of the pair by the second solver",
    "visible": "visible fraction of full scale",
}
TRUSTED = {
    "horizon": f"first tau at which a norm differs visibly from the reference, {ABSENT}",
    "visible": COMPARED["visible"],
    "known_until": "last tau at which run and reference are both known",
    "l2_bound": "largest proven error bound of the certified curve in the l2 norm",
    "distance": "largest distance of the certified norms from the reference, divided by the bound",
    "late_distance": "the same distance if the certified curve is one output late",
}
"""Long names of those variables of the two datasets that are not in the registry."""
NO_REFERENCE = missing("there is no reference")
ATTRIBUTES = {
    "omega": REGULAR,
    "drift": SCATTERED,
    "largest_drift": SCATTERED,
    "stated_drift": SCATTERED | REGULAR,
    "second_step": FEW_CHOICES,
    "difference": ALL_TIMES,
    "horizon": NO_REFERENCE,
    "known_until": NO_REFERENCE,
    "l2_bound": PROVEN | REGULAR | missing("nothing is proved"),
    "distance": REGULAR,
    "late_distance": REGULAR,
}
"""Attributes of variables of the two datasets, for the comparison and the ledger."""


def measure_solvers(
    cases: Mapping[str, Mapping],
    solvers: Mapping[str, Mapping],
    references: Mapping[str, xr.Dataset],
    user_cases: Collection[str] = (),
    proofs: Mapping[str, xr.Dataset] = {},
) -> Iterator[xr.Dataset]:
    """Yield the dataset of energy drifts and of the second solver, then the dataset of all errors.

    `cases` are plain values of problems without a solver, and `solvers` has the controls of each
    solver. The paper states no drift for `user_cases`, which differ from the paper's cases.
    """
    runs = {name: run_by_all(name, case, solvers) for name, case in cases.items()}
    yield compare_solvers(runs, user_cases)
    yield trust_solvers(runs, references, proofs)


def run_by_all(name: str, case: Mapping, solvers: Mapping[str, Mapping]) -> dict[str, xr.Dataset]:
    """Return the runs of a case by all `solvers`, ode45_real, and SECOND with half of its step."""
    first, second = solvers[FIRST], solvers[SECOND]
    variants = {
        UNKNOWNS["real"]: {**first, "name": UNKNOWNS["real"]},
        HALVED: {**second, "step": 0.5 * second["step"]},
    }
    trajectories = {}
    for label, solver in {**solvers, **variants}.items():
        problem = PaperProblem.of({**case, "solver": solver, "snapshot_every": 0})
        trajectories[label] = as_xarray(*trajectory_contents(name, problem, simulate(problem)))
    return trajectories


def compare_solvers(
    runs: Mapping[str, Mapping[str, xr.Dataset]], user_cases: Collection[str] = ()
) -> xr.Dataset:
    """Return the dataset of COMPARED: energy drifts, and differences of the second solver."""
    comparisons = []
    for case, by_solver in runs.items():
        stated = np.nan if case in user_cases else STATED_DRIFT.get(case.rpartition("_")[2], np.nan)
        comparisons.append(
            xr.merge(
                [
                    _drifts(by_solver, stated),
                    _second_solver_differences(by_solver),
                    _case_variables(by_solver),
                ]
            )
        )
    title = "The paper's solvers: drift of the energy, and agreement"
    return _described(_stack(comparisons, runs).assign(visible=VISIBLE), COMPARED, runs, title)


def _drifts(runs: Mapping[str, xr.Dataset], stated: float) -> xr.Dataset:
    runs = {name: run for name, run in runs.items() if name != HALVED}
    run = runs[FIRST]
    values = np.array([drift(trajectory["energy"]) for trajectory in runs.values()])
    largest = values.max(axis=1)
    both = np.stack([largest, largest / abs(float(run["energy"][0]))], axis=1)
    return xr.Dataset(
        {
            "drift": (("solver", "tau"), values),
            "largest_drift": (("solver", "of"), both),
            "stated_drift": stated,
        },
        {"tau": run["tau"], "solver": list(runs), "of": ["absolute", "relative"]},
    )


def _second_solver_differences(runs: Mapping[str, xr.Dataset]) -> xr.Dataset:
    """Return how the norms of SECOND differ from FIRST's, for both steps, and the l2 of SECOND."""
    differences = [difference(runs[name], runs[FIRST]) for name in (SECOND, HALVED)]
    run, steps = runs[SECOND], [runs[name].attrs["solver_step"] for name in (SECOND, HALVED)]
    largest = [float(over_time.max()) for over_time in differences]
    divergence = [float(divergence_time(over_time)) for over_time in differences]
    return xr.Dataset(
        {
            "second_difference": ("second_step", largest),
            "second_divergence": ("second_step", divergence),
            "second_l2": ("tau", np.sqrt(total_power(run))),
        },
        {"tau": run["tau"], "second_step": steps},
    )


def trust_solvers(
    runs: Mapping[str, Mapping[str, xr.Dataset]],
    references: Mapping[str, xr.Dataset],
    proofs: Mapping[str, xr.Dataset] = {},
) -> xr.Dataset:
    """Return the dataset of TRUSTED: errors and horizons by case and solver.

    The horizon is NaN if a run does not solve the problem of its reference. `proofs` are certified
    curves with their error bounds; a curve is used only if it solves the same problem.
    """
    errors = [
        _trust_case(by_solver, references[case], proofs.get(case))
        for case, by_solver in runs.items()
    ]
    data = _stack(errors, runs).assign(visible=VISIBLE)
    title = "How long each solver's norms agree with the reference"
    return _described(data, TRUSTED, runs, title)


def _trust_case(
    runs: Mapping[str, xr.Dataset], reference: xr.Dataset, proved: xr.Dataset | None
) -> xr.Dataset:
    runs = {name: run for name, run in runs.items() if name in TRIED}
    errors = [
        difference(run, reference)
        if is_of_same_case(run, reference)
        else difference(run, run) * np.nan
        for run in runs.values()
    ]
    error = xr.concat(errors, xr.Variable("solver", list(runs)))
    run = next(iter(runs.values()))
    horizons = error.to_dataset().assign(
        horizon=divergence_time(error),
        known_until=known_until(error),
        **_proven(run, reference, proved),
    )
    return xr.merge([horizons, _case_variables(runs)])


def _proven(run: xr.Dataset, reference: xr.Dataset, proved: xr.Dataset | None) -> dict:
    """Return the numbers of the certified curve in TRUSTED, NaN if it is of another problem."""
    if proved is None or not is_of_same_case(run, proved):
        return dict.fromkeys(("l2_bound", "distance", "late_distance"), np.nan)
    right = reference[list(NORMS)].reindex(tau=proved["tau"], method="nearest", tolerance=1e-9)

    def distance(late: int) -> float:
        ratio = abs(proved[list(NORMS)].shift(tau=late) - right) / proved["bound"]
        return float(ratio.to_dataarray().max())

    return {
        "l2_bound": float(proved["bound"].max()),
        "distance": distance(0),
        "late_distance": distance(1),
    }


def _case_variables(runs: Mapping[str, xr.Dataset]) -> xr.Dataset:
    attributes = next(iter(runs.values())).attrs
    return xr.Dataset({"omega": float(attributes["omega"]), "initial": str(attributes["initial"])})


def _stack(by_case: list[xr.Dataset], cases: Collection[str]) -> xr.Dataset:
    """Return one dataset of the datasets of cases, joined along "case"."""
    return xr.concat(by_case, xr.Variable("case", list(cases)), join="outer")


def _described(data: xr.Dataset, names: Mapping, runs: Mapping, title: str) -> xr.Dataset:
    """Return the dataset with long names, and with the attributes that all runs share."""
    for name, long_name in names.items():
        if name in data:
            data[name].attrs = {"long_name": long_name}
    for name, attributes in ATTRIBUTES.items():
        data = mark(data, attributes, name)
    shared = shared_by([run.attrs for by_solver in runs.values() for run in by_solver.values()])
    return data.assign_attrs({**shared, "title": title})
