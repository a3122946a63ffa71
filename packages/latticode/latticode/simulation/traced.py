"""Equations of a traced model: its kernels, their parameters, and the results of a run."""

import json
from collections.abc import Callable, Iterable, Sequence
from functools import cache, cached_property, partial
from types import ModuleType
from typing import Any

import numpy as np

from latticode.equations.ends import ANTIPERIODIC, PERIODIC, ends_of, kind_of
from latticode.equations.graph import Node, evaluate
from latticode.equations.initial_values import InitialValueProblem
from latticode.equations.model import Model
from latticode.generation.batches import REACH
from latticode.generation.modules import (
    HEAD,
    batches_text,
    conserved_text,
    inputs_of_rates,
    load_text,
    module_text,
)
from latticode.generation.statements import ModelInputs, inputs_of
from latticode.generation.toolbox import Couplings, DensityWorkspace, System
from latticode.integrators.method import Method
from latticode.integrators.methods import METHODS, NAMED, methods_taking
from latticode.kernels.simd import LANES
from latticode.numerics import elementary
from latticode.numerics.elementary import complex_of, modulus

from .equations import BatchInputs, CompiledMethod, Equations, ResultNames
from .feasibility import rates_of
from .lattice import Reduction, choose_ends, find_reduction, unfold
from .observables import ObservableRecord, blank_record

PADDING = {None: "constant", (0, -1): "symmetric", (-1, 0): "wrap"}
"""The mode of numpy.pad that appends the values beyond the ends, by `Ends.sees`."""
HEAD_OF_RUNS = """
from latticode.integrators.methods import NAMED
from latticode.kernels.compiled import kernel
"""
RUN = """
solve_{name} = NAMED["{name}"].build({rule}, {observe}{more})
@kernel
def run_{name}(system, y, times, controls, work, record, stop):
    return solve_{name}(system, y, times, controls, work, record, stop)
"""
RUN_LONG = """
solve_long = NAMED["{name}"].long_chains().build(
    {rule}, {observe}, {reach}, stays_at_rest={stays_at_rest}{more})
@kernel
def run_long(system, y, times, controls, work, record, stop):
    return solve_long(system, y, times, controls, work, record, stop)
"""
OBSERVERS = "from latticode.simulation.observables import observe_angles, observe_fields\n"
TILES = ", can_be_tiled=can_be_tiled, system_of_tile=system_of_tile"


def runs_text(methods: Iterable[Method], observe: str, driven: bool, in_tiles: bool = False) -> str:
    """Return the source text of a function `run_<method>` for each method.

    The module with this text must also define `observe` and the rules of the methods. It must
    define `at_time` if `driven`, and `can_be_tiled` and `system_of_tile` if `in_tiles`.
    """
    texts = []
    for method in methods:
        more = ", at_time=at_time" * driven + TILES * (in_tiles and method.takes_tiles)
        names = {"name": method.name, "rule": method.rule, "observe": observe, "more": more}
        texts.append(RUN.format(**names))
    return HEAD_OF_RUNS + "".join(texts)


def load_long_run(home: str, model: Model, observe: str, method: Method) -> Callable:
    """Return the method's variant for long chains, with the kernels of the module `home`."""
    properties = {"reach": model.reach, "stays_at_rest": model.stays_at_rest}
    names = {"name": method.name, "rule": method.rule, "observe": observe}
    text = RUN_LONG.format(**names, **properties, more=", at_time=at_time" * model.driven)
    # kernels are recompiled if an import changes; the imports of a generated `home` are repeated,
    # because only those of files of the library are followed
    head = f"{HEAD}{OBSERVERS}from {home} import *\n"
    return load_text(head + HEAD_OF_RUNS + text).run_long


def compiled_method(
    runs: ModuleType, model: Model, observe: str, method: Method, in_tiles: bool
) -> CompiledMethod:
    """Return a method with the kernels of the module `runs`."""
    by_series = method.rule == "continue_series"
    load_long = partial(load_long_run, runs.__name__, model, observe, method)
    return CompiledMethod(
        method,
        getattr(runs, f"run_{method.name}"),
        getattr(runs, "WORK", 0) if by_series else 0,
        in_tiles,
        load_long if by_series and not model.matrices else None,
    )


def load_runs(home: str, model: Model, names: Iterable[str]) -> dict[str, CompiledMethod]:
    """Return the methods of these names with the kernels of the module `home`, by name.

    The module defines `observe`, the rules of the methods, `can_be_tiled`, `system_of_tile`, and
    `at_time` if the model is driven. Its `WORK`, if defined, is the number of work arrays of a
    power series.
    """
    methods = [NAMED[name] for name in names]
    text = f"from {home} import *\n" + runs_text(methods, "observe", model.driven, in_tiles=True)
    runs = load_text(text)
    return {
        method.name: compiled_method(runs, model, "observe", method, in_tiles=True)
        for method in methods
    }


def norms_of(model: Model) -> str:
    """Return the name of the function that stores the norms of a model's fields."""
    return "observe_angles" if model.real else "observe_fields"


def observer_of(model: Model) -> str:
    """Return the name of the function that stores all observables of a model."""
    return "observe" if model.conserved else norms_of(model)


@cache
def kernels_of(model: Model, site_dependent: frozenset[str]) -> ModuleType:
    """Return the generated module of a model with some site-dependent parameters.

    Chains are not divided into tiles: the margins of tiles suffice only for nearest neighbours.
    """
    observe = observer_of(model)
    text = module_text(model.rates, model.reach, site_dependent) + OBSERVERS
    if model.conserved:
        text += conserved_text(model, site_dependent, norms_of(model))
    methods = [METHODS[name] for name in methods_taking(model)]
    return load_text(text + runs_text(methods, observe, model.driven))


@cache
def batches_of(model: Model, site_dependent: frozenset[str]) -> ModuleType:
    """Return the generated module of a model for batches of runs."""
    return load_text(batches_text(model.rates, site_dependent, norms_of(model)))


def make_system(problem: InitialValueProblem, reduction: Reduction) -> System:
    """Return the argument `system` of the kernels of a model, at time 0."""
    model = problem.model
    sites = problem.half_width + 1 if reduction.even else problem.sites
    inputs = inputs_of_rates(model.rates, problem.site_dependent)
    constants, at_sites = _values(problem, inputs)
    wide = np.zeros((2 * len(model.fields), sites + 2 * model.reach))
    clocks = (0.0,) * 2 * len(inputs.clocks)
    ends = choose_ends(problem.boundary, reduction)
    couplings = _couplings(problem, inputs, sites)
    densities = _density_workspace(problem)
    return System(constants, clocks, at_sites, wide, densities, couplings, *ends)


DENSE = 0.25
"""A matrix with a larger fraction of nonzero entries is multiplied in full, which is faster."""


def _couplings(problem: InitialValueProblem, inputs: ModelInputs, sites: int) -> Couplings:
    """Return the coupling matrices of a model, and memory for the vectors they multiply."""
    values, names = problem.parameter_values, sorted(problem.model.matrices)
    count, padded = max(1, len(inputs.couples)), -(-sites // LANES) * LANES
    matrices = [values[name] for name in names]
    entries = _flat_entries(matrices, sites)
    in_full = any(len(matrix["rows"]) > DENSE * sites * sites for matrix in matrices)
    dense = np.zeros((len(names), sites, sites) if in_full else (1, 1, 1))
    for number, matrix in enumerate(matrices if in_full else []):
        dense[number, matrix["columns"], matrix["rows"]] = matrix["weights"]
    by_site, by_block = np.zeros((2, count, sites + 2)), np.zeros((2, count, padded))
    return Couplings(dense, *entries, *by_site, *by_block)


def _flat_entries(matrices: list, sites: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return weights and columns of all matrices in sequence, and the first index of each row."""
    starts, before = np.zeros((max(1, len(matrices)), sites + 1), np.int64), 0
    for number, matrix in enumerate(matrices):
        starts[number] = before + np.searchsorted(matrix["rows"], np.arange(sites + 1))
        before += len(matrix["rows"])
    weights = [weight for matrix in matrices for weight in matrix["weights"]]
    columns = [column for matrix in matrices for column in matrix["columns"]]
    return np.array([*weights, 0.0]), np.array([*columns, 0], np.int64), starts


def _density_workspace(problem: InitialValueProblem) -> DensityWorkspace:
    """Return the workspace of the densities of conserved quantities."""
    model, reach = problem.model, problem.model.reach_of_densities
    if not model.conserved:
        return DensityWorkspace((), *np.zeros((3, 1, 3)))
    margin = reach if ends_of(problem.boundary).sees is None else 0
    sites = problem.sites + 2 * margin
    inputs = inputs_of(model.conserved.values(), problem.site_dependent)
    constants, at_sites = _values(problem, inputs, margin)
    wide = np.zeros((2 * len(model.fields), sites + 2 * reach))
    return DensityWorkspace(constants, at_sites, wide, np.zeros((len(model.conserved), sites + 2)))


def _values(
    problem: InitialValueProblem, inputs: ModelInputs, margin: int = 0
) -> tuple[tuple[float, ...], np.ndarray]:
    """Return constants, and values by site (row, column) with `margin` sites beyond each end."""
    values = problem.parameter_values

    def leaf(node: Node) -> Any:
        if node.operation == "number":
            return node.operands[0]
        name, by = node.operands
        value = values[name]
        return value if np.ndim(value) == 0 else moved(value, by, problem.boundary)

    constants = tuple(map(float, evaluate(inputs.constants, leaf, elementary)))
    count = problem.sites + 2 * margin
    at_sites = np.zeros((max(1, len(inputs.at_sites)), count + 2 + 2 * LANES))
    for row, value in enumerate(evaluate(inputs.at_sites, leaf, elementary)):
        at_sites[row, 1 : 1 + count] = np.pad(value, margin, "edge")
    return constants, at_sites


def moved(values: np.ndarray, by: int, boundary: str) -> np.ndarray:
    """Return the values at the sites n + by: periodic on a ring, otherwise constant beyond ends."""
    places = np.arange(values.size) + by
    if kind_of(boundary) in (PERIODIC, ANTIPERIODIC):
        return values[places % values.size]
    return values[np.clip(places, 0, values.size - 1)]


NAMES_BY_FORM = {
    "i_dt": ResultNames(()),
    "dt": ResultNames(
        (),
        ("value",),
        part="value of a field",
        final="value of a field at the end time",
        state="value of a field at the snapshots",
    ),
    "d2_dt2": ResultNames(
        (),
        ("value", "rate"),
        part="value of a field, and its rate",
        final="value of a field, and its rate, at the end time",
        state="value of a field, and its rate, at the snapshots",
    ),
}
"""Names of results by the form of the equations; the fields are named by the model."""


class TracedEquations(Equations):
    """Equations whose kernels, names and bounds follow from the trace of a model."""

    @cached_property
    def names(self) -> ResultNames:
        """The names of the results in datasets."""
        return NAMES_BY_FORM[self.problem.model.form]._replace(components=self.problem.model.fields)

    @property
    def methods(self) -> list[str]:
        """The names of the methods that integrate the equations."""
        return methods_taking(self.problem.model)

    def describe(self) -> dict[str, Any]:
        """Return the attributes of a dataset that describe the equations."""
        problem = self.problem
        return {
            "parameters": json.dumps(problem.parameter_values, default=np.ndarray.tolist),
            "model": problem.model.name,
            "model_text": problem.model.text,
        }

    def rates(self, peak: float) -> dict[str, float]:
        """Return bounds of the rates at amplitude `peak`, each by the key that it depends on."""
        return rates_of(self.problem.model, self.problem.parameters, peak)

    def find_reduction(self) -> Reduction:
        """Return half of the chain if data, equations and parameters are even in n, else the whole.

        The half gives the same bits as the whole chain.
        """
        problem = self.problem
        if problem.site_count is not None:  # the chain 0..N-1 has no centre site
            return Reduction(even=False, synchronised=False)
        symmetric = problem.model.even and not problem.site_dependent
        # the far half of an antiperiodic ring has the opposite sign
        symmetric = symmetric and kind_of(problem.boundary) != ANTIPERIODIC
        even = symmetric and problem.half_width >= 2 * problem.model.reach
        return Reduction(even and find_reduction(problem.amplitudes).even, synchronised=False)

    def compiled(self, name: str) -> CompiledMethod:
        """Return the method of this name with the generated kernels of the model."""
        kernels = kernels_of(self.problem.model, self.problem.site_dependent)
        model = self.problem.model
        return compiled_method(kernels, model, observer_of(model), METHODS[name], in_tiles=False)

    def system(self, cut: Reduction) -> System:
        """Return the argument `system` of the kernels, at time 0."""
        return make_system(self.problem, cut)

    def prepare_batch(self, batch: Sequence[Equations], cut: Reduction) -> BatchInputs | None:
        """Return what a batch of runs needs; None if the rates depend on time or on far sites."""
        model, site_dependent = self.problem.model, self.problem.site_dependent
        if model.driven or model.matrices or model.reach > REACH:
            return None
        kernels = batches_of(model, site_dependent)
        inputs = inputs_of_rates(model.rates, site_dependent)
        constants, at_sites = zip(*(_values(each.problem, inputs) for each in batch), strict=True)
        last = [at_sites[-1]] * (LANES - len(batch))  # the other lanes repeat the last run
        # site j of run r is in column 1 + j * LANES + r: the rule loads block j from 1 + j * LANES
        by_site = np.stack([*at_sites, *last], axis=-1)[:, 1:]
        at = np.pad(by_site.reshape(len(by_site), -1), ((0, 0), (1, 0)))
        system = self.system(cut)._replace(at=at)
        return BatchInputs(kernels.run_batch, kernels.WORK, system, constants)

    def record(
        self, components: int, sites: int, times: int, every: int, conserved: bool
    ) -> ObservableRecord:
        """Return uninitialised arrays for the observables at `times` outputs."""
        quantities = len(self.problem.model.conserved) if conserved else 0
        return blank_record(components, sites, times, every, quantities, parts=2)

    def collect(self, record: ObservableRecord, y: np.ndarray, cut: Reduction) -> dict[str, Any]:
        """Return entries of a `Trajectory` on the whole chain, from record and final state `y`."""
        model, count = self.problem.model, len(self.names.parts)
        final_rows = np.array([unfold(y[part::2, 1:-1], cut) for part in range(count)])
        state = np.array([unfold(part, cut) for part in record.snapshots[:count]])
        real = model.real
        return {
            "modulus": np.abs(state[0]) if real or not state.size else modulus(complex_of(*state)),
            "final": final_rows if real else complex_of(*final_rows),
            "state": state,
            "conserved": dict(zip(model.conserved, record.conserved, strict=False)),
        }
