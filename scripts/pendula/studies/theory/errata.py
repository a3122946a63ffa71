"""Errors and gaps of the paper, each with the smallest example that anyone can rerun."""

from collections.abc import Mapping

import numpy as np

from pendula.datasets.checks import table, tabulate, variable
from pendula.measures.norms import power_of
from pendula.models.bounds import (
    extent,
    theorem_2_constants,
    theorem_2_gap,
    widened_barrier,
    widened_bound,
    widened_delta_0,
)
from pendula.numerics.draws import complex_normal, uniform
from pendula.numerics.elementary import modulus, square_modulus
from pendula.problem import Constants, Problem, on_sites
from pendula.simulation.simulate import Trajectory, simulate

from .bounds import NUMBERS
from .equations import draw_shape, run, squared_norm, total_energy

DEPTH = "-H, which Theorem 2 takes for positive"


def alternating(sites: int, x: float) -> np.ndarray:
    """Return A_n = -B_n = (-1)^n x, shape (2, N)."""
    wave = x * (1.0 - 2.0 * (np.arange(sites) % 2))
    return np.stack([wave, -wave]).astype(complex)


def theorem_3_margin(constants: Constants, amplitudes: np.ndarray, drive: float) -> float:
    """Return H minus the lower bound of Theorem 3's proof with `drive` times gamma in it.

    The paper prints one, the right number is two. The quartic terms of both sides are equal, so
    that the sign does not depend on the size of the data.
    """
    density = square_modulus(amplitudes)
    quartic = np.sum(density**2, axis=1)
    constant = abs(constants.omega) + drive * constants.gamma + 4.0 * constants.epsilon
    linear = constant * np.sqrt(amplitudes.shape[1]) * np.sum(np.sqrt(quartic))
    return total_energy(constants, "dirichlet", amplitudes) - (0.25 * quartic.sum() - linear)


def check_theorem_3_constant(constants: Constants, amplitude: float, longest: int) -> dict:
    """Find the smallest chain on which the lower bound printed in Theorem 3's proof fails."""
    sizes = np.arange(1, longest + 1, 2)
    chains = [alternating(n, amplitude) for n in sizes]
    printed, corrected = (
        np.array([theorem_3_margin(constants, chain, drive) for chain in chains])
        for drive in (1.0, 2.0)
    )
    failing = sizes[printed < 0]
    smallest = failing.min() if len(failing) else 0
    return table(
        "The lower bound in the proof of Theorem 3 on A = -B = x (-1)^n",
        {"sites": sizes},
        printed=variable(printed, ("sites",), "H minus the bound with gamma, as printed"),
        corrected=variable(corrected, ("sites",), "H minus the bound with 2 gamma"),
        violation=variable(
            -corrected, ("sites",), "excess of the corrected bound over H", tolerance=1e-12
        ),
        smallest=variable(smallest, (), "smallest chain that breaks the printed bound"),
    )


def check_theorem_2_case(constants: Constants, pair, sites: int) -> dict:
    """Set the paper's small case beside the regions of Theorem 2 and of its widened form."""
    amplitudes = np.zeros((2, sites), complex)
    amplitudes[:, sites // 2] = pair
    start = power_of(amplitudes)
    energy = total_energy(constants, "dirichlet", amplitudes)
    (delta_0, c_0), gap = theorem_2_constants(constants), theorem_2_gap(constants)
    numbers = {
        "start": start,
        "depth": -energy,
        "barrier": gap * gap,
        "delta_0": delta_0,
        "c_0": c_0,
        "widened_barrier": widened_barrier(constants)[1],
        "widened_delta_0": widened_delta_0(constants),
        "widened_bound": float(widened_bound(energy, start, constants)),
    }
    about = {
        **{name: NUMBERS[name] for name in ("start", "delta_0", "c_0")},
        "depth": (DEPTH, None),
        "barrier": ("barrier of -H in (25)", None),
        "widened_barrier": ("barrier of -H with the bonds kept", None),
        "widened_delta_0": ("radius of the widened theorem", None),
        "widened_bound": ("its bound on P", None),
    }
    title = "The small case at Omega = -4 and the region that Theorem 2 covers"
    return tabulate(title, {}, [numbers], about)


def check_negative_depth(constants: Constants, count: int, seed: int, scale: float = 1.0) -> dict:
    """Find the least -H / P of data as small as Theorem 2 asks: its proof takes -H > 0.

    Random data of P up to delta_0, and real pairs. A control allows `scale` times that P.
    """
    rng = np.random.default_rng(seed)
    radius = scale * theorem_2_constants(constants)[0]
    states = [
        np.sqrt(radius * uniform(rng, 1e-3, 1.0)) * draw_shape(rng, 1 + 2 * (i % 4))
        for i in range(count)
    ]
    states += [np.array([[x], [0.0]], complex) for x in np.sqrt(radius * np.linspace(0.01, 1, 50))]
    depth = [-total_energy(constants, "dirichlet", z) / power_of(z) for z in states]
    return table(
        "The sign of -H for data as small as Theorem 2 asks",
        {},
        largest_start=variable(radius, (), "largest P of these data"),
        least_depth=variable(min(depth), (), "least -H / P of these data"),
        most_energy=variable(-min(depth), (), "largest H / P of these data", tolerance=0.0),
    )


def check_bootstrap(
    constants: Constants, part: float, longest: float, below_barrier: bool = False
) -> dict:
    """Find data that satisfy all that the printed end of Theorem 2's proof uses, and break (24).

    For small data delta = `part` * delta_0 it uses (25), that -H > 0 is constant, and
    |H| <= C delta with C = c, and concludes P <= C_0 delta. None of that excludes states beyond the
    barrier of (25): a pair (x, 0) there has the same energy. What excludes them is that P is
    continuous and starts below 2 a. With `below_barrier` only states below 2 a are allowed, as by
    continuity.
    """
    delta_0, c_0 = theorem_2_constants(constants)
    delta, gap = part * delta_0, theorem_2_gap(constants)
    sizes = np.linspace(0.0, longest, 20001)[1:]
    powers = sizes**2
    depth = -np.array(
        [total_energy(constants, "dirichlet", np.array([[x], [0.0]], complex)) for x in sizes]
    )
    premises = (depth > 0.0) & (depth <= extent(constants) * delta)
    premises &= depth >= gap * powers - 0.25 * powers**2
    if below_barrier:
        premises &= powers < 2.0 * gap
    breaks = premises & (powers > c_0 * delta)
    return table(
        "What the printed proof of Theorem 2 concludes without continuity",
        {},
        allowed_power=variable(c_0 * delta, (), "C_0 delta of the small data"),
        largest_power=variable(powers[premises].max(), (), "largest P that the premises allow"),
        breaking=variable(
            powers[breaks].min() if breaks.any() else np.inf, (), "least P that breaks (24)"
        ),
        barrier_power=variable(2.0 * gap, (), "P at the barrier of (25), 2 a"),
    )


def run_small_data(omega: float, half_width: int, end_time: float, solver: Mapping) -> Trajectory:
    """Run the paper's small data, (A_0, B_0) = (1, 0.1), as the paper's figures have it."""
    problem = Problem(
        constants=Constants(epsilon=1.0, gamma=1.0, omega=omega),
        half_width=half_width,
        boundary="dirichlet",
        initial=on_sites({0: (1.0, 0.1)}),
        end_time=end_time,
        output_step=0.025,
        solver=solver,
    )
    return simulate(problem)


def check_energy_drift(solver: Mapping, end_time: float, omegas) -> dict:
    """Run the small cases by the paper's solver: is H kept to the order of 1e-6?"""
    energies = [run_small_data(omega, 30, end_time, solver).energy for omega in omegas]
    drift = [np.abs(energy - energy[0]).max() for energy in energies]
    return table(
        f"Drift of the energy by tau = {end_time:g}, (A0, B0) = (1, 0.1), {solver['name']}",
        {"point": np.arange(len(omegas))},
        omega=variable(omegas, ("point",), "detuning Omega"),
        energy_drift=variable(drift, ("point",), "largest |H - H(0)|"),
    )


def check_opposite(constants: Constants, sites: int, end_time: float, seed: int) -> dict:
    """Show that A = -B is invariant too: the drive acts there as -2 gamma conj(A).

    The paper mentions A = B alone, where the drive is silent.
    """
    rng = np.random.default_rng(seed)
    a = complex_normal(rng, sites)
    final = run(constants, "dirichlet", np.stack([a, -a]), end_time).final
    return table(
        "The second invariant reduction, A = -B",
        {},
        departure=variable(modulus(final[0] + final[1]).max(), (), "|A + B|", tolerance=0.0),
    )


def check_not_shown(
    half_widths, window: tuple[float, float], omega: float, solver: Mapping
) -> dict:
    """Run the sweep at Omega = 8, small data, that the paper mentions and does not show."""
    peaks = []
    for half_width in half_widths:
        trajectory = run_small_data(omega, half_width, window[1], solver)
        inside = trajectory.tau >= window[0]
        peaks.append(np.sqrt(squared_norm(trajectory.l2)[inside].max()))
    return table(
        f"Largest l2 on [{window[0]:g}, {window[1]:g}] at Omega = {omega:g}, small data",
        {"half_width": half_widths},
        l2=variable(peaks, ("half_width",), "l2 norm over the chain, largest in the window"),
    )
