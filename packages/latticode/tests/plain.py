"""The published step control of the explicit methods, plainly, for complex arrays.

The Runge-Kutta coefficients are SciPy's, so that nothing here is shared with the library. Each
method returns the final state and the numbers of accepted and of rejected steps.
"""

import numpy as np
from scipy.integrate import DOP853, RK45


def stages(a, f, z, h, first):
    """Return the slopes of all stages from z. The slope of the first stage, `first`, is known."""
    k = np.zeros((len(a), *z.shape), complex)
    k[0] = first
    for s in range(1, len(a)):
        k[s] = f(z + h * np.tensordot(a[s], k, 1))
    return k


def larger(z, new):
    return np.maximum(np.abs(z), np.abs(new))


def ode45(f, z, times, rtol, atol):
    """MATLAB's ode45 (Shampine and Reichelt, SIAM J. Sci. Comput. 18 (1997) 1)."""
    a = np.zeros((7, 7))
    a[:6, :5], a[6, :6] = RK45.A, RK45.B
    threshold, power, end = atol / rtol, 1 / 5, times[-1]
    t, longest, slope, steps, rejected = times[0], 0.1 * (end - times[0]), f(z), 0, 0
    h = min(longest, times[1] - times[0])
    rate = np.max(np.abs(slope) / np.maximum(np.abs(z), threshold)) / (0.8 * rtol**power)
    if h * rate > 1:
        h = 1 / rate
    while t < end:
        shortest = 16 * np.spacing(t)
        h = min(longest, max(shortest, h))
        if 1.1 * h >= end - t:
            h = end - t
        failures = 0
        while True:
            k = stages(a, f, z, h, slope)
            new = z + h * np.tensordot(a[6], k, 1)
            relative = np.abs(np.tensordot(RK45.E, k, 1)) / np.maximum(larger(z, new), threshold)
            error = h * np.max(relative)
            if error <= rtol:
                break
            h = max(shortest, h * (0.5 if failures else max(0.1, 0.8 * (rtol / error) ** power)))
            failures += 1
        rejected += failures
        t, z, slope, steps = t + h, new, k[6], steps + 1
        if not failures:
            stretch = 1.25 * (error / rtol) ** power
            h = h / stretch if stretch > 0.2 else 5 * h
    return z, steps, rejected


def dop853_start(f, z, slope, rtol, atol, longest):
    """Return the starting step of Hairer, Norsett and Wanner, in the largest-component norm."""
    scale = atol + rtol * np.abs(z)
    d0, d1 = np.max(np.abs(z) / scale), np.max(np.abs(slope) / scale)
    h = min(longest, 0.01 * d0 / d1 if min(d0, d1) > 1e-5 else 1e-6)
    d2 = np.max(np.abs(f(z + h * slope) - slope) / scale) / h
    return min(longest, 100 * h, (0.01 / max(d1, d2)) ** (1 / 8))


def dop853(f, z, times, rtol, atol):
    """DOP853 (dop853.f: safety 0.9, shrink to a third, growth sixfold), largest-component norm."""
    t, end, slope, steps, rejected, most = times[0], times[-1], f(z), 0, 0, 6.0
    h = dop853_start(f, z, slope, rtol, atol, end - t)
    a = np.zeros((13, 13))
    a[:12, :12], a[12, :12] = DOP853.A, DOP853.B
    while t < end:
        h = min(h, end - t)
        k = stages(a, f, z, h, slope)
        new = z + h * np.tensordot(a[12], k, 1)
        scale = atol + rtol * larger(z, new)
        e5, e3 = (np.max(np.abs(np.tensordot(e, k, 1)) / scale) for e in (DOP853.E5, DOP853.E3))
        error = h * e5**2 / np.sqrt(e5**2 + 0.01 * e3**2)
        factor = max(1 / 3, 0.9 * error ** (-1 / 8))
        if not error <= 1:
            rejected, most, h = rejected + 1, 1.0, h * factor
            continue
        t, z, slope, steps = t + h, new, k[12], steps + 1
        h, most = h * min(most, factor), 6.0
    return z, steps, rejected


def taylor(series, z, times, rtol, atol, order):
    """Sum power series over steps that their last two terms allow (Jorba and Zou 2005).

    No step is rejected.
    """
    t, end, steps = times[0], times[-1], 0
    while t < end:
        c = series(z, order)
        allowed = atol + rtol * np.max(np.abs(z))
        radii = [(allowed / np.max(np.abs(c[p]))) ** (1 / p) for p in (order - 1, order)]
        h = min(*radii, end - t)
        z, t, steps = np.tensordot(h ** np.arange(order + 1), c, 1), t + h, steps + 1
    return z, steps, 0
