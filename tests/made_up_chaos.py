"""Small made-up datasets of chaos: the plots need no run."""

import numpy as np
import xarray as xr
from made_up_checks import dataset

CASES = ["fig2_small", "fig4_large"]
SWEEPS = ["fig5_right", "fig6_right"]
LABELS = {
    "omega": ("case", [8.0, 0.0]),
    "initial": ("case", ['{"0": [1.0, 0.1]}', '{"0": [5.0, 1.0]}']),
}
RATES = np.array([[0.001, 0.002], [1.5, 1.7]])  # (case, parity)
SIZE = 1e-12


def lyapunov() -> xr.Dataset:
    """Return exponents of changes that grow at RATES, on solutions of constant size."""
    tau, rtol = np.linspace(0.0, 20.0, 81), [1e-6, 1e-9, 1e-12]
    spectrum = np.full((1, 2, 20), np.nan)
    spectrum[0, 0, :12], spectrum[0, 1] = np.linspace(2, -2, 12), np.linspace(2, -2, 20)
    divergence_time = np.array([[np.inf] * 3, [8.0, 12.0, 16.0]])
    coordinates = {"case": CASES, "parity": ["even", "odd"], "tau": tau, "rtol": rtol}
    coordinates |= {"spectrum_case": CASES[1:], "index": np.arange(1, 21)}
    coordinates |= {"spectrum_half_width": [1, 2]}
    along = ("spectrum_case", "spectrum_half_width", "index")
    return dataset(
        coordinates,
        **LABELS,
        log_growth=(("case", "parity", "tau"), RATES[:, :, None] * tau),
        l2=(("case", "tau"), np.full((2, tau.size), 3.0)),
        exponent=(("case", "parity"), RATES),
        divergence_predicted=(("case", "rtol"), divergence_time),
        divergence_measured=(("case", "rtol"), divergence_time + 1),
        exponents=(along, spectrum),
        exponents_error=(along, 0.0 * spectrum + 0.1),
        exponents_undriven=(along[::2], 0.0 * spectrum[:, 0]),
        exponents_error_undriven=(along[::2], 0.0 * spectrum[:, 0] + 0.1),
    )


def lifetimes() -> xr.Dataset:
    """Return lives of one amplitude that changes over at once, of one that may, of one that won't.

    The middle one changes over at tau = 50 in half of the runs.
    """
    tau = np.linspace(0.0, 100.0, 201)
    half = np.where(tau < 50.0, 1.0, 0.5)
    shares = np.array([np.where(tau < 5.0, 1.0, 0.0), half, 1.0 + 0.0 * tau])
    ends = {"": 0.0, "_low": -0.1, "_high": 0.1}
    infinite = np.inf
    medians = {
        "": [5.0, 50.0, infinite], "_low": [5.0, 50.0, infinite], "_high": [5.0, infinite, infinite]
    }  # fmt: skip
    none = np.nan
    rates = {"": [none, 0.01, 0.0], "_low": [none, 0.005, 0.0], "_high": [none, 0.02, 0.001]}
    series = {
        f"surviving{end}": (("start_amplitude", "tau"), np.clip(shares + off, 0.0, 1.0))
        for end, off in ends.items()
    }
    numbers = {
        f"{name}{end}": (("start_amplitude",), values)
        for name, by_end in (("median", medians), ("rate", rates))
        for end, values in by_end.items()
    }
    lives = np.array([[5.0] * 64, [50.5, infinite] * 32, [infinite] * 64])
    numbers["rate_chance"] = (("start_amplitude",), [1.0, 0.3, 1.0])
    numbers["life"] = (("start_amplitude", "member"), lives)
    made = dataset({"start_amplitude": [1.0, 7.0, 10.0], "tau": tau}, **series, **numbers)
    return made.assign_attrs(settled=10.0)


def symmetry() -> xr.Dataset:
    """Return odd parts that grow at the odd RATES from rounding and from SIZE."""
    tau = np.linspace(0.0, 10.0, 101)
    grown = np.exp(RATES[:, 1, None] * tau)
    rounded = 1e-16 * grown
    rounded[:, 0] = 0.0
    perturbed = SIZE * np.stack([grown, 2 * grown], axis=1)
    made = dataset(
        {"case": CASES, "tau": tau},
        **LABELS,
        rounded=(("case", "tau"), rounded),
        perturbed=(("case", "member", "tau"), perturbed),
    )
    return made.assign_attrs(perturbation=SIZE)


def ensembles() -> xr.Dataset:
    """Return bands one apart, and swept maxima that tell where they stand."""
    tau, quantile = np.linspace(0.0, 5.0, 11), np.array([0.05, 0.25, 0.5, 0.75, 0.95])
    quantity, half_width = ["A", "B", "pair"], np.array([5, 20])
    bands = np.arange(5.0)[:, None, None] + np.arange(3.0)[:, None] * 10 + 0 * tau
    swept = ("sweep", "half_width", "quantity", "statistic", "window")
    shape = (2, 2, 3, 2, 3)
    mean = 1.0 + np.arange(np.prod(shape)).reshape(shape)
    made = dataset(
        {
            "case": CASES, "tau": tau, "quantile": quantile, "quantity": quantity,
            "sweep": SWEEPS, "half_width": half_width, "statistic": ["max", "mean"],
            "window": ["[10, 50]", "[10, 70]", "[10, 40]"],
        },
        **LABELS,
        l2=(("case", "quantile", "quantity", "tau"), np.array([bands, 2 * bands])),
        linf=(("case", "quantile", "quantity", "tau"), np.array([bands, bands])),
        swept_members=("sweep", [2, 2]),
        l2_mean=(swept, mean),
        l2_deviation=(swept, mean / 10),
        linf_mean=(swept, mean / 2),
        linf_deviation=(swept, mean / 20),
    )  # fmt: skip
    return made.assign_attrs(members=3)
