"""Newton's equations (1) for small mu against the amplitudes of (4): Section 2's derivation.

The model of (1) shares the chain and the integrators with that of (4), but no equation and no time:
it takes nothing from the expansion but the data. Angles are in radians.
"""

from dataclasses import replace

import numpy as np

from pendula.datasets.checks import table, variable
from pendula.models.pendula import amplitudes_of, angles_of, frequency
from pendula.numerics import elementary
from pendula.numerics.elementary import complex_of, product
from pendula.problem import PENDULA, Constants, Problem
from pendula.simulation.lattice import WHOLE
from pendula.simulation.simulate import simulate

from .equations import (
    misstated,
    one_pair,
    random_amplitudes,
    right_hand_side,
    run,
    total_energy,
)

OUTPUTS = 41
"""Times at which angles are compared, the first of them the start."""
READINGS = ["mu^2 t / 2", "mu^2 t", "mu t / 2", "mu^2 t / 2, opposite drive"]
"""The slow time of (4), with its factor left out, with another power of mu; the opposite drive."""


def pendula_run(constants: Constants, mu: float, amplitudes: np.ndarray, times, drive=1.0):
    """Return angles and velocities (time, 2, N) of (1) from what (3) makes of `amplitudes` (2, N).

    The drive is `drive` times that of the constants. The velocity keeps the slow rate of the
    amplitudes, so that the data err by mu^3 only. `times` are equal steps of t from 0 on. Both
    components are integrated on the whole chain, whatever the symmetries.
    """
    rates = right_hand_side(constants, "dirichlet", amplitudes)
    slow = mu * mu * mu * rates.real  # mu times d/dt of 2 mu A
    angles, velocities = angles_of(amplitudes, constants.omega, mu)
    end = 0.5 * mu * mu * times[-1]
    problem = Problem(
        constants=replace(constants, gamma=drive * constants.gamma),
        half_width=amplitudes.shape[-1] // 2,
        boundary="dirichlet",
        initial=amplitudes_of(angles, velocities + slow, constants.omega, mu),
        end_time=end,
        output_step=end / (len(times) - 1),
        solver={"name": "taylor", "rtol": 1e-14, "atol": 1e-14},
        snapshot_every=1,
        model=PENDULA,
        mu=mu,
    )
    return simulate(problem, WHOLE).snapshots.transpose(0, 3, 1, 2)


def fast_times(mu: float, end: float) -> np.ndarray:
    """Return the times t at which tau = mu^2 t / 2 goes from 0 to `end` in equal steps."""
    return np.linspace(0.0, 2.0 * end / (mu * mu), OUTPUTS)


def order(errors: np.ndarray, mus) -> np.ndarray:
    """Return the order in mu of errors (mu, ...) between the last two mu."""
    return elementary.log(errors[-2] / errors[-1]) / elementary.log(mus[-2] / mus[-1])


def expansion_errors(constants: Constants, mu: float, amplitudes, end: float) -> list[float]:
    """Return max |x - x of (3)| up to mu^2 t / 2 = `end` for the READINGS of the equations.

    Pendula that feel the drive with the opposite sign are the same as a drive that is shifted by
    half a period.
    """
    times = fast_times(mu, end)
    angles, shifted = (pendula_run(constants, mu, amplitudes, times, d)[0] for d in (1.0, -1.0))
    phase = elementary.turn(frequency(constants.omega, mu) * times)[:, None, None]

    def expected(taus) -> np.ndarray:
        """Return the angles of (3) with the amplitudes of (4) at the slow times `taus`."""
        states = [amplitudes]
        for step in np.diff(taus):
            states.append(run(constants, "dirichlet", states[-1], step).final)
        return 2.0 * mu * product(np.array(states), phase).real

    rates = (0.5 * mu * mu, mu * mu, 0.5 * mu)  # of the slow times in READINGS
    first, second, third = (expected(rate * times) for rate in rates)
    pairs = ((angles, first), (angles, second), (angles, third), (shifted, first))
    return [float(np.abs(x - y).max()) for x, y in pairs]


def check_expansion(constants: Constants, sites: int, end_time: float, mus, pair) -> dict:
    """Measure the order in mu of the expansion's error for each reading: only one has order 3."""
    amplitudes = one_pair(sites, pair)
    errors = np.array([expansion_errors(constants, mu, amplitudes, end_time) for mu in mus])
    orders = order(errors, mus)
    missed, says = abs(orders[0] - 3.0), "distance to 3 of the order with mu^2 t / 2"
    return table(
        "Newton's equations (1) against the expansion (3) with the amplitudes of (4)",
        {"mu": mus, "reading": READINGS},
        angle_error=variable(errors, ("mu", "reading"), "largest error of an angle", "rad"),
        order=variable(orders, ("reading",), "order in mu of the error"),
        order_error=variable(missed, (), says, tolerance=0.5),
    )


def check_pendula_synchrony(
    constants: Constants, sites: int, mu: float, end_time: float, seed: int, sign: float = 1.0
) -> dict:
    """Run (1) from x = y with the drive and without: all three must stay the same to the last bit.

    A control asks the same of x = -y, where `sign` is -1: it stays, but the drive acts on it.
    """
    a = random_amplitudes(np.random.default_rng(seed), sites, 1.0)[0]
    data, times = np.stack([a, sign * a]), fast_times(mu, end_time)
    driven, free = (pendula_run(constants, mu, data, times, drive)[0] for drive in (1.0, 0.0))
    departure = np.abs(driven[:, 0] - sign * driven[:, 1]).max()
    effect, says = np.abs(driven - free).max(), "largest effect of the drive"
    return table(
        "The invariant reduction x = y of Newton's equations (1)",
        {},
        pendula_departure=variable(departure, (), "largest |x - y|", "rad", tolerance=0.0),
        drive_effect=variable(effect, (), says, "rad", tolerance=0.0),
        moved=variable(np.ptp(driven), (), "range of the angles", "rad"),
    )


def averaged_energy(constants: Constants, mu: float, amplitudes: np.ndarray) -> float:
    """Return -1 / mu^4 of Newton's energy of (1), at the angles of (3) and averaged over a turn.

    In the frame that turns with omega the energy is the sum of 1 - cos x - omega^2 x^2 / 2 over all
    pendula, of C (x_{n+1} - x_n)^2 / 2 over all bonds, those to the ends at rest among them, and of
    D(t) (x - y)^2 / 2. 32 points take the mean of a cosine's x^16.
    """
    omega, energies = frequency(constants.omega, mu), []
    for t in 2.0 * np.pi / omega * np.arange(32) / 32:
        angles = 2.0 * mu * product(amplitudes, elementary.turn(omega * t)).real
        bonds = np.sum(np.diff(np.pad(angles, ((0, 0), (1, 1)))) ** 2)
        drive = 2.0 * constants.gamma * mu * mu * elementary.cos(2.0 * omega * t)
        own = np.sum(2.0 * elementary.sin(0.5 * angles) ** 2 - 0.5 * (omega * angles) ** 2)
        opposite = np.sum((angles[0] - angles[1]) ** 2)
        coupled = 0.5 * constants.epsilon * mu * mu * bonds
        energies.append(float(own + coupled + 0.5 * drive * opposite))
    return -float(np.mean(energies)) / (mu * mu * mu * mu)


def check_inherited_energy(
    constants: Constants, sites: int, end_time: float, mus, seed: int, omega_off: float = 0.0
) -> dict:
    """Compare H of (8) with Newton's energy, averaged over a turn, and follow it along (1).

    The amplitudes are read off angles and velocities: x - i x' / omega = 2 mu a e^{i omega t}.
    Both must differ from H(0) by the order of mu^2.
    """
    amplitudes = random_amplitudes(np.random.default_rng(seed), sites, 1.5)
    stated = misstated(constants, omega_off)
    energy = total_energy(stated, "dirichlet", amplitudes)
    static, along = [], []
    for mu in mus:
        static.append(abs(averaged_energy(constants, mu, amplitudes) - energy))
        times, omega = fast_times(mu, end_time), frequency(constants.omega, mu)
        angles, velocities = pendula_run(constants, mu, amplitudes, times)
        turned = 0.5 / mu * complex_of(angles, -velocities / omega)
        states = product(turned, elementary.turn(-omega * times)[:, None, None])
        energies = total_energy(stated, "dirichlet", states)
        along.append(np.abs(energies - energies[0]).max())
    missed, dims = np.array([static, along]).T, ("reading",)
    orders = order(missed, mus)
    apart = np.abs(orders - 2.0)
    kinds = ["averaged over a turn", "along a trajectory"]
    return table(
        "The energy H that (8) inherits from Newton's equations (1)",
        {"mu": mus, "reading": kinds},
        energy_missed=variable(missed, ("mu", "reading"), "largest difference to H"),
        energy_order=variable(orders, dims, "order in mu of that"),
        energy_order_error=variable(apart, dims, "its distance to 2", tolerance=0.5),
    )


def driven_growth(gamma: float, mu: float, ratio: float, steps: int = 64) -> float:
    """Return the growth rate of x - y of one pair at rest, per unit of tau, by Floquet's theorem.

    z'' + (1 + 2 D(t)) z = 0 where D has `ratio` times the frequency of the pendula. Classical
    Runge-Kutta over one period of the drive.
    """
    drive, period = 4.0 * gamma * mu * mu, 2.0 * np.pi / ratio
    h = period / steps
    force = -(1.0 + drive * elementary.cos(np.pi / steps * np.arange(2 * steps + 1)))

    def rate(half_steps, state):
        return np.array([state[1], force[half_steps] * state[0]])

    state = np.eye(2)
    for i in range(0, 2 * steps, 2):
        k1 = rate(i, state)
        k2 = rate(i + 1, state + 0.5 * h * k1)
        k3 = rate(i + 1, state + 0.5 * h * k2)
        k4 = rate(i + 2, state + h * k3)
        state = state + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)
    half = max(1.0, 0.5 * abs(np.trace(state)))  # the multipliers: half +- sqrt(half^2 - 1)
    return float(elementary.log(half + np.sqrt(half * half - 1.0)) / period / (0.5 * mu * mu))


def check_resonance(gamma: float, mus, ratios) -> dict:
    """Find at which ratio of the drive's frequency to the pendula's a pair at rest grows.

    Lemma 1 with epsilon = 0 and Omega = 0 gives 2 gamma per unit of tau at the ratio two.
    """
    rates = np.array([[driven_growth(gamma, mu, ratio) for ratio in ratios] for mu in mus])
    rates, dims = rates / (2.0 * gamma), ("mu", "drive_ratio")
    return table(
        "Growth of one pair at rest under a drive of another frequency, by Newton's equations",
        {"mu": mus, "drive_ratio": ratios},
        driven_rate=variable(rates, dims, "growth rate over 2 gamma"),
    )
