"""Kernels of Newton's equations (1) of the pendula on a finite chain, and their drive.

Time is t = 2 tau / mu^2 (`times_of`). A state has the rows x, x', y, y', or only the first two if
x = y (see `latticode.generation.chain`); x is an angle in rad.

Initial data are amplitudes: x = 2 mu Re A and x' = -2 mu omega Im A at t = 0, the leading terms of
(3).

Sines and cosines use only + - *, in a fixed order, and have the same bits on every machine. The
phase of the drive is reduced to a fraction of a turn before it is rounded. Its error is then about
1e-16 at every t; the rounded product 2 omega t would be wrong by 1e-11 at t = 1e5.
"""

from decimal import Decimal, localcontext
from typing import NamedTuple

import numpy as np
from latticode.equations.ends import DIRICHLET
from latticode.generation.chain import at_every_site, close
from latticode.generation.chain import can_be_tiled as can_be_tiled
from latticode.generation.modules import load_rule, load_series
from latticode.generation.toolbox import sine_and_cosine
from latticode.integrators.taylor import ORDER, PowerSeries, spare_start
from latticode.kernels.compiled import inlined_by_llvm, kernel
from latticode.numerics import elementary
from latticode.numerics.elementary import SPLITTER, complex_of, modulus, product
from latticode.simulation.observables import observe_angles

from .equations import KERNEL_MODEL, Constants

TURN = 6.283185307179586
PI = "3.14159265358979323846264338327950288419716939937511"

# --- The system and its drive -------------------------------------------------------------------


class Clock(NamedTuple):
    """The drive 2 gamma mu^2 cos(2 omega t) as a function of t."""

    strength: float  # 2 gamma mu^2
    frequency: float  # 2 omega
    turns: float  # turns per unit of t, omega / pi, rounded
    turns_rest: float  # the rounding error of `turns`


class Pendula(NamedTuple):
    """Parameters of the equations, the drive at one time, and the kinds of the two ends."""

    coupling: float  # C
    clock: Clock
    drive: float  # D(t)
    quadrature: float  # 2 gamma mu^2 sin(2 omega t), for the derivatives of D
    left: int
    right: int


def frequency(omega: float, mu: float) -> float:
    """Return omega of (2), the angular frequency sqrt(1 + mu^2 Omega)."""
    return float(np.sqrt(1.0 + mu * mu * omega))


def turns_of_drive(omega: float, mu: float) -> tuple[float, float]:
    """Return omega / pi, the turns of the drive per unit of t, and its rounding error."""
    with localcontext() as context:
        context.prec = 50
        turns = (1 + Decimal.from_float(mu) ** 2 * Decimal.from_float(omega)).sqrt() / Decimal(PI)
        return float(turns), float(turns - Decimal(float(turns)))


def make_pendula(constants: Constants, mu: float, ends: tuple[int, int]) -> Pendula:
    """Return the parameters of the kernels from the constants of (4) and mu."""
    square = mu * mu
    strength, omega = 2.0 * constants.gamma * square, frequency(constants.omega, mu)
    clock = Clock(strength, 2.0 * omega, *turns_of_drive(constants.omega, mu))
    return Pendula(constants.epsilon * square, clock, strength, 0.0, *ends)


def angles_of(amplitudes: np.ndarray, omega: float, mu: float) -> np.ndarray:
    """Return angles and velocities (part, ...) at t = 0: x = 2 mu Re A and x' = -2 mu omega Im A.

    The argument `omega` is the detuning Omega.
    """
    size = 2.0 * mu
    return np.array([size * amplitudes.real, (-size * frequency(omega, mu)) * amplitudes.imag])


def swings_of(angles: np.ndarray, velocities: np.ndarray, omega: float, mu: float) -> np.ndarray:
    """Return sqrt(x^2 + (x' / omega)^2): the angle to which a harmonic pendulum would swing.

    For the leading terms of (3) it is 2 mu |A| at every phase.
    """
    return modulus(complex_of(angles, velocities / frequency(omega, mu)))


def leading_angles(amplitudes: np.ndarray, omega: float, mu: float, tau: float) -> np.ndarray:
    """Return the angles 2 mu Re(A e^{i omega t}) of the expansion (3) at one tau, shaped like A."""
    turns, rest = turns_of_drive(omega, mu)
    t = float(times_of(tau, mu))
    half = Decimal.from_float(t) * (Decimal.from_float(turns) + Decimal.from_float(rest)) / 2
    phase = TURN * float(half - half.to_integral_value())
    return 2.0 * mu * product(amplitudes, elementary.turn(phase)).real


def times_of(tau: np.ndarray, mu: float) -> np.ndarray:
    """Return the times t = 2 tau / mu^2."""
    return 2.0 * tau / (mu * mu)


@inlined_by_llvm
def rest_of_product(a: float, b: float, product: float) -> float:
    """Return a b minus the rounded `product` of both, exactly (Dekker, Veltkamp)."""
    long, wide = SPLITTER * a, SPLITTER * b
    a_high, b_high = long - (long - a), wide - (wide - b)
    a_low, b_low = a - a_high, b - b_high
    return ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low


@kernel
def at_time(pendula: Pendula, t: float) -> Pendula:
    """Return the parameters with the drive at the time t."""
    coupling, clock, _, _, left, right = pendula
    turns = clock.turns * t
    rest = rest_of_product(clock.turns, t, turns) + clock.turns_rest * t
    sine, cosine = sine_and_cosine(TURN * ((turns - np.rint(turns)) + rest))
    return Pendula(coupling, clock, clock.strength * cosine, clock.strength * sine, left, right)


@kernel
def system_of_tile(pendula: Pendula, at_left_end: bool, at_right_end: bool) -> Pendula:
    """Return the pendula of a tile: the ends of the full chain where the tile reaches them."""
    coupling, clock, drive, quadrature, left, right = pendula
    left = left if at_left_end else DIRICHLET
    return Pendula(coupling, clock, drive, quadrature, left, right if at_right_end else DIRICHLET)


# --- Functions generated from the traced model ---------------------------------------------------

SERIES = load_series(KERNEL_MODEL)
WORK, continue_in_waves = SERIES.WORK, SERIES.continue_in_waves
observe = observe_angles
write_rates = at_every_site(load_rule(KERNEL_MODEL.rates, "y"))


@kernel
def rates(pendula: Pendula, y: np.ndarray, dy: np.ndarray) -> None:
    """Write the right-hand side of (1) at `y`, as a first-order system, into `dy` (same shape)."""
    close(pendula, y)
    write_rates(pendula, (y,), dy)


@kernel
def continue_series(pendula: Pendula, series: PowerSeries) -> None:
    """Write the coefficients of all orders from those of order 0, at the time of `pendula`.

    The coefficients of D come first: the series of a cosine of known frequency.
    """
    m, d = series.memory, spare_start(series)
    cosine, sine = pendula.drive, pendula.quadrature
    for k in range(ORDER + 1):
        m[d + k] = cosine
        share = pendula.clock.frequency / (k + 1)
        cosine, sine = -share * sine, share * cosine
    continue_in_waves(pendula, series)
