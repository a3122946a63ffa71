"""Names the first check that fails on a mutant of the library, each in a fork of this process.

Each line of standard input names the folder of a mutant, and is answered by a line. What other
people wrote takes longer to import than the checks take to run, so that it is imported once.
Nothing is compiled. Instructions for vectors of sites then do not exist: slices take their place.
"""

import os
import sys

import numba  # noqa: F401
import numpy  # noqa: F401
import pydantic  # noqa: F401
import xarray  # noqa: F401

LANES = 8


def load(array, index):
    return array.reshape(-1)[index : index + LANES].copy()


def store(array, index, values):
    array.reshape(-1)[index : index + LANES] = values


def first_failing() -> str:
    """Return the name of the first check that fails on the library on the path, or "none"."""
    from pendula import simd

    simd.load, simd.store = load, store
    from pendula.datasets.checks import broken
    from pendula.problem import Constants
    from pendula.studies.theory.dispersion import check_dispersion
    from pendula.studies.theory.equations import check_conservation, check_gradient
    from pendula.studies.theory.estimates import check_balance
    from pendula.studies.theory.other_forms import check_pt_form, check_symmetries

    constants = Constants(epsilon=1.0, gamma=1.0, omega=-4.0)
    checks = {
        "gradient": lambda: check_gradient(constants, 3, 1, 1),
        "dispersion": lambda: check_dispersion([(-4.0, 1.0), (0.0, 1.0)], 1.0, 5),
        "pt_form": lambda: check_pt_form(constants, 3, 0.2, 3),
        "balance": lambda: check_balance(constants, 3, 0.2, 1, 7),
        "symmetries": lambda: check_symmetries(constants, 3, 0.2, 2),
        "conservation": lambda: check_conservation(1.0, 1.0, [-4.0], 3, 0.3, 13),
    }
    return next((name for name, check in checks.items() if broken(check())), "none")


if __name__ == "__main__":
    for line in iter(sys.stdin.readline, ""):
        if not os.fork():
            sys.path.insert(0, line.rstrip("\n"))
            print(first_failing(), flush=True)
            os._exit(0)
        _, status = os.wait()
        if status:
            print("no check: it ended in an error", flush=True)
