"""How perturbations grow exactly at |gamma| = gamma_0: a wave, and data that spread from it.

At the edge of the band a single wave grows as 4 gamma tau. Near the edge kappa - 2 gamma is about
epsilon theta^2, so that D = A - B obeys a wave equation whose speed is c = 2 sqrt(epsilon gamma):
Im D(n, tau) is 2 gamma / c times the sum of Re D(., 0) over |m - n| < c tau. Data that decay as
|n|^-s, with 1/2 < s < 1 in l2, thus grow as tau^(1 - s) in l-infinity and as tau^(3/2 - s) in l2:
nearly as a wave where s comes near to 1/2. Summable data (s > 1, one site) spread as tau^(1/2) in
l2 and stay bounded in l-infinity.
"""

import numpy as np

from pendula.datasets.checks import columns, rounded, table, variable
from pendula.models.linear_chain import driven, finite_threshold, gamma_0, modes
from pendula.numerics.elementary import log, power, sin
from pendula.problem import Constants

from .equations import run

DIGITS = 9
"""Significant digits of norms that come from a Fourier transform: it errs by some 1e-16 of them."""
START = 1e-130
"""Size of the wave: so small that the cubic terms are exactly zero in doubles."""


def threshold_run(epsilon: float, omega: float, sites: int, times, gamma_times: float):
    """Return gamma and |Im D| / (4 gamma tau |D_0|) of a mode run at exactly its own threshold.

    D = A - B starts real in the mode with kappa = +- 2 gamma, where (14) makes its other part
    grow as 4 gamma tau: the ratio is one.
    """
    shape = modes(sites, "dirichlet")[0 if omega < 0 else sites - 1]
    gamma = gamma_times * float(finite_threshold(omega, epsilon, sites, "dirichlet"))
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
    return gamma, np.array(ratios)


def decaying(sites: int, decay: float, edge: float) -> np.ndarray:
    """Return (1 + |n|)^-decay on a ring, its sign alternating if the band's edge is at pi."""
    n = np.fft.fftfreq(sites, 1.0 / sites)
    falling = np.where(n == 0.0, 1.0, 0.0)  # one site
    if np.isfinite(decay):
        falling = power(1.0 + np.abs(n), -decay)
    return falling * np.where((edge > 0.0) & (n % 2.0 == 1.0), -1.0, 1.0)


def spreading_norms(epsilon: float, omega: float, decays, times, sites: int, gamma_times: float):
    """Return l2 and l-infinity norms of D on the infinite chain from (1 + i) (1 + |n|)^-decay.

    They are (decay, norm, time), by the exact flow on a ring so long that no wave returns. Beyond
    the ring the data are so flat that each site moves as the wave at the edge: what l2 gets from
    there is added, as an integral.
    """
    gamma = gamma_times * float(gamma_0(omega, epsilon))
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
    epsilon: float, sites: int, omegas, times, decays, long_times, ring_sites: int, gamma_times=1.0
) -> dict:
    """Test the polynomial growth at |gamma| = gamma_0 that Lemma 1 ends with.

    A single wave on a finite chain at its own threshold; data (1 + |n|)^-s in l2 of the infinite
    chain at gamma_0, the last of them one site. A control takes `gamma_times` the threshold.
    """
    times, long_times = np.asarray(times, float), np.asarray(long_times, float)
    decays = np.array([*decays, np.inf])
    found = [threshold_run(epsilon, omega, sites, times, gamma_times) for omega in omegas]
    gammas, ratios = map(np.array, zip(*found, strict=True))
    ring = (decays, long_times, ring_sites, gamma_times)
    norms = np.array([spreading_norms(epsilon, omega, *ring) for omega in omegas])
    norms = rounded(norms, DIGITS)
    measured = np.array([exponents(own, long_times, decays) for own in norms])
    slow = np.maximum(0.0, 1.0 - decays)
    law = np.stack([0.5 + slow, slow], axis=-1)
    numbers = {
        "wave_error": np.abs(ratios - 1.0).max(axis=1),
        "threshold": gammas,
        "finite_gap": gammas - gamma_0(np.asarray(omegas, float), epsilon),
    }
    about = {
        "wave_error": ("distance to one of the growth of a wave over 4 gamma tau", 1e-8),
        "threshold": "threshold of the finite chain",
        "finite_gap": "threshold of the finite chain minus gamma_0",
    }
    grown, dims = 4.0 * gammas[:, None] * times * ratios, ("omega", "decay", "norm")
    wave = "growth of the threshold mode, |Im D| / |D(0)|"
    spread = "norm of D at gamma_0 on the infinite chain from (1 + i) (1 + |n|)^-decay"
    error, apart = np.abs(measured - law), "difference of the two exponents"
    coords = {"omega": omegas, "tau": times, "decay": decays}
    return table(
        "Growth exactly at the threshold of Lemma 1",
        {**coords, "norm": ["l2", "linf"], "long_tau": long_times},
        **columns(("omega",), about, numbers),
        grown=variable(grown, ("omega", "tau"), wave),
        spreading=variable(norms, (*dims, "long_tau"), spread, digits=DIGITS),
        spreading_exponent=variable(measured, dims, "exponent of tau in that norm"),
        spreading_law=variable(law, dims[1:], "exponent that the wave equation gives"),
        spreading_error=variable(error, dims, apart, tolerance=0.02),
    )
