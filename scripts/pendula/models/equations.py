"""The paper's equations as traced models, and their constants; this imports no kernels.

The coupled dNLS equations (4) of the amplitudes on a finite chain are

    i dA_n/dtau = epsilon (A_{n+1} - 2 A_n + A_{n-1}) + Omega A_n
                  + gamma (conj B_n - conj A_n) + |A_n|^2 A_n / 2,

and the same with A and B exchanged; Newton's equations (1) of the pendula are

    x_n'' + sin x_n = C (x_{n+1} - 2 x_n + x_{n-1}) + D(t) (y_n - x_n),

and the same with x and y exchanged, where C = epsilon mu^2, D(t) = 2 gamma mu^2 cos(2 omega t) and
omega^2 = 1 + mu^2 Omega. A change of the order of operations here changes every result
(tests/test_same_bits.py).
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from latticode.equations.graph import node
from latticode.equations.model import Model, Value, abs2, conj, cos, lap, sin, sqrt
from latticode.integrators.methods import methods_taking

AMPLITUDES, PENDULA = MODELS = ("amplitudes", "pendula")
"""The names of the amplitude equations (4), and of Newton's equations (1) of the pendula."""


@dataclass(frozen=True, kw_only=True)
class Constants:
    """The constants of the equations (4), always in this order.

    Keywords are required: three numbers by position are easily exchanged.
    """

    epsilon: float  # coupling of neighbours
    gamma: float  # strength of the drive
    omega: float  # detuning Omega

    def __iter__(self) -> Iterator[float]:
        """Yield epsilon, gamma and omega."""
        yield from (self.epsilon, self.gamma, self.omega)

    @classmethod
    def of(cls, values: Mapping) -> "Constants":
        """Return the constants in a mapping, such as the attributes of a dataset."""
        return cls(**{name: float(values[name]) for name in ("epsilon", "gamma", "omega")})


# --- The amplitudes -----------------------------------------------------------------------------


def linear(p: Any, u: Value, v: Value) -> Value:
    """Return the linear terms of i dA_n/dtau, where u is A and v is B, or the other way round."""
    return p.epsilon * lap(u) + p.omega * u + p.gamma * (conj(v) - conj(u))


def i_dt(p: Any, a: Value, b: Value) -> list[Value]:
    """Return i dA_n/dtau and i dB_n/dtau."""
    return [linear(p, u, v) + 0.5 * abs2(u) * u for u, v in ((a, b), (b, a))]


def mean_i_dt(p: Any, *fields: Value) -> list[Value]:
    """Return the mean of `i_dt` over a step; `fields` are the old, the new and the mean A and B.

    The linear terms act on the mean state. The cubic term is the mean of |A|^2 times the mean A.
    """
    old, new, mean = fields[:2], fields[2:4], fields[4:]
    return [0.0] * 4 + [
        linear(p, u, v) + 0.5 * (0.5 * (abs2(first) + abs2(last))) * u
        for first, last, u, v in zip(old, new, mean, mean[::-1], strict=True)
    ]


COEFFICIENTS = dict.fromkeys(("epsilon", "gamma", "omega"), 1.0)
AMPLITUDE_MODEL = Model(fields=("A", "B"), parameters=COEFFICIENTS, i_dt=i_dt, name=AMPLITUDES)
"""Equations (4) with the parameters of a problem."""
MEANS = [f"{name}{i}" for i in range(3) for name in "AB"]
CONSERVING_MODEL = Model(fields=MEANS, parameters=COEFFICIENTS, i_dt=mean_i_dt)
"""The mean of (4) over a step of `delfour_fortin_payre`."""


# --- The pendula --------------------------------------------------------------------------------


def accelerations(coupling: Value, drive: Value, x: Value, y: Value) -> list[Value]:
    """Return the second derivatives of x and y; `coupling` is C, and `drive` is D at this time."""
    return [coupling * lap(u) + drive * (v - u) - sin(u) for u, v in ((x, y), (y, x))]


def d2_dt2(p: Any, x: Value, y: Value) -> list[Value]:
    """Return the second derivatives of x and y by t, from the constants of (4) and mu."""
    square = p.mu * p.mu
    drive = cos(2.0 * sqrt(1.0 + square * p.omega) * p.t)
    return accelerations(p.epsilon * square, 2.0 * p.gamma * square * drive, x, y)


def driven(p: Any, x: Value, y: Value) -> list[Value]:
    """Return the second derivatives of x and y, with a drive D(t) that `at_time` computes."""
    return accelerations(p.coupling, Value(node("clock", "drive")), x, y)


PENDULUM_MODEL = Model(
    fields=("x", "y"),
    parameters={"epsilon": 1.0, "gamma": 1.0, "omega": 0.0, "mu": 0.1},
    d2_dt2=d2_dt2,
    name=PENDULA,
)
"""Equations (1) with the parameters of a problem."""
KERNEL_MODEL = Model(fields=("x", "y"), parameters={"coupling": 1.0}, d2_dt2=driven)
"""Equations (1) for the kernels, which compute the drive as a function of time."""

MODEL_NAMED = {AMPLITUDES: AMPLITUDE_MODEL, PENDULA: PENDULUM_MODEL}
"""The models by name."""
METHODS_OF = {
    AMPLITUDES: [*methods_taking(AMPLITUDE_MODEL), "delfour_fortin_payre"],
    PENDULA: methods_taking(PENDULUM_MODEL),
}
"""The methods that integrate each model; only (4) has the mean rates of the conserving scheme."""
