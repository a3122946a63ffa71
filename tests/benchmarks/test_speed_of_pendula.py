"""The peers on Newton's equations solve what is solved here, and a small measurement is whole."""

import numpy as np
import pytest
from helpers import skip
from pendula.datasets.netcdf import read, write
from pendula.simulation.simulate import simulate
from problems import problem_of

from benchmarks import pendula, points
from benchmarks.tables import tabulate_pendula

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


def test_a_measurement_has_every_contestant_and_a_table(monkeypatch, tmp_path):
    monkeypatch.setattr(points, "ENOUGH", 0.0)
    monkeypatch.setattr(pendula, "END_TIME", 0.05)
    monkeypatch.setattr(points, "BLOCK", 0.0)
    kept = {name: pendula.PEERS[name] for name in ("scipy_dop853",)}
    monkeypatch.setattr(pendula, "PEERS", kept)
    path = tmp_path / "pendula.nc"
    write(path, pendula.measure({"fig3_small": SHORT}, lambda text: None), {})
    measured = read(path)
    assert list(measured["contestant"].values) == [*pendula.OWN, "scipy_dop853"]
    assert float(measured["error"].min()) < 1e-13 and float(measured["ratio"].squeeze()) > 1
    page = tabulate_pendula(measured)
    assert "SciPy DOP853, compiled" in page[2] and "kahan_li" in page[3]
