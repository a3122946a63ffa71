"""All checks of the theory, in one job: most of them take less time than the start of a job."""

from collections.abc import Iterator

import numpy as np
import xarray as xr
from latticode.datasets.checks import describe, table, variable
from latticode.equations.initial_values import write_initial
from replication.variables import REGULAR

from .equations import ENDS, PAIR, constants_at, controls_of, one_pair, run, squared_norm
from .stability import check_chart, check_threshold
from .theorems import check_chain_growth, check_errata, check_sharpness
from .well_posed import check_well_posed

HALF_WIDTHS, WINDOW, OMEGA = [5, 10, 20, 40, 60, 80, 120, 140, 160], (10.0, 50.0), 8.0
SOLVER = {"name": "taylor", "rtol": 1e-9, "atol": 1e-14}


def check_not_shown() -> dict:
    """Return the sweep at Omega = 8 from small data that the paper mentions but does not show."""
    constants, peaks = constants_at(OMEGA), []
    for half_width in HALF_WIDTHS:
        data = one_pair(2 * half_width + 1, PAIR)
        outputs = round(40 * WINDOW[1])
        trajectory = run(constants, ENDS, data, WINDOW[1], outputs, solver=SOLVER)
        inside = trajectory.tau >= WINDOW[0]
        peaks.append(np.sqrt(squared_norm(trajectory.l2)[inside].max()))
    checked = table(
        f"Largest l2 on [{WINDOW[0]:g}, {WINDOW[1]:g}] at Omega = {OMEGA:g}, small data",
        {"half_width": HALF_WIDTHS},
        l2=variable(peaks, ("half_width",), "l2 norm over the chain, largest in the window"),
    )
    checked["attrs"] |= {**vars(constants), **controls_of(SOLVER), "end_time": WINDOW[1]}
    checked["attrs"] |= {"boundary": ENDS, "initial": write_initial({0: PAIR})}
    return checked


CHECKS = {
    "not_shown": check_not_shown,
    "errata": check_errata,
    "chart": check_chart,
    "threshold": check_threshold,
    "sharpness": check_sharpness,
    "chain_growth": check_chain_growth,
    "well_posed": check_well_posed,
}


def run_checks() -> Iterator[xr.Dataset]:
    """Yield the tables of CHECKS, in their order."""
    for name, make in CHECKS.items():
        check = make()
        print(f"Check of the theory: {describe(name, check)}")
        yield xr.Dataset.from_dict(check).assign_attrs(epsilon=constants_at(0.0).epsilon, **REGULAR)
