"""Lemma 1 near and at its threshold gamma_0: how sharp it is, and how perturbations grow there.

At the edge of the band a single wave grows as 4 gamma tau. Near the edge kappa - 2 gamma is about
epsilon theta^2, so that D = A - B obeys a wave equation whose speed is c = 2 sqrt(epsilon gamma):
Im D(n, tau) is 2 gamma / c times the sum of Re D(., 0) over |m - n| < c tau. Data that decay as
|n|^-s, with 1/2 < s < 1 in l2, thus grow as tau^(1 - s) in l-infinity and as tau^(3/2 - s) in l2:
nearly as a wave where s comes near to 1/2. Summable data (s > 1, one site) spread as tau^(1/2) in
l2 and stay bounded in l-infinity.
"""

import numpy as np
from latticode.datasets.checks import columns, rounded, table, variable
from latticode.numerics.elementary import log, modulus, power, sin
from latticode.numerics.matrices import times as multiplied

from pendula.models.linear_chain import driven, finite_threshold, gamma_0, modes
from pendula.problem import Constants

from .equations import random_amplitudes, run

DIGITS = 9
"""Significant digits of norms that come from a Fourier transform: it errs by some 1e-16 of them."""
START = 1e-130
"""Size of the wave: so small that the cubic terms are exactly zero in doubles."""


def check_sharp_threshold(epsilon: float, omegas, sizes) -> dict:
    """Continue the thresholds of ever longer chains, which follow from (15), to the infinite chain.

    The nearest wave of a chain has its wave number pi / (N + 1) off the band's edge, so that its
    threshold lies above gamma_0 by about a square of it. From the last two chains that square is
    taken off; what is left is its square again.
    """
    sizes, omegas = np.asarray(sizes), np.asarray(omegas, float)
    found = np.transpose([finite_threshold(omegas, epsilon, int(n), "dirichlet") for n in sizes])
    squares = 1.0 / ((sizes + 1.0) * (sizes + 1.0))
    slope = (found[:, -2] - found[:, -1]) / (squares[-2] - squares[-1])
    limit = found[:, -1] - slope * squares[-1]
    missed, theta = np.abs(limit - gamma_0(omegas, epsilon)), np.pi / (sizes[-2] + 1.0)
    left, dims = abs(epsilon) * theta * theta * theta * theta, ("omega",)
    return table(
        "The drive at which chains at rest lose their stability, against gamma_0",
        {"omega": omegas, "sites": sizes},
        threshold_found=variable(found, ("omega", "sites"), "threshold of N sites"),
        threshold_limit=variable(limit, dims, "threshold continued to the infinite chain"),
        threshold_error=variable(missed, dims, "distance of that to gamma_0", tolerance=left),
    )


def check_unstable_waves(
    epsilon: float, omegas, above: float, sites: int, end_time: float, seed: int
) -> dict:
    """Find the wave that leads the growth of tiny random data, `above` the chain's threshold.

    Lemma 1 says which: near theta = 0 if Omega < 0, near pi if Omega > 4 epsilon.
    """
    data = START * random_amplitudes(np.random.default_rng(seed), sites, 1.0)
    waves = np.pi * np.arange(1, sites + 1) / (sites + 1)
    solver = {"name": "dop853", "rtol": 1e-9, "atol": 1e-140}
    leading = []
    for omega in omegas:
        gamma = above + float(finite_threshold(omega, epsilon, sites, "dirichlet"))
        constants = Constants(epsilon=epsilon, gamma=gamma, omega=omega)
        final = run(constants, "dirichlet", data, end_time, solver=solver).final
        parts = modulus(multiplied(modes(sites, "dirichlet"), final[0] - final[1]))
        leading.append(waves[np.argmax(parts)])
    nearest = np.where(np.asarray(omegas) < 0.0, waves[0], waves[-1])
    nearer = np.round(np.abs(leading - nearest) / waves[0])
    says = "waves of the chain nearer to the edge of the band that Lemma 1 names"
    return table(
        "The wave that grows first above the threshold",
        {"omega": omegas},
        leading_wave=variable(leading, ("omega",), "wave number that leads the growth", "rad"),
        waves_nearer=variable(nearer, ("omega",), says, tolerance=0),
    )


def growth_of_a_wave(epsilon: float, omega: float, sites: int, times, gamma: float) -> np.ndarray:
    """Return |Im D| / (4 gamma tau |D_0|) of a mode whose own threshold is near this drive.

    D = A - B starts real in the mode with kappa = +- 2 gamma at its threshold, where (14) makes
    its other part grow as 4 gamma tau: there the ratio is one.
    """
    shape = modes(sites, "dirichlet")[0 if omega < 0 else sites - 1]
    constants = Constants(epsilon=epsilon, gamma=gamma, omega=omega)
    along_real = omega < 0  # kappa = 2 gamma > 0 feeds the imaginary part, kappa < 0 the real one
    start = 0.5 * START * shape * (1.0 if along_real else 1j)
    data = np.stack([start, -start]).astype(complex)
    ratios, solver = [], {"name": "dop853", "rtol": 1e-12, "atol": 1e-12 * START}
    for tau in times:
        final = run(constants, "dirichlet", data, tau, solver=solver).final
        grown = np.sum((final[0] - final[1]) * shape)
        part = abs(grown.imag if along_real else grown.real) / START
        ratios.append(part / (4.0 * gamma * tau))
    return np.array(ratios)


def decaying(sites: int, decay: float, edge: float) -> np.ndarray:
    """Return (1 + |n|)^-decay on a ring, its sign alternating if the band's edge is at pi."""
    n = np.fft.fftfreq(sites, 1.0 / sites)
    falling = np.where(n == 0.0, 1.0, 0.0)  # one site
    if np.isfinite(decay):
        falling = power(1.0 + np.abs(n), -decay)
    return falling * np.where((edge > 0.0) & (n % 2.0 == 1.0), -1.0, 1.0)


def spreading_norms(epsilon: float, omega: float, decays, times, sites: int) -> np.ndarray:
    """Return l2 and l-infinity norms of D on the infinite chain from (1 + i) (1 + |n|)^-decay.

    They are (decay, norm, time), by the exact flow on a ring so long that no wave returns. Beyond
    the ring the data are so flat that each site moves as the wave at the edge: what l2 gets from
    there is added, as an integral.
    """
    gamma = float(gamma_0(omega, epsilon))
    starts = [np.fft.rfft(decaying(sites, decay, omega)) for decay in decays]
    theta = 2.0 * np.pi * np.arange(sites // 2 + 1) / sites
    kappa = 4.0 * epsilon * sin(0.5 * theta) ** 2 - omega
    norms = np.empty((len(decays), 2, len(times)))
    for i, tau in enumerate(times):
        even, odd = driven(kappa, gamma, tau)
        along = even + (2.0 * gamma - kappa) * odd, even + (2.0 * gamma + kappa) * odd
        grown = 1.0 + 4.0 * gamma * tau
        for norm, data, decay in zip(norms, starts, decays, strict=True):
            p, q = (np.fft.irfft(part * data, sites) for part in along)
            square, outside = p * p + q * q, 0.0
            if np.isfinite(decay):  # the sum of (1 + |n|)^(-2 decay) over all sites beyond the ring
                slow = 2.0 * decay - 1.0
                outside = 2.0 * power(0.5 * sites, -slow) / slow
            total = np.sum(square) + (1.0 + grown * grown) * outside
            norm[:, i] = np.sqrt(total), np.sqrt(square.max())
    return norms


def exponents(norms: np.ndarray, times: np.ndarray, decays: np.ndarray) -> np.ndarray:
    """Return measured exponents (decay, norm) of norms (decay, norm, time) at doubling times.

    Slowly decaying data grow as a power plus a constant, both times tau^(1/2) in l2, and the
    increments over two doublings are free of the constant. Of fast ones the slope of the last
    doubling is taken: their increments go to zero.
    """
    found, slow = log(norms[..., -1] / norms[..., -2]) / log(2.0), np.asarray(decays) < 1.0
    free = norms[slow] / np.stack([np.sqrt(times), np.ones_like(times)])
    steps = np.diff(free[..., -3:])
    found[slow] = log(steps[..., 1] / steps[..., 0]) / log(2.0) + np.array([0.5, 0.0])
    return found


def check_threshold(
    epsilon: float, sites: int, omegas, times, above: float, decays, long_times, ring_sites: int
) -> dict:
    """Test the polynomial growth at |gamma| = gamma_0 that Lemma 1 ends with.

    A single wave on a finite chain at its own threshold, and, where it grows faster, at a drive
    that is larger by the part `above`; data (1 + |n|)^-s in l2 of the infinite chain at gamma_0,
    the last of them one site.
    """
    omegas, long_times = np.asarray(omegas, float), np.asarray(long_times, float)
    decays = np.array([*decays, np.inf])
    gammas = finite_threshold(omegas, epsilon, sites, "dirichlet")
    missed = [
        [
            np.abs(growth_of_a_wave(epsilon, omega, sites, times, part * gamma) - 1.0).max()
            for omega, gamma in zip(omegas, gammas, strict=True)
        ]
        for part in (1.0, 1.0 + above)
    ]
    ring = (decays, long_times, ring_sites)
    norms = rounded([spreading_norms(epsilon, omega, *ring) for omega in omegas], DIGITS)
    measured = np.array([exponents(own, long_times, decays) for own in norms])
    slow = np.maximum(0.0, 1.0 - decays)
    law = np.stack([0.5 + slow, slow], axis=-1)
    about = {
        "wave_error": ("distance to one of the growth of a wave over 4 gamma tau", 1e-8),
        "wave_error_above": "the same above the threshold",
        "threshold": "threshold of the finite chain",
        "finite_gap": "threshold of the finite chain minus gamma_0",
    }
    numbers = (*missed, gammas, gammas - gamma_0(omegas, epsilon))
    error, dims = np.abs(measured - law), ("omega", "decay", "norm")
    apart = "difference of the two exponents"
    return table(
        "Growth exactly at the threshold of Lemma 1",
        {"omega": omegas, "decay": decays, "norm": ["l2", "linf"]},
        **columns(("omega",), about, dict(zip(about, numbers, strict=True))),
        spreading_exponent=variable(measured, dims, "exponent of tau in that norm", digits=DIGITS),
        spreading_error=variable(error, dims, apart, tolerance=0.02),
    )
