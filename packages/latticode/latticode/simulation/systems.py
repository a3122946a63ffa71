"""Runs of a traced model: its kernels, what they are given, and what is kept of a run."""

import json
from functools import cache, partial
from typing import Any

import numpy as np

from latticode.equations.ends import ANTIPERIODIC, PERIODIC, ends_of, kind_of
from latticode.equations.graph import evaluate
from latticode.equations.model import Model
from latticode.equations.model_file import values_at
from latticode.generation.modules import conserved_text, load_text, module_text, parts_of_rates
from latticode.generation.statements import Parts, parts_of
from latticode.generation.toolbox import Sums, System
from latticode.integrators import crank_nicolson, dop853, kahan_li, ode45
from latticode.kernels.simd import LANES
from latticode.numerics import elementary
from latticode.numerics.elementary import complex_of, modulus

from .feasibility import rates_of, solver_names
from .integration import ITERATED, Integration, Solver, Words
from .lattice import Reduction, choose_ends, find_reduction, unfold
from .observables import blank_state_record
from .problem import Problem

PADDING = {None: "constant", (0, -1): "symmetric", (-1, 0): "wrap"}
"""How numpy.pad goes on beyond the ends of a chain, by the sites that these see."""
EXPLICIT = ("rtol", "atol")
SOLVERS = {
    "taylor": ("continue_series", EXPLICIT, None),  # the generated module has its number
    "dop853": ("rates", EXPLICIT, dop853.WORK),
    "ode45": ("rates", EXPLICIT, ode45.WORK),
    "kahan_li": ("rates", ("step",), kahan_li.WORK),
    "crank_nicolson": ("rates", ITERATED, crank_nicolson.WORK),
}
"""Of each solver its rule of a generated module, its controls, and the number of work arrays."""
USED = {
    "latticode.integrators": "crank_nicolson, dop853, kahan_li, ode45",
    "latticode.simulation.observables": "observe_angles, observe_fields",
}
"""What the runs of a generated module take from the library."""
RUN = """
solve_{name} = {name}.build({rule}, {observe}{time})
@kernel
def run_{name}(system, y, times, controls, work, record, stop):
    return solve_{name}(system, y, times, controls, work, record, stop)
"""


@cache
def kernels_of(model: Model, site_dependent: frozenset[str]):
    """Return the generated module of a model some of whose parameters depend on the site.

    No chain goes in tiles: their margins are made for equations that look one site far.
    """
    observe = "observe_angles" if model.real else "observe_fields"
    head = "".join(f"\nfrom {module} import {names}\n" for module, names in USED.items())
    text = module_text(model.rates, model.reach, site_dependent) + head
    if model.conserved:
        text, observe = text + conserved_text(model, site_dependent, observe), "observe"
    about = {"observe": observe, "time": ", at_time=at_time" if model.driven else ""}
    runs = [RUN.format(name=name, rule=SOLVERS[name][0], **about) for name in solver_names(model)]
    return load_text("".join([text, *runs]))


def solvers_of(problem: Problem) -> dict[str, Solver]:
    """Return the solvers that take the model of a problem."""
    made = kernels_of(problem.model, site_dependent(problem))
    return {
        name: Solver(getattr(made, f"run_{name}"), SOLVERS[name][1], SOLVERS[name][2] or made.WORK)
        for name in solver_names(problem.model)
    }


def parameters_of(problem: Problem) -> dict[str, float | np.ndarray]:
    """Return the value of each parameter: a number, or an array (site,) of one for each site.

    Raises ValueError with the name of one that has none.
    """
    found = {}
    for name, given in {**problem.model.parameters, **problem.parameters}.items():
        try:
            value = values_at(given, problem.half_width)
        except ValueError as error:
            raise ValueError(f"parameter {name} {error}") from None
        found[name] = value if np.ndim(value) == 0 else np.array(value)
    return found


def site_dependent(problem: Problem) -> frozenset[str]:
    """Return the names of the parameters that depend on the site."""
    return frozenset(name for name, value in parameters_of(problem).items() if np.ndim(value))


def find_reduction_of(problem: Problem) -> Reduction:
    """Return whether half of the chain has the bits of the whole.

    It has where data, equations and parameters are the same with left and right exchanged.
    """
    alike = problem.model.even and not site_dependent(problem)
    alike = alike and kind_of(problem.boundary) != ANTIPERIODIC  # its far half has another sign
    even = alike and problem.half_width >= 2 * problem.model.reach
    return Reduction(even and find_reduction(problem.amplitudes).even, synchronised=False)


def make_system(problem: Problem, reduction: Reduction) -> System:
    """Return what the kernels of a model take for its parameters, at time 0."""
    model = problem.model
    sites = problem.half_width + 1 if reduction.even else problem.sites
    parts = parts_of_rates(model.rates, site_dependent(problem))
    constants, at_sites = _values(problem, parts)
    wide = np.zeros((2 * len(model.fields), sites + 2 * model.reach))
    clocks = (0.0,) * 2 * len(parts.clocks)
    ends = choose_ends(problem.boundary, reduction)
    return System(constants, clocks, at_sites, wide, _sums(problem), *ends)


def _sums(problem: Problem) -> Sums:
    """Return what the densities of a model are given: see Sums."""
    model, reach = problem.model, problem.model.reach_of_densities
    if not model.conserved:
        return Sums((), *np.zeros((3, 1, 3)))
    margin = reach if ends_of(problem.boundary).sees is None else 0
    sites = problem.sites + 2 * margin
    parts = parts_of(model.conserved.values(), site_dependent(problem))
    constants, at_sites = _values(problem, parts, margin)
    wide = np.zeros((2 * len(model.fields), sites + 2 * reach))
    return Sums(constants, at_sites, wide, np.zeros((len(model.conserved), sites + 2)))


def _values(
    problem: Problem, parts: Parts, margin: int = 0
) -> tuple[tuple[float, ...], np.ndarray]:
    """Return constants, and what depends on the site, with so many sites more beyond each end."""
    values = parameters_of(problem)

    def leaf(one):
        if one.operation == "number":
            return one.operands[0]
        name, by = one.operands
        value = values[name]
        return value if np.ndim(value) == 0 else moved(value, by, problem.boundary)

    constants = tuple(map(float, evaluate(parts.constants, leaf, elementary)))
    count = problem.sites + 2 * margin
    at_sites = np.zeros((max(1, len(parts.at_sites)), count + 2 + 2 * LANES))
    for row, value in enumerate(evaluate(parts.at_sites, leaf, elementary)):
        at_sites[row, 1 : 1 + count] = np.pad(value, margin, "edge")
    return constants, at_sites


def moved(values: np.ndarray, by: int, boundary: str) -> np.ndarray:
    """Return the values at the sites n + by; beyond an end that of the last site, or of a ring."""
    places = np.arange(values.size) + by
    if kind_of(boundary) in (PERIODIC, ANTIPERIODIC):
        return values[places % values.size]
    return values[np.clip(places, 0, values.size - 1)]


PARTS = {"i_dt": ("re", "im"), "dt": ("value",), "d2_dt2": ("value", "rate")}
"""The parts of the state of a field, by the function that gives the equations."""
WORDS = {
    "i_dt": Words(),
    "dt": Words(
        part="value of a field",
        final="value of a field at the end time",
        state="value of a field at the snapshots",
    ),
    "d2_dt2": Words(
        part="value of a field, and its rate",
        final="value of a field, and its rate, at the end time",
        state="value of a field, and its rate, at the snapshots",
    ),
}


def integration_of(problem: Problem) -> Integration:
    """Return how a problem is integrated: as its model declares it, or as follows from its trace.

    Kernels are compiled when they are first run.
    """
    model = problem.model
    return model.integration or Integration(
        components=model.fields,
        parts=PARTS[model.form],
        solvers=solvers_of(problem),
        system=make_system,
        collect=_collect,
        rates=lambda problem, peak: rates_of(model, problem.parameters, peak),
        describe=_describe,
        record=partial(blank_state_record, quantities=len(model.conserved)),
        find_reduction=find_reduction_of,
        words=WORDS[model.form],
    )


def _collect(problem: Problem, record, y: np.ndarray, cut: Reduction) -> dict[str, Any]:
    real, count = problem.model.real, len(PARTS[problem.model.form])
    parts = np.array([unfold(y[part::2, 1:-1], cut) for part in range(count)])
    snapshots = np.array([unfold(part, cut) for part in record.kept[:count]])
    return {
        "energy": record.energy,
        "modulus": np.abs(snapshots[0]) if real else modulus(complex_of(*snapshots)),
        "final": parts if real else complex_of(*parts),
        "state": snapshots,
        "conserved": dict(zip(problem.model.conserved, record.conserved, strict=True)),
    }


def _describe(problem: Problem) -> dict[str, Any]:
    return {
        "parameters": json.dumps(parameters_of(problem), default=np.ndarray.tolist),
        "model": problem.model.name,
        "model_text": problem.model.text,
    }
