"""Growth exactly at a threshold of Lemma 1: on a finite chain, and on the infinite one."""

import numpy as np

from pendula.datasets.checks import table, variable
from pendula.models.linear_flow import driven, modes

from .linear import finite_threshold, gamma_0
from .runs import run
from .stability import TINY, tiny_tolerances


def threshold_run(epsilon: float, omega: float, sites: int, boundary: str, mode: int, times):
    """Return |Im D| / (4 gamma tau |D_0|) of a mode run at exactly its own threshold.

    D = A - B starts real in the mode with kappa = +- 2 gamma, where (14) makes its other part
    grow as 4 gamma tau: the ratio is one.
    """
    shape = modes(sites, boundary)[mode]
    gamma = float(finite_threshold(omega, epsilon, sites, boundary))
    along_real = omega < 0  # kappa = 2 gamma > 0 feeds the imaginary part, kappa < 0 the real one
    start = 0.5 * TINY * shape * (1.0 if along_real else 1j)
    data = np.stack([start, -start]).astype(complex)
    ratios, solver = [], {"name": "dop853", **tiny_tolerances(1e-12)}
    for tau in times:
        final = run((epsilon, gamma, omega), boundary, data, [0.0, tau], solver).final
        grown = (final[0] - final[1]) @ shape / TINY
        ratios.append(abs(grown.imag if along_real else grown.real) / (4.0 * gamma * tau))
    return gamma, np.array(ratios)


def spreading_norms(epsilon: float, omega: float, times, sites: int):
    """Return l2 and l-infinity norms of D at |gamma| = gamma_0 on the infinite chain, (2, time).

    One site is set to D = 1 + i; a ring so long that no wave returns stands for the infinite
    chain.
    """
    gamma = float(gamma_0(omega, epsilon))
    kappa = epsilon * curvature_of_ring(sites) - omega
    norms = []
    for tau in times:
        even, odd = driven(kappa, gamma, tau)
        p = even + (2.0 * gamma - kappa) * odd
        q = even + (2.0 * gamma + kappa) * odd
        field = np.fft.ifft(p).real + 1j * np.fft.ifft(q).real
        norms.append([np.sqrt(np.sum(np.abs(field) ** 2)), np.abs(field).max()])
    return np.array(norms).T


def curvature_of_ring(sites: int) -> np.ndarray:
    """Return lambda of each wave of a ring in the order of the fast Fourier transform."""
    return 4.0 * np.sin(np.pi * np.arange(sites) / sites) ** 2


def exponent(times, norms) -> float:
    """Return the power of time that fits the last two of the norms."""
    return float(np.log(norms[-1] / norms[-2]) / np.log(times[-1] / times[-2]))


def check_threshold(epsilon: float, sites: int, omegas=(-4.0, 8.0)) -> dict:
    """Test the polynomial growth at |gamma| = gamma_0 that Lemma 1 ends with.

    A single wave grows linearly in time, on a finite chain at its own threshold. From data in l2
    the infinite chain grows at gamma_0 only as tau^(1/2) in l2, and not at all in l-infinity: the
    band's edge is one wave number. A finite Dirichlet chain is stable there, its threshold being
    higher.
    """
    times = np.array([2.5, 5.0, 10.0, 20.0, 40.0])
    long_times = 25.0 * 2.0 ** np.arange(6)
    ratio, thresholds, spreading = [], [], []
    for omega in omegas:
        mode = 0 if omega < 0 else sites - 1
        gamma, ratios = threshold_run(epsilon, omega, sites, "dirichlet", mode, times)
        ratio.append(ratios)
        thresholds.append(gamma)
        spreading.append(spreading_norms(epsilon, omega, long_times, 8192))
    thresholds, dims = np.array(thresholds), ("omega",)
    l2, linf = ([exponent(long_times, norms[i]) for norms in spreading] for i in range(2))
    gap = thresholds - gamma_0(np.asarray(omegas, float), epsilon)
    return table(
        "Growth exactly at the threshold of Lemma 1",
        {
            "omega": np.asarray(omegas, float),
            "tau": times,
            "norm": ["l2", "linf"],
            "long_tau": long_times,
        },
        ratio=variable(ratio, ("omega", "tau"), "growth of the threshold mode over 4 gamma tau"),
        error=variable(
            np.abs(np.array(ratio) - 1.0).max(axis=1), dims, "its distance to one", tolerance=1e-8
        ),
        grown=variable(
            4.0 * thresholds[:, None] * times * np.array(ratio),
            ("omega", "tau"),
            "growth of the threshold mode, |Im D| / |D(0)|",
        ),
        threshold=variable(thresholds, dims, "threshold of the finite chain"),
        spreading=variable(
            spreading,
            ("omega", "norm", "long_tau"),
            "norm of D at gamma_0 on the infinite chain from one site D = 1 + i",
        ),
        finite_gap=variable(gap, dims, "threshold of the finite chain minus gamma_0"),
        l2_exponent=variable(l2, dims, "power of tau in l2 on the infinite chain at gamma_0"),
        linf_exponent=variable(linf, dims, "the same in l-infinity"),
    )
