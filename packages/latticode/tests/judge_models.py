"""Judges solvers on random models: their final state is compared with that of NumPy and SciPy."""

from dataclasses import replace
from itertools import product

import numpy as np
from latticode import simulate
from latticode.integrators import long_taylor
from random_models import ENDS, drawn

SOLVERS = {
    "taylor": ({"rtol": 1e-12, "atol": 1e-12}, 1e-11),
    "dop853": ({"rtol": 1e-12, "atol": 1e-12}, 1e-11),
    "ode45": ({"rtol": 1e-8, "atol": 1e-8}, 1e-7),
    "kahan_li": ({"step": 0.01}, 1e-10),
}
"""Of each solver its controls, and the error that these allow where small changes do not grow."""
TURNS = [("dop853", "auto"), ("ode45", "kahan_li", "long_taylor"), ("auto", "crank_nicolson")]
"""The solvers beside the default one that take turns from model to model."""


def final(case, **solver):
    """Return the final state (field, site) of a case, and the attributes of its run."""
    run = simulate(case.changed(solver=solver))
    fields = run["final"].values
    return fields[0] + 1j * fields[1] if len(fields) > 1 else fields[0] + 0j, run.attrs


def growth(model, end):
    """Return how much larger a small change of the data is at the end."""
    noise = np.random.default_rng(1).normal(size=(2, *model.start.shape))
    change = 1e-7 * (noise[0] + 1j * noise[1] * model.start.imag.any())
    return np.abs(model.follow(change) - end).max() / 1e-7


def error(model, end, name):
    """Return the largest error of a solver, over what it may be."""
    if name == "crank_nicolson":  # of order two: half the step has a quarter of the error
        coarse, fine = (
            final(model.case, name=name, step=step, tolerance=1e-14, iterations=100)[0] - end
            for step in (0.025, 0.0125)
        )
        return np.abs(4 * fine - coarse).max() / (0.2 * np.abs(coarse).max() + 1e-9)
    if name == "long_taylor":
        limit, long_taylor.LONGER_THAN = long_taylor.LONGER_THAN, 0
        try:
            return error(model, end, "taylor")
        finally:
            long_taylor.LONGER_THAN = limit
    if name == "auto":
        state, attributes = final(model.case, name=name, error=1e-9)
        return np.abs(state - end).max() / (attributes["solver_estimated_error"] + 1e-11)
    controls, allowed = SOLVERS[name]
    state, _ = final(model.case, name=name, **controls)
    ratio = np.abs(state - end).max() / allowed
    return ratio if ratio < 1.0 else ratio / max(1.0, growth(model, end))


def judge(model, names):
    """Return what is wrong with solvers, a line for each: between all ends for the first of them.

    The others are tried between the ends of the model. All refusals are wrong.
    """
    faults = []
    for boundary, name in product(ENDS, names):
        between = replace(model, boundary=boundary)
        if name.removeprefix("long_") not in between.case.solver_names:
            continue
        if name != names[0] and boundary != model.boundary:
            continue
        end = between.follow()
        if end is None:  # it left order one
            continue
        try:
            wrong = error(between, end, name)
            if not wrong < 1.0:
                faults.append(f"{name} {boundary}: {wrong:.1e} times what its error may be")
        except Exception as refusal:
            faults.append(f"{name} {boundary}: {type(refusal).__name__}: {refusal}")
    return faults


def print_faults(first, last):
    """Judge the models of some seeds, and print what is wrong."""
    np.seterr(all="ignore")
    for seed in range(first, last):
        model = drawn(seed)
        faults = judge(model, ["taylor", *TURNS[seed % len(TURNS)]])
        if faults:
            print(f"seed {seed}\n{model}", *faults, sep="\n", flush=True)
    print(f"{last - first} models are judged", flush=True)
