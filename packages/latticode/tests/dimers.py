"""(4) of arXiv 1708.06134 as a user writes a model, and problems and runs of it."""

from typing import NamedTuple

from latticode import Model, abs2, conj, lap
from latticode.equations.initial_values import on_sites
from latticode.generation.chain import at_every_site, close
from latticode.generation.modules import load_rule
from latticode.kernels.compiled import kernel
from latticode.simulation.lattice import FULL_CHAIN
from latticode.simulation.problem import Problem
from latticode.simulation.simulate import Trajectory, simulate
from oracle import CASES
from oracle import SOLVERS as CONTROLS

METHODS = ("ode45", "dop853", "taylor", "crank_nicolson")
"""The solvers that take the model."""
SOLVERS = {name: CONTROLS[name] for name in METHODS}
PAPER = (1.0, 1.0, -4.0)
"""epsilon, gamma and Omega of Fig 3."""


def i_dt(p, a, b):
    def one(u, v):
        linear = p.epsilon * lap(u) + p.omega * u + p.gamma * (conj(v) - conj(u))
        return linear + 0.5 * abs2(u) * u

    return one(a, b), one(b, a)


def energy(sign=-1):
    """Return the density of (8), with a sign before the drive: -1 is right."""

    def density(p, a, b):
        squares = [abs2(u) * (0.25 * abs2(u) + p.omega) for u in (a, b)]
        bond = abs2(a.right - a) + abs2(b.right - b)
        drive = ((a - b) * (a - b)).real
        return {"H": squares[0] + squares[1] + sign * p.gamma * drive - p.epsilon * bond}

    return density


def model(sign=-1) -> Model:
    return Model(
        fields=("A", "B"),
        parameters={"epsilon": 1.0, "gamma": 1.0, "omega": -4.0},
        i_dt=i_dt,
        conserved=energy(sign),
    )


DIMERS = model()
rates_at_site = load_rule(DIMERS.rates, "y")
write_rates = at_every_site(rates_at_site)


class Pairs(NamedTuple):
    """The parameters of DIMERS and the ends of the chain, as a kernel takes them."""

    epsilon: float
    gamma: float
    omega: float
    left: int
    right: int


@kernel
def rates(pairs, y, dy):
    """Write the right-hand side of DIMERS at `y` into `dy`."""
    close(pairs, y)
    write_rates(pairs, (y,), dy)


def dimers(initial=((0, (1.0, 0.1)),), **changes) -> Problem:
    """Return a problem of DIMERS from data {site: (A, B)}."""
    values = {
        "half_width": 8,
        "boundary": "dirichlet",
        "end_time": 4.0,
        "output_step": 0.25,
        "solver": {"name": "taylor", "rtol": 1e-14, "atol": 1e-14},
    }
    return Problem(model=DIMERS, initial=on_sites(dict(initial)), **values).changed(**changes)


def chain(z, numbers=PAPER, boundary="dirichlet", solver="dop853", **changes) -> Problem:
    """Return the problem of data (2, 2r + 1) up to tau = 1, on the chain that they fill.

    `numbers` are epsilon, gamma and Omega; `solver` is one of SOLVERS, or its controls.
    """
    values = {
        "parameters": dict(zip(DIMERS.parameters, map(float, numbers), strict=True)),
        "half_width": z.shape[1] // 2,
        "end_time": 1.0,
        "output_step": 0.25,
        "solver": SOLVERS[solver] if isinstance(solver, str) else solver,
    }
    return Problem(model=DIMERS, boundary=boundary, initial=z, **values).changed(**changes)


def integrate(z, solver, end=1.0, outputs=1, reduction=FULL_CHAIN, **changes) -> Trajectory:
    """Integrate data (2, N) to `end` with so many outputs after the first; see `chain`."""
    times = {"end_time": float(end), "output_step": float(end) / outputs}
    return simulate(chain(z, solver=solver, **times, **changes), reduction)


def case_of(name, half_width=30, **changes) -> Problem:
    """Return a case of the paper on a short chain."""
    omega, pair = CASES[name]
    keys = {"half_width": half_width, **changes}
    return chain(on_sites({0: pair}), (1.0, 1.0, omega), **keys)
