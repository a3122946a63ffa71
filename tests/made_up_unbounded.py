"""Made-up runs on chains without ends, of the form of their datasets, that fit the conjecture."""

import numpy as np
import xarray as xr
from pendula.studies.unbounded.extremes import mean_maximum

TAU = np.linspace(0.0, 200.0, 401)
PIECES = TAU[4::4]
LEVELS = [1e-6, 1e-2, 1.0, 4.0]
SITES = 400
SIZES = np.array([1, 4, 16, 64])
POWER, TERMS = 16.0, (64.0, -30.0, -8.0, -24.0)
"""P of the bulk, and the terms of its energy a site: two in all."""


def spread(power, variants=1, members=2, omegas=(0.0,), speed=2.9, delay=1.4, amplitudes=(1.0,)):
    """Return runs whose l2 norm is tau^power (one power for all variants, or one for each)."""
    powers = np.broadcast_to(power, variants)
    wobble = 1.0 + 0.002 * np.sin(np.arange(members)[:, None] + TAU)
    l2 = np.sqrt(2.0 * speed * POWER) * np.maximum(TAU, 1.0) ** powers[:, None, None] * wobble
    linf = np.broadcast_to(mean_maximum(thermal(), np.maximum(1.0, speed * TAU)), l2.shape)
    way = np.floor(speed * PIECES - delay * np.log(PIECES))
    front = np.broadcast_to(way[:, None], (variants, members, len(PIECES), len(LEVELS)))
    maxima = wobble[:, 4::4, None] * mean_maximum(thermal(), SIZES)
    rng = np.random.default_rng(1)
    run = ("variant", "member")
    data = xr.Dataset(
        {
            "l2": ((*run, "tau"), l2),
            "linf": ((*run, "tau"), linf * wobble),
            "energy": ((*run, "tau"), 0.0 * l2),
            "front": ((*run, "piece_tau", "front_power"), front),
            "width": ((*run, "piece_tau"), front[..., 0] + 64.0),
            "bulk_power": (
                (*run, "piece_tau", "front_power"),
                POWER * (1.0 + 0.01 * rng.normal(size=front.shape)),
            ),
            "bulk_terms": (
                (*run, "piece_tau", "front_power", "term"),
                np.array(TERMS) * (1.0 + 0.001 * rng.normal(size=(*front.shape, 4))),
            ),
            "bulk_maximum": (
                (*run, "piece_tau", "neighbours"),
                np.broadcast_to(maxima, (variants, *maxima.shape)),
            ),
            "state": (
                (*run, "row", "site"),
                rng.normal(scale=2.0, size=(variants, members, 4, SITES)),
            ),
            "omega": ("variant", np.resize(omegas, variants)),
            "central_modulus": ("variant", np.resize(amplitudes, variants)),
            "predicted_speed": ("variant", np.full(variants, speed)),
            "predicted_delay": ("variant", np.full(variants, delay)),
            "predicted_rest": ("variant", np.zeros(variants)),
        },
        {
            "tau": TAU,
            "piece_tau": PIECES,
            "neighbours": SIZES,
            "front_power": LEVELS,
            "term": ["cubic", "detuning", "drive", "bonds"],
        },
        {"epsilon": 1.0, "gamma": 1.0, "omega": omegas[0], "initial": '{"0": [1.0, 0.1]}'},
    ).assign_attrs(perturbation=1e-6)
    return named(data)


def named(data):
    """Return the dataset with a long name and units on every variable."""
    for name, variable in data.variables.items():
        variable.attrs = {"long_name": str(name), "units": "1"}
    return data


def window_map(omega=0.0, speed=2.9, members=2):
    """Return maxima that grow with M up to M = speed T, and with T."""
    widths, ends = np.array([5, 10, 20, 40, 80, 160, 320, 2000]), np.arange(12.0, 151.0, 2.0)
    reached = np.minimum(widths[:, None], speed * ends)
    l2 = np.broadcast_to(4.0 * np.sqrt(reached), (members, *reached.shape))
    axes = ("member", "half_width", "end")
    data = xr.Dataset(
        {
            "l2": (axes, l2),
            "linf": (axes, 0.0 * l2 + 5.0),
            "predicted_speed": ((), speed),
            "pulled": ((), int(-2.0 < omega < 6.0)),
        },
        {"half_width": widths, "end": ends},
        {"epsilon": 1.0, "gamma": 1.0, "omega": omega, "initial": '{"0": [1.0, 0.1]}'},
    )
    return named(data)


def thermal():
    """Return thermal states of the power of the made-up seas, at Omega = 0 with maxima."""
    bounds = np.linspace(0.1, 9.0, 90)
    below = 1.0 - np.exp(-(bounds**4) / 120.0)
    omegas, waves, moduli = np.array([-1.0, 0.0, 2.0, 5.0]), np.arange(64), np.linspace(0.1, 8, 40)
    data = xr.Dataset(
        {
            "power": ("omega", np.full(4, POWER)),
            "power_error": ("omega", np.full(4, 1e-4)),
            "bound_rate": ("bound", -np.log(below)),
            "bound_overlap": ("bound", below),
            "bound_omega": ((), 0.0),
            "correlation_length": ("omega", [1.0, 1.3, 3.0, 90.0]),
            "warm_power": ("site_energy", POWER + 0.1 * np.array([-2.0, 0.0, 2.0])),
            "warm_terms": (("site_energy", "term"), np.array([TERMS] * 3)),
            "density": (("omega", "modulus"), np.tile(np.exp(-moduli), (4, 1))),
            "spectrum": (("omega", "wave"), np.full((4, 64), 8.0)),
            "wave_number": ("wave", 2.0 * np.pi * waves / 64),
        },
        {
            "omega": omegas,
            "bound": bounds,
            "modulus": moduli,
            "site_energy": [0.0, 2.0, 4.0],
            "term": ["cubic", "detuning", "drive", "bonds"],
        },
        {"epsilon": 1.0, "gamma": 1.0},
    )
    return named(data)
