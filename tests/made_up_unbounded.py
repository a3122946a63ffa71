"""Made-up runs on infinite chains, of the form of their datasets, that fit the conjecture."""

import numpy as np
import xarray as xr

TAU = np.linspace(0.0, 200.0, 401)
PIECES = TAU[4::4]
POWER, ALONE = 16.0, 12.0
"""P behind the second front, and between the fronts, where A = -B."""
SPEED, SECOND, DELAY = 2.9, 2.0, 1.4
REGIONS = ["behind the second front", "between the fronts"]


def spread(power=0.5, variants=1, members=2, omegas=(0.0,), speed=SPEED, delay=DELAY):
    """Return runs whose l2 norm is tau^power (one power for all variants, or one for each)."""
    powers = np.broadcast_to(power, variants)
    wobble = 1.0 + 0.002 * np.sin(np.arange(members)[:, None] + TAU)
    l2 = np.sqrt(2.0 * speed * POWER) * np.maximum(TAU, 1.0) ** powers[:, None, None] * wobble
    ways = np.floor([speed * PIECES - delay * np.log(PIECES), SECOND * PIECES])
    first, second = np.broadcast_to(ways[:, None, None], (2, variants, members, len(PIECES)))
    rng, run = np.random.default_rng(1), ("variant", "member")
    means = np.array([[POWER, 0.5 * POWER, 0.0], [ALONE, 1e-9, 0.0]])  # (region, kind)
    noise = rng.normal(size=(*first.shape, 2, 3))
    cells = np.where(10.0 * np.arange(70) < SECOND * PIECES[:, None], 1.0, 1e-20)
    data = xr.Dataset(
        {
            "l2": ((*run, "tau"), l2),
            "linf": ((*run, "tau"), 0.0 * l2 + 6.0),
            "front": ((*run, "piece_tau"), first),
            "second_front": ((*run, "piece_tau"), second),
            "region_mean": (
                (*run, "piece_tau", "region", "kind"), means * (1.0 + 0.01 * noise) + 1e-3 * noise
            ),
            "symmetric_power": (
                ("variant", "piece_tau", "cell"), np.broadcast_to(cells, (variants, *cells.shape))
            ),
            "antisymmetric_power": (
                ("variant", "piece_tau", "cell"), np.full((variants, *cells.shape), 8.0)
            ),
            "omega": ("variant", np.resize(omegas, variants)),
            "predicted_speed": ("variant", np.full(variants, speed)),
            "predicted_delay": ("variant", np.full(variants, delay)),
            "predicted_rest": ("variant", np.zeros(variants)),
        },
        {"tau": TAU, "piece_tau": PIECES, "region": REGIONS, "kind": ["P", "|S|^2", "H"]},
        {"epsilon": 1.0, "gamma": 1.0, "initial": '{"0": [1.0, 0.1]}', "perturbation": 1e-6},
    )  # fmt: skip
    return named(data)


def exact(delay=DELAY):
    """Return runs whose l2^2 follows its law, but for an offset of -50."""
    rate = SECOND * POWER + (SPEED - SECOND) * ALONE
    law = 2.0 * rate * TAU - 2.0 * ALONE * delay * np.log(np.maximum(TAU, 1.0))
    run = spread(delay=delay)
    return run.assign(l2=0.0 * run["l2"] + np.sqrt(np.maximum(law - 50.0, 1.0)))


def named(data):
    """Return the dataset with a long name and units on every variable."""
    for name, variable in data.variables.items():
        variable.attrs = {"long_name": str(name), "units": "1"}
    return data


OMEGAS = [-1.0, 0.0, 2.0, 5.0]


def thermal():
    """Return thermal states of the powers of the made-up runs, at Omega = 0 with maxima."""
    bounds = np.linspace(0.1, 9.0, 90)
    below = 1.0 - np.exp(-(bounds**4) / 120.0)
    data = xr.Dataset(
        {
            "power": ("omega", np.full(4, POWER)),
            "antisymmetric_power": ("omega", np.full(4, ALONE)),
            "bound_rate": ("bound", -np.log(below)),
            "bound_overlap": ("bound", below),
            "bound_omega": ((), 0.0),
        },
        {"omega": OMEGAS, "bound": bounds},
        {"epsilon": 1.0, "gamma": 1.0},
    )
    return named(data)


def transverse():
    """Return the predicted speed of the second front of the made-up runs."""
    exponents = np.linspace(0.5, -0.5, 32) * np.ones((4, 1))
    data = xr.Dataset(
        {
            "second_speed": ("omega", np.full(4, SECOND)),
            "second_speed_error": ("omega", np.full(4, 0.1)),
            "exponent": (("omega", "velocity"), exponents),
        },
        {"omega": OMEGAS, "velocity": np.arange(32) / 32},
        {"epsilon": 1.0, "gamma": 1.0},
    )
    return named(data)
