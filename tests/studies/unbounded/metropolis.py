"""Thermal states by another way than the library's: many rings, by Metropolis' algorithm.

The rings are independent of each other from their random start on, so the error of a mean over them
is the standard error over the rings: no autocorrelation enters it.
"""

import numpy as np

RINGS, SITES, SETTLING, KEPT, TURNS = 64, 64, 100, 100, 4


def sample(constants, beta, seed=1, antisymmetric=False):
    """Return of each ring its power and energy a site, and the largest modulus.

    Power and energy are means, (ring,); the largest of A and B are (kept, ring).
    With `antisymmetric` B = -A throughout.
    """
    rng = np.random.default_rng(seed)
    a, b = rng.normal(size=(2, RINGS, SITES, 2)) @ [1.0, 1.0j]
    b = -a if antisymmetric else b
    step, powers, energies, largest = 1.0, [], [], []
    for count in range(SETTLING + KEPT):
        taken = [
            offer_moves(constants, beta, a, b, parity, step, rng, antisymmetric)
            for parity in (0, 1)
        ]
        for _ in range(TURNS):
            offer_turns(constants, beta, a, b, rng)
        if count < SETTLING:  # half of the moves should be taken
            step *= 1.05 if np.mean(taken) > 0.5 else 0.95
        else:
            powers.append((np.abs(a) ** 2 + np.abs(b) ** 2).mean(axis=1))
            energies.append(energy_of(constants, a, b) / SITES)
            largest.append(np.maximum(np.abs(a), np.abs(b)).max(axis=1))
    means = (np.mean(values, axis=0) for values in (powers, energies))
    return *means, np.array(largest)


def offer_moves(constants, beta, a, b, parity, step, rng, antisymmetric):
    """Offer every second site a move; their bonds have no site in common. Return what was taken."""
    here = (slice(None), slice(parity, None, 2))
    moves = step * rng.normal(size=(2, *a[here].shape, 2)) @ [1.0, 1.0j]
    moves[1] = -moves[0] if antisymmetric else moves[1]
    old, new = a[here], a[here] + moves[0]
    other, another = b[here], b[here] + moves[1]
    change = local_energy(constants, new, another) - local_energy(constants, old, other)
    for z, before, after in ((a, old, new), (b, other, another)):
        for side in (1, -1):
            neighbour = np.roll(z, side, axis=1)[here]
            change -= constants.epsilon * (
                np.abs(after - neighbour) ** 2 - np.abs(before - neighbour) ** 2
            )
    accepted = rng.random(change.shape) < np.exp(np.minimum(0.0, -beta * change))
    a[here], b[here] = np.where(accepted, new, old), np.where(accepted, another, other)
    return accepted.mean()


def offer_turns(constants, beta, a, b, rng):
    """Offer each ring to change the signs of all Re (or all Im) on a random piece of it.

    Only the two bonds at the ends of the piece notice. In cold states such pieces would take long
    to turn site by site.
    """
    rings = np.arange(RINGS)
    first, length = rng.integers(SITES, size=RINGS), rng.integers(1, SITES, size=RINGS)
    real = rng.random(RINGS) < 0.5
    inside = (np.arange(SITES) - first[:, None]) % SITES < length[:, None]
    products = np.zeros(RINGS)
    for z in (a, b):
        part = np.where(real[:, None], z.real, z.imag)
        for end in (first, first + length):  # the bond from the site before to this one
            products += part[rings, (end - 1) % SITES] * part[rings, end % SITES]
    change = -4.0 * constants.epsilon * products
    taken = rng.random(RINGS) < np.exp(np.minimum(0.0, -beta * change))
    for z in (a, b):
        turned = np.where(real[:, None], -z.conj(), z.conj())
        z[:] = np.where(taken[:, None] & inside, turned, z)


def local_energy(constants, a, b):
    """Return the terms of (8) that need no neighbour."""
    squares = np.abs(a) ** 2, np.abs(b) ** 2
    quartic = 0.25 * (squares[0] ** 2 + squares[1] ** 2)
    drive = constants.gamma * ((a - b) ** 2).real
    return quartic + constants.omega * (squares[0] + squares[1]) - drive


def energy_of(constants, a, b):
    """Return the energy (8) of each ring."""
    bonds = sum(np.abs(z - np.roll(z, 1, axis=1)) ** 2 for z in (a, b))
    return (local_energy(constants, a, b) - constants.epsilon * bonds).sum(axis=1)


def mean_and_error(values):
    """Return the mean over the rings and its standard error."""
    return values.mean(), values.std(ddof=1) / np.sqrt(len(values))
