"""What the accepted datasets show of this project's own solvers and proofs, and not of the paper.

Each statement is a function of datasets, which holds on the accepted ones and not on a wrong one.
"""

from pathlib import Path

import numpy as np
import pytest
from pendula.datasets.netcdf import read
from pendula.measures.difference import VISIBLE

BASELINE = Path(__file__).parents[1] / "baseline"


def chaotic(lyapunov):
    return lyapunov["case"].values[lyapunov["chaotic"].values == 1]


def chaotic_cases_alone_have_ensembles(lyapunov, ensembles):
    return set(chaotic(lyapunov)) == set(ensembles["case"].values)


def errors_grow_faster_once_the_motion_of_fig_3_has_filled_the_chain(lyapunov):
    early, late = (lyapunov.sel(case="fig3_large").isel(span=span) for span in (0, 1))
    return early["exponent_high"] < late["exponent_low"] and 1.6 < early["exponent"] < 2.2


def every_solver_leaves_every_chaotic_trajectory(trust, lyapunov):
    return (
        np.isfinite(trust["horizon"].sel(case=chaotic(lyapunov))).all()
        and (trust["difference"].sel(case=chaotic(lyapunov)).max("tau") > VISIBLE).all()
    )


def rates_of_steady_states_lie_in_their_enclosures(proved, steady):
    shared = [
        one
        for _, one in proved.groupby("proof")
        if str(one["family"].values.item()) in steady["family"].values
        and float(one["omega"].item()) in steady["omega"].values
        and float(one["epsilon"].item()) == steady.attrs["epsilon"]
    ]
    off = []
    for one in shared:
        at = {"family": one["family"].values.item(), "omega": one["omega"].item()}
        rate = float(steady["growth_half"].sel(at))
        beyond = max(rate - one["growth_high"].item(), one["growth_low"].item() - rate, 0.0)
        off.append(beyond / max(rate, 1.0))
    return len(off) >= 3 and max(off) < 1e-6  # the baseline has seven digits


def reversed_cases(dataset):
    return dataset.assign_coords(case=dataset["case"].values[::-1])


STATEMENTS = [
    (chaotic_cases_alone_have_ensembles, ("checks/lyapunov", "checks/ensembles"), reversed_cases),
    (errors_grow_faster_once_the_motion_of_fig_3_has_filled_the_chain, ("checks/lyapunov",),
     lambda lyapunov: lyapunov.isel(span=[1, 0])),
    (every_solver_leaves_every_chaotic_trajectory, ("checks/trust", "checks/lyapunov"),
     reversed_cases),
    (rates_of_steady_states_lie_in_their_enclosures, ("certified/breathers", "breathers/steady"),
     lambda proved: proved.assign(growth_high=0.5 * proved["growth_high"])),
]  # fmt: skip


@pytest.mark.parametrize(
    ("holds", "names", "wrong"), STATEMENTS, ids=[one.__name__ for one, *_ in STATEMENTS]
)
def test_the_accepted_datasets_show_it_and_a_wrong_one_does_not(holds, names, wrong):
    first, *others = (read(BASELINE / f"{name}.nc") for name in names)
    assert holds(first, *others)
    assert not holds(wrong(first), *others)
