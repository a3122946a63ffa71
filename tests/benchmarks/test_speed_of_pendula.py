"""The peers on Newton's equations solve what is solved here, and a small measurement is whole."""

import numpy as np
import pytest
from helpers import skip
from pendula.simulation.simulate import simulate
from problems import problem_of

from benchmarks import pendula

SHORT = problem_of("fig3_small", half_width=3)


@pytest.mark.parametrize("name", pendula.PEERS)
def test_a_peer_solves_the_same_problem(name):
    if reason := pendula.PEERS[name].why_absent():
        skip(reason, "install that beside environment.txt, in the same environment")
    problem = pendula.as_pendula(SHORT)
    found, seconds = pendula.PEERS[name].prepare(problem)(1e-12)
    tight = {"name": "taylor", "rtol": 1e-15, "atol": 1e-15}
    exact = simulate(problem.changed(solver=tight)).final
    assert found.shape == exact.shape and seconds > 0
    np.testing.assert_allclose(found, exact, rtol=0, atol=2e-9)


def test_what_is_exact_is_agreed_on_by_two_methods(monkeypatch):
    problem = pendula.as_pendula(SHORT)
    assert pendula.exact_state(problem).shape == (2, 2, 7)
    monkeypatch.setattr(pendula, "AGREED", 1e-18)
    with pytest.raises(RuntimeError, match="two methods differ"):
        pendula.exact_state(problem)
