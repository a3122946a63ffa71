"""A kind of ends that is new to the table works or is refused, wherever ends are asked for."""

import numpy as np
import pytest
import xarray as xr
from latticode.datasets.stated import describe_run
from latticode.drawing.runs import name_data_and_ends
from latticode.equations.ends import ENDS, neighbours
from latticode.simulation.lattice import WHOLE
from latticode.simulation.simulate import simulate
from oracle import BOUNDARIES, random_chain
from pendula.models.bounds import find_bounds, proven_region
from pendula.models.linear_chain import curvatures, flow, modes
from pendula.problem import PENDULA
from pendula.studies.theory.equations import total_energy
from pendula.studies.theory.polynomials import energy as exact_energy
from problems import make_problem

NUMBERS = (0.5, 0.4, -9.0)
Z = 0.1 * random_chain(3)


def problem(boundary, **changes):
    return make_problem(Z, NUMBERS, boundary, **changes)


def pendula(boundary):
    return simulate(problem(boundary, model=PENDULA, mu=0.1), WHOLE).final


def described(boundary, written):
    about = describe_run("mine", problem(boundary), {"name": "taylor"})
    return written(xr.Dataset(attrs={**about, "fields": "A, B"}))


BY_THE_TABLE = {
    "eigenvalues": lambda boundary: curvatures(7, boundary),
    "modes": lambda boundary: modes(7, boundary),
    "linear flow": lambda boundary: flow(Z, 1.5, *NUMBERS, boundary),
    "neighbours": lambda boundary: neighbours(Z, boundary),
}
TAUGHT = {
    "kernels": lambda boundary: simulate(problem(boundary), WHOLE).final,
    "series": lambda boundary: simulate(problem(boundary, solver="taylor"), WHOLE).final,
    "pendula": pendula,
    "energy": lambda boundary: total_energy(problem("free").constants, boundary, Z),
    "region": lambda boundary: proven_region(-1.0, 0.5, problem("free").constants, boundary),
    "bound": lambda boundary: find_bounds(-1.0, 0.5, 7, problem("free").constants, boundary),
}
NAMED = {
    "problem": problem,
    "exact energy": lambda boundary: len(exact_energy(boundary)),
    "title": lambda boundary: described(boundary, name_data_and_ends),
}
READERS = BY_THE_TABLE | TAUGHT | NAMED


@pytest.fixture(autouse=True)
def no_modes_kept():
    """Forget the modes of ends that a test has made up."""
    yield
    for kept in (curvatures, modes):
        kept.cache_clear()


@pytest.mark.parametrize("reader", READERS)
def test_ends_that_are_not_in_the_table_are_refused_with_those_that_are(reader):
    with pytest.raises(ValueError, match=r"'twisted'; there are dirichlet, free, periodic"):
        READERS[reader]("twisted")


@pytest.mark.parametrize("known", BOUNDARIES)
@pytest.mark.parametrize("reader", READERS)
def test_a_new_name_for_known_ends_needs_a_line_of_the_table_and_no_more(
    reader, known, monkeypatch
):
    monkeypatch.setitem(ENDS, "new", ENDS[known])
    if reader != "problem":
        np.testing.assert_array_equal(READERS[reader]("new"), READERS[reader](known))
    assert READERS["problem"]("new").boundary == "new"
