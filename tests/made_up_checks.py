"""Small made-up datasets of the form that the checks write: the plots need no check to run."""

import numpy as np
import xarray as xr

CASES = ["fig2_small", "fig3_large"]
SWEEPS = ["fig5_left", "fig6_left"]
FAMILIES = ["theorem_1", "theorem_2_ball", "theorem_2_energy", "theorem_3"]
FORMS = ["theorem_1", "theorem_2", "theorem_2_ball", "theorem_3"]


def variable(dims, values, name, units="1"):
    return dims, np.asarray(values), {"long_name": name, "units": units}


def dataset(coordinates, **variables):
    coordinates = {name: variable((name,), at, name) for name, at in coordinates.items()}
    return xr.Dataset(
        {name: variable(dims, values, name) for name, (dims, values) in variables.items()},
        coordinates,
        {"title": "made up"},
    )


def chart(sites=21, omegas=(-2.0, 0.0, 2.0, 4.0, 6.0), gammas=(0.0, 0.5, 1.0)):
    """Return a chart whose rates are 2 gamma inside the band, measured 1 % too large."""
    omegas, gammas = np.array(omegas), np.array(gammas)
    inside = (omegas >= 0) & (omegas <= 4)
    rate = 2.0 * inside[:, None] * gammas
    curve = np.linspace(omegas[0], omegas[-1], 9)
    threshold = 0.5 * np.maximum(0, np.maximum(-curve, curve - 4))
    dims = ("omega", "gamma")
    return dataset(
        {"omega": omegas, "gamma": gammas, "curve_omega": curve},
        measured=(dims, 1.01 * rate),
        exact_flow=(dims, 1.01 * rate * (1 + 1e-9)),
        finite_rate=(dims, rate),
        infinite_curve=(("curve_omega",), threshold),
        finite_curve=(("curve_omega",), threshold + 0.1),
        sites=((), sites),
    )


def short_chart():
    return chart(5, (0.0, 1.0, 2.0), (0.0, 0.1))


def windows():
    gammas = np.array([0.001, 0.01, 0.1])
    share = 1 - np.outer([1.0, 2.0, 4.0], gammas)
    coordinates = {"half_width": np.array([2, 5, 10]), "gamma": gammas}
    return dataset(coordinates, share=(("half_width", "gamma"), share))


def threshold():
    tau, long_tau = np.array([5.0, 10.0]), np.array([100.0, 200.0])
    decays = np.array([0.6, 0.8, np.inf])
    exponents = np.array([[0.9, 0.4], [0.7, 0.2], [0.5, 0.0]])
    dims = ("omega", "decay", "norm")
    axes = {"tau": tau, "decay": decays, "norm": ["l2", "linf"], "long_tau": long_tau}
    return dataset(
        {"omega": np.array([-4.0, 8.0]), **axes},
        grown=(("omega", "tau"), np.broadcast_to(4 * 2.0 * tau, (2, 2))),
        threshold=(("omega",), [2.0, 2.0]),
        spreading=((*dims, "long_tau"), np.stack([long_tau ** exponents[..., None]] * 2)),
        spreading_exponent=(dims, np.stack([exponents] * 2)),
        spreading_law=(dims[1:], exponents),
    )


def cases():
    """Return one case inside Theorem 1, and one outside every region but Theorem 3."""
    one = ("case",)
    return dataset(
        {"case": CASES},
        omega=(one, [8.0, -4.0]),
        initial=(one, ['{"0": [1.0, 0.1]}', '{"0": [5.0, 1.0]}']),
        observed=(one, [1.0, 800.0]),
        start=(one, [1.0, 26.0]),
        region=(one, ["theorem 1", "none"]),
        ratio=(one, [0.25, 0.4]),
        theorem_1=(one, [4.0, np.inf]),
        theorem_2=(one, [np.inf, np.inf]),
        widened=(one, [np.inf, np.inf]),
        theorem_3=(one, [5000.0, 2000.0]),
    )


def sweeps():
    """Return two sweeps, the second of a half-width less."""
    m, dims, one = np.array([5, 10, 20]), ("sweep", "half_width"), ("sweep",)
    bound = np.array([[400.0, 800.0, 1600.0], [500.0, 1000.0, np.nan]])
    return dataset(
        {"sweep": SWEEPS, "half_width": m},
        omega=(one, [-4.0, 8.0]),
        initial=(one, ['{"0": [1.0, 0.1]}', '{"0": [5.0, 1.0]}']),
        swept_observed=(dims, bound / 400),
        theorem_3=(dims, bound),
        best=(dims, np.minimum(bound, 30.0)),
    )


def samples():
    return dataset({"family": FAMILIES}, worst_sample=(("family",), [0.6, 0.2, 0.9, 0.8]))


def worst():
    one = ("question",)
    return dataset(
        {"question": [f"{name}, dirichlet" for name in FAMILIES] + ["theorem_1, periodic"]},
        worst=(one, [0.7, 0.3, 0.8, 0.95, 0.6]),
        searched_family=(one, [*FAMILIES, FAMILIES[0]]),
        boundary=(one, ["dirichlet"] * len(FAMILIES) + ["periodic"]),
        sites=((), 3),
    )


def sharpness():
    """Return what part of each form is reached on a short and on a long chain."""
    reached = np.array([[0.5, 0.99], [0.5, 0.98], [0.2, 0.3], [0.6, 0.97]])
    coordinates = {"form": FORMS, "sites": np.array([3, 33])}
    return dataset(coordinates, reached=(("form", "sites"), reached))


def chain_growth():
    sites = np.array([5, 11, 21])
    return dataset(
        {"member": np.arange(2), "sites": sites},
        late_power=(("member", "sites"), np.array([[17.0], [18.0]]) * sites),
        constant_n=(("sites",), 48.0 * sites),
    )
