"""Errors and gaps of the paper, each with the smallest example that anyone can rerun."""

from collections.abc import Mapping

import numpy as np
from latticode.datasets.checks import table, variable
from latticode.numerics.elementary import square_modulus
from latticode.simulation.problem import write_initial

from pendula.models import bounds
from pendula.problem import Constants

from .equations import (
    ENDS,
    PAIR,
    alternating,
    constants_at,
    one_pair,
    run,
    squared_norm,
    total_energy,
)


def check_errata(longest: int) -> dict:
    """Gather the errors of the proofs of Theorems 2 and 3, at Omega = -4, on up to `longest` sites.

    The bound printed in Theorem 3's proof has gamma where 2 gamma is right.
    """
    constants, sizes = constants_at(-4.0), np.arange(1, longest + 1, 2)
    margins = [[margin(constants, n, drive) for n in sizes] for drive in (1.0, 2.0)]
    failing, dims = sizes[np.array(margins[0]) < 0.0], ("sites",)
    smallest = failing.min() if len(failing) else 0
    return table(
        "Errors in the proofs of Theorems 2 and 3",
        {"sites": sizes},
        printed=variable(margins[0], dims, "H minus the bound with gamma, as printed"),
        corrected=variable(margins[1], dims, "H minus the bound with 2 gamma"),
        smallest=variable(smallest, (), "smallest chain that breaks the printed bound"),
        **without_continuity(constants),
    )


def margin(constants: Constants, sites: int, drive: float) -> float:
    """Return H less its lower bound in Theorem 3's proof, with `drive` gamma, for (-1)^n.

    The quartic terms of both are equal, so that its sign does not depend on the size of the data.
    """
    z = alternating(sites, 1.0)
    quartic = np.sum(square_modulus(z) ** 2, axis=1)
    constant = abs(constants.omega) + drive * constants.gamma + 4.0 * constants.epsilon
    bound = 0.25 * quartic.sum() - constant * np.sqrt(sites) * np.sum(np.sqrt(quartic))
    return float(total_energy(constants, ENDS, z) - bound)


def without_continuity(constants: Constants) -> dict:
    """Find data that satisfy all that the printed end of Theorem 2's proof uses, and break (24).

    For small data, here delta = delta_0 / 2, it uses (25), that -H > 0 is constant, and
    |H| <= C delta with C = c, and concludes P <= C_0 delta. None of that excludes states beyond the
    barrier of (25): a pair (x, 0) there has the same energy. What excludes them is that P is
    continuous and starts below 2 a.
    """
    delta_0, c_0 = bounds.theorem_2_constants(constants)
    delta, gap = 0.5 * delta_0, bounds.theorem_2_gap(constants)
    sizes = np.linspace(0.0, 6.0, 20001)[1:]
    pairs = np.stack([sizes, 0.0 * sizes], axis=1)[:, :, None].astype(complex)
    powers, depth = sizes**2, -total_energy(constants, ENDS, pairs)
    premises = (depth > 0.0) & (depth <= bounds.extent(constants) * delta)
    premises &= depth >= gap * powers - 0.25 * powers**2
    below = powers[premises & (powers < 2.0 * gap)].max()
    return {
        "delta_0": variable(delta_0, (), "radius that the inequalities of Theorem 2's proof give"),
        "allowed_power": variable(c_0 * delta, (), "C_0 delta of the small data"),
        "largest_power": variable(powers[premises].max(), (), "largest P that its premises allow"),
        "largest_power_below": variable(below, (), "largest P that they allow below the barrier"),
        "barrier_power": variable(2.0 * gap, (), "P at the barrier of (25), 2 a"),
    }


def check_not_shown(half_widths, window, omega: float, solver: Mapping) -> dict:
    """Run the sweep at Omega = 8, small data, that the paper mentions and does not show."""
    constants, peaks = constants_at(omega), []
    for half_width in half_widths:
        data = one_pair(2 * half_width + 1, PAIR)
        outputs = round(40 * window[1])
        trajectory = run(constants, ENDS, data, window[1], outputs, solver=solver)
        inside = trajectory.tau >= window[0]
        peaks.append(np.sqrt(squared_norm(trajectory.l2)[inside].max()))
    found = table(
        f"Largest l2 on [{window[0]:g}, {window[1]:g}] at Omega = {omega:g}, small data",
        {"half_width": half_widths},
        l2=variable(peaks, ("half_width",), "l2 norm over the chain, largest in the window"),
    )
    found["attrs"] |= {
        **vars(constants),
        "boundary": ENDS,
        "initial": write_initial({0: PAIR}),
    }
    return found
