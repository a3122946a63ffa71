"""Made-up runs on infinite chains, of the form of their datasets, that fit the conjecture."""

import numpy as np
import xarray as xr

TAU = np.linspace(0.0, 200.0, 401)
PIECES = TAU[4::4]
LEVELS = [1e-6, 1e-2, 1.0, 4.0]
POWER, TERMS = 16.0, (64.0, -30.0, -8.0, -24.0)
"""P of the bulk, and the terms of its energy a site: two in all."""
OF_TERMS = ["cubic", "detuning", "drive", "bonds"]


def spread(power=0.5, variants=1, members=2, omegas=(0.0,), speed=2.9, delay=1.4):
    """Return runs whose l2 norm is tau^power (one power for all variants, or one for each)."""
    powers = np.broadcast_to(power, variants)
    wobble = 1.0 + 0.002 * np.sin(np.arange(members)[:, None] + TAU)
    l2 = np.sqrt(2.0 * speed * POWER) * np.maximum(TAU, 1.0) ** powers[:, None, None] * wobble
    way = np.floor(speed * PIECES - delay * np.log(PIECES))
    front = np.broadcast_to(way[:, None], (variants, members, len(PIECES), len(LEVELS)))
    rng, run = np.random.default_rng(1), ("variant", "member")
    looks = (*run, "piece_tau", "front_power")
    noise, less = rng.normal(size=front.shape), rng.normal(size=(*front.shape, 4))
    data = xr.Dataset(
        {
            "l2": ((*run, "tau"), l2),
            "linf": ((*run, "tau"), 0.0 * l2 + 6.0),
            "front": (looks, front),
            "bulk_power": (looks, POWER * (1.0 + 0.01 * noise)),
            "bulk_terms": ((*looks, "term"), np.array(TERMS) * (1.0 + 0.001 * less)),
            "omega": ("variant", np.resize(omegas, variants)),
            "predicted_speed": ("variant", np.full(variants, speed)),
            "predicted_delay": ("variant", np.full(variants, delay)),
            "predicted_rest": ("variant", np.zeros(variants)),
        },
        {"tau": TAU, "piece_tau": PIECES, "front_power": LEVELS, "term": OF_TERMS},
        {"epsilon": 1.0, "gamma": 1.0, "initial": '{"0": [1.0, 0.1]}'},
    )
    return named(data)


def exact(delay=1.4):
    """Return runs whose l2^2 is 2 v P tau less the delay, and an offset of -50."""
    run, passed = spread(delay=delay), 2.9 * TAU - delay * np.log(np.maximum(TAU, 1.0))
    return run.assign(l2=0.0 * run["l2"] + np.sqrt(np.maximum(2.0 * POWER * passed - 50.0, 1.0)))


def named(data):
    """Return the dataset with a long name and units on every variable."""
    for name, variable in data.variables.items():
        variable.attrs = {"long_name": str(name), "units": "1"}
    return data


def thermal():
    """Return thermal states of the power of the made-up runs, at Omega = 0 with maxima."""
    bounds = np.linspace(0.1, 9.0, 90)
    below = 1.0 - np.exp(-(bounds**4) / 120.0)
    data = xr.Dataset(
        {
            "power": ("omega", np.full(4, POWER)),
            "bound_rate": ("bound", -np.log(below)),
            "bound_overlap": ("bound", below),
            "bound_omega": ((), 0.0),
            "warm_power": ("site_energy", POWER + 0.1 * np.array([-2.0, 0.0, 2.0])),
            "warm_terms": (("site_energy", "term"), np.array([TERMS] * 3)),
        },
        {"omega": [-1.0, 0.0, 2.0, 5.0], "bound": bounds, "site_energy": [0.0, 2.0, 4.0],
         "term": OF_TERMS},
        {"epsilon": 1.0, "gamma": 1.0},
    )  # fmt: skip
    return named(data)
