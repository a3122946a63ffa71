"""The dataset of a run whose norms do not move, but where a test says so."""

import numpy as np
import xarray as xr
from latticode.measures.difference import PARAMETERS


def run(count=11, omega=8.0, changes=()):
    """Return norms that are 2 for A and 1 for B, but for `changes` {(norm, row, time): value}."""
    norms = np.repeat([[2.0], [1.0]], count, axis=1)
    data = xr.Dataset(
        {name: (("component", "tau"), norms.copy()) for name in ("linf", "l2")},
        {"tau": 0.5 * np.arange(count), "component": ["A", "B"]},
        {**dict.fromkeys(PARAMETERS, 1.0), "omega": omega, "initial": "{}"},
    )
    data["energy"] = ("tau", np.zeros(count))
    for (name, row, time), value in dict(changes).items():
        data[name][row, time] = value
    return data
