"""Errors and gaps of the paper, each with the smallest example that anyone can rerun."""

from collections.abc import Mapping

import numpy as np
from latticode.datasets.checks import table, variable
from latticode.measures.norms import power_of
from latticode.numerics.elementary import square_modulus
from latticode.simulation.problem import write_initial

from pendula.models import bounds
from pendula.problem import Constants

from .equations import (
    alternating,
    one_pair,
    run,
    squared_norm,
    total_energy,
)


def check_theorem_3_constant(constants: Constants, amplitude: float, longest: int) -> dict:
    """Find the smallest chain on which the lower bound printed in Theorem 3's proof fails.

    The paper prints gamma in it, right is 2 gamma. The quartic terms of both sides are equal, so
    that the sign of their difference does not depend on the size of the data.
    """
    sizes, margins = np.arange(1, longest + 1, 2), []
    for z in (alternating(n, amplitude) for n in sizes):
        quartic = np.sum(square_modulus(z) ** 2, axis=1)
        energy, norms = total_energy(constants, "dirichlet", z), np.sum(np.sqrt(quartic))
        for drive in (1.0, 2.0):
            constant = abs(constants.omega) + drive * constants.gamma + 4.0 * constants.epsilon
            linear = constant * np.sqrt(z.shape[1]) * norms
            margins.append(energy - (0.25 * quartic.sum() - linear))
    printed, corrected = np.reshape(margins, (-1, 2)).T
    failing, dims = sizes[printed < 0], ("sites",)
    smallest = failing.min() if len(failing) else 0
    return table(
        "The lower bound in the proof of Theorem 3 on A = -B = x (-1)^n",
        {"sites": sizes},
        printed=variable(printed, dims, "H minus the bound with gamma, as printed"),
        corrected=variable(corrected, dims, "H minus the bound with 2 gamma"),
        smallest=variable(smallest, (), "smallest chain that breaks the printed bound"),
    )


def check_theorem_2_case(constants: Constants, pair, sites: int) -> dict:
    """Set the paper's small case beside the regions of Theorem 2 and of its widened form."""
    delta_0, _ = bounds.theorem_2_constants(constants)
    gap = bounds.theorem_2_gap(constants)
    return table(
        "The small case at Omega = -4 and the region that Theorem 2 covers",
        {},
        start=variable(power_of(one_pair(sites, pair)), (), "P at the start, delta"),
        delta_0=variable(delta_0, (), "radius of Theorem 2"),
        barrier=variable(gap * gap, (), "barrier of -H in (25)"),
        widened_delta_0=variable(
            bounds.widened_delta_0(constants), (), "radius of the theorem with the bonds kept"
        ),
    )


def check_bootstrap(constants: Constants, part: float, longest: float) -> dict:
    """Find data that satisfy all that the printed end of Theorem 2's proof uses, and break (24).

    For small data delta = `part` * delta_0 it uses (25), that -H > 0 is constant, and
    |H| <= C delta with C = c, and concludes P <= C_0 delta. None of that excludes states beyond the
    barrier of (25): a pair (x, 0) there has the same energy. What excludes them is that P is
    continuous and starts below 2 a.
    """
    delta_0, c_0 = bounds.theorem_2_constants(constants)
    delta, gap = part * delta_0, bounds.theorem_2_gap(constants)
    sizes = np.linspace(0.0, longest, 20001)[1:]
    powers = sizes**2
    pairs = np.stack([sizes, 0.0 * sizes], axis=1)[:, :, None].astype(complex)
    depth = -total_energy(constants, "dirichlet", pairs)
    premises = (depth > 0.0) & (depth <= bounds.extent(constants) * delta)
    premises &= depth >= gap * powers - 0.25 * powers**2
    below = premises & (powers < 2.0 * gap)
    breaks = premises & (powers > c_0 * delta)
    breaking = powers[breaks].min() if breaks.any() else np.inf
    return table(
        "What the printed proof of Theorem 2 concludes without continuity",
        {},
        allowed_power=variable(c_0 * delta, (), "C_0 delta of the small data"),
        largest_power=variable(powers[premises].max(), (), "largest P that the premises allow"),
        largest_power_below=variable(
            powers[below].max(), (), "largest P that they allow below the barrier"
        ),
        breaking=variable(breaking, (), "least P that breaks (24)"),
        barrier_power=variable(2.0 * gap, (), "P at the barrier of (25), 2 a"),
    )


def check_not_shown(half_widths, window, omega: float, solver: Mapping) -> dict:
    """Run the sweep at Omega = 8, small data, that the paper mentions and does not show."""
    constants, pair, peaks = Constants(epsilon=1.0, gamma=1.0, omega=omega), (1.0, 0.1), []
    for half_width in half_widths:
        data = one_pair(2 * half_width + 1, pair)
        outputs = round(40 * window[1])
        trajectory = run(constants, "dirichlet", data, window[1], outputs, solver)
        inside = trajectory.tau >= window[0]
        peaks.append(np.sqrt(squared_norm(trajectory.l2)[inside].max()))
    found = table(
        f"Largest l2 on [{window[0]:g}, {window[1]:g}] at Omega = {omega:g}, small data",
        {"half_width": half_widths},
        l2=variable(peaks, ("half_width",), "l2 norm over the chain, largest in the window"),
    )
    found["attrs"] |= {
        **vars(constants),
        "boundary": "dirichlet",
        "initial": write_initial({0: pair}),
    }
    return found
