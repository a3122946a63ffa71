"""Made-up trajectories and sweeps that fit what the paper says, for turning claims over."""

import numpy as np
import xarray as xr

HALF_WIDTHS = np.array([5, 10, 20, 30, 40, 60, 80, 100])
WINDOWS = ["[10, 40]", "[10, 50]", "[10, 70]"]


def trajectory(case, omega, linf, l2, energy=1.0, drift=0.0, modulus=None) -> xr.Dataset:
    """Return a trajectory whose norms are given as pairs of functions of tau for A and B."""
    tau = np.linspace(0.0, 50.0, 501)
    series = ("component", "tau")
    ds = xr.Dataset(
        {
            "linf": (series, np.array([f(tau) + 0.0 * tau for f in linf])),
            "l2": (series, np.array([f(tau) + 0.0 * tau for f in l2])),
            "energy": ("tau", energy + drift * tau / 50.0),
        },
        {"tau": tau, "component": ["A", "B"]},
        {
            "case": case,
            "epsilon": 1.0,
            "gamma": 1.0,
            "omega": omega,
            "half_width": 30,
            "boundary": "dirichlet",
            "initial": '{"0": [1.0, 0.1]}',
        },
    )
    if modulus is not None:
        ds["modulus"] = (("component", "site", "snapshot"), modulus)
        ds["snapshot_tau"] = ("snapshot", np.linspace(0.0, 50.0, modulus.shape[-1]))
    return ds


def sweep(case, omega, l2, linf=5.0, mean=None) -> xr.Dataset:
    """Return a sweep with these norms of the pair against half-width, in every window."""
    shape = (len(HALF_WIDTHS), 3, 2, len(WINDOWS))
    dims = ("half_width", "quantity", "statistic", "window")
    values = {"l2": np.empty(shape), "linf": np.empty(shape)}
    values["l2"][:, :, 0] = np.broadcast_to(l2, len(HALF_WIDTHS))[:, None, None]
    values["l2"][:, :, 1] = np.broadcast_to(l2 if mean is None else mean, len(HALF_WIDTHS))[
        :, None, None
    ]
    values["linf"][:] = np.broadcast_to(linf, len(HALF_WIDTHS))[:, None, None, None]
    return xr.Dataset(
        {name: (dims, array) for name, array in values.items()},
        {
            "half_width": HALF_WIDTHS,
            "quantity": ["A", "B", "pair"],
            "statistic": ["max", "mean"],
            "window": WINDOWS,
        },
        {
            "case": case,
            "epsilon": 1.0,
            "gamma": 1.0,
            "omega": omega,
            "boundary": "dirichlet",
            "initial": '{"0": [1.0, 0.1]}',
        },
    )


def settling(start, end):
    """Return a function of tau that goes from `start` to `end`, slowly enough for (19)."""
    return lambda tau: end * (start / end) ** np.exp(-0.5 * tau)


def spreading_modulus(reach: int) -> np.ndarray:
    """Return |A_n|, |B_n| on sites -30..30: an excitation that spreads to `reach` by the end."""
    site, time = np.abs(np.arange(-30, 31))[:, None], np.linspace(0.0, 1.0, 51)
    return np.broadcast_to(np.where(site <= 3.0 * reach * time, 5.0, 0.0), (2, 61, 51)) * np.where(
        site <= reach, 1.0, 0.0
    )


def paper_trajectories() -> dict[str, xr.Dataset]:
    """Return the six cases as the paper describes them, kept by energies of the right sign."""
    wave = np.cos
    small = (lambda t: 0.2 + 0.8 * np.exp(-t), lambda t: 0.2 - 0.1 * np.exp(-t))
    swap = (lambda t: np.sqrt(0.5 + 0.3 * wave(t)), lambda t: np.sqrt(0.51 - 0.3 * wave(t)))
    growing = (settling(5.0, 23.0), settling(1.0, 23.0))
    made = {
        "fig2_small": trajectory("fig2_small", 8.0, small, swap, 5.5, 1e-6),
        "fig2_large": trajectory(
            "fig2_large", 8.0, (settling(5.0, 4.9), settling(1.0, 0.4)),
            (settling(5.0, 5.0), settling(1.0, 0.9)), 296.5, 1e-4,
        ),
        "fig3_small": trajectory("fig3_small", -4.0, small, swap, -6.62, 1e-6),
        "fig3_large": trajectory(
            "fig3_large", -4.0, (settling(5.0, 6.0), settling(1.0, 6.0)), growing, -15.5, 1e-4
        ),
        "fig4_small": trajectory(
            "fig4_small", 0.0, (settling(1.0, 4.8), settling(0.1, 4.8)),
            (settling(1.0, 23.0), settling(0.1, 23.0)), -2.58, 1e-6, spreading_modulus(30),
        ),
        "fig4_large": trajectory(
            "fig4_large", 0.0, (settling(5.0, 4.8), settling(1.0, 4.8)), growing, 88.5, 1e-4
        ),
    }  # fmt: skip
    return {f"trajectories/{name}": ds for name, ds in made.items()}


def paper_sweeps() -> dict[str, xr.Dataset]:
    """Return the four sweeps as the paper describes them."""
    growing = np.array([15.0, 20.0, 28.0, 35.0, 40.0, 45.0, 50.0, 55.0])
    falling = np.array([1.25, 1.23, 1.2, 1.19, 1.18, 1.17, 1.17, 1.17])
    made = {
        "fig5_left": sweep("fig5_left", -4.0, falling),
        "fig5_right": sweep("fig5_right", 0.0, growing),
        "fig6_left": sweep("fig6_left", 8.0, 5.2),
        "fig6_right": sweep("fig6_right", -4.0, growing),
    }
    return {f"sweeps/{name}": ds for name, ds in made.items()}
