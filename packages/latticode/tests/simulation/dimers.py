"""(4) of arXiv 1708.06134 as a user writes a model, and problems of it, for the library's tests."""

from latticode import Model, abs2, conj, lap
from latticode.simulation.problem import Problem, on_sites


def i_dt(p, a, b):
    def one(u, v):
        linear = p.epsilon * lap(u) + p.omega * u + p.gamma * (conj(v) - conj(u))
        return linear + 0.5 * abs2(u) * u

    return one(a, b), one(b, a)


DIMERS = Model(
    fields=("A", "B"), parameters={"epsilon": 1.0, "gamma": 1.0, "omega": -4.0}, i_dt=i_dt
)


def dimers(initial=((0, (1.0, 0.1)),), **changes) -> Problem:
    """Return a problem of DIMERS from data {site: (A, B)}."""
    values = {
        "half_width": 8, "boundary": "dirichlet", "end_time": 4.0, "output_step": 0.25,
        "solver": {"name": "taylor", "rtol": 1e-14, "atol": 1e-14},
    }  # fmt: skip
    return Problem(model=DIMERS, initial=on_sites(dict(initial)), **values).changed(**changes)
