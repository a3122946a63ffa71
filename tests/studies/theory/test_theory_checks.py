"""What the short runs and searches of the checks rest on. That all hold, a quick run tells."""

from functools import cache

import numpy as np
from helpers import chosen
from oracle import BOUNDARIES, hamiltonian
from pendula.studies.theory.checks import run_check
from pendula.studies.theory.equations import run, run_powers, squared_norm
from pendula.studies.theory.settings import GROUPS
from problems import constants_of


@cache
def checked(name):
    """Return the numbers of a check at the sizes of the quick run."""
    section = chosen("theory", "quick")
    (given,) = (found[name] for found in map(section.arguments, GROUPS) if name in found)
    return run_check(name, given)


def test_each_of_many_runs_keeps_its_place_and_ends_and_a_lost_one_has_an_infinite_power():
    rng, runs = np.random.default_rng(0), 7
    constants = np.column_stack([rng.uniform(0.5, 1.5, (runs, 2)), rng.uniform(-4, 8, runs)])
    data = rng.normal(size=(runs, 2, 3, 2)) @ (1.0, 1j)
    boundaries = [BOUNDARIES[i % len(BOUNDARIES)] for i in range(runs)]
    constants[2, 0] = 1e300
    given = list(map(constants_of, constants))
    powers, energies = run_powers(given, boundaries, data, 1.0, 2)
    for i, boundary in enumerate(boundaries):
        np.testing.assert_allclose(energies[i], hamiltonian(data[i], constants[i], boundary))
        if i != 2:
            alone = run(given[i], boundary, data[i], 1.0, 2)
            np.testing.assert_allclose(powers[i], squared_norm(alone.l2), rtol=1e-10)
    np.testing.assert_allclose(powers[2], [np.sum(np.abs(data[2]) ** 2), np.inf, np.inf])


def test_what_picards_method_needs_is_broken_by_its_wrong_cases():
    found = {key: one["data"] for key, one in checked("picard")["data_vars"].items()}
    assert (found["long_contraction"] > 1.0).all()
    assert (found["rooted_limits_apart"] > 1e-6).all()


def test_bounds_that_forget_the_drive_are_exceeded():
    found = {key: one["data"] for key, one in checked("samples")["data_vars"].items()}
    assert (found["worst_without_drive"] >= found["worst_sample"]).all()
    assert found["worst_without_drive"].max() > 1.01
