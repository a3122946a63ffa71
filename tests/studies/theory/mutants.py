"""Names the first check that fails on a mutant of the library, each in a fork of this process.

What other people wrote takes longer to import than the checks take to run, and is here already; the
library is imported anew. Nothing is compiled. Instructions for vectors of sites then do not exist:
slices take their place.
"""

import os
import sys

import numba

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


def first_failing_of(folder: str) -> str:
    """Return the same of the library in a folder, or nothing where it ends in an error."""
    reads, writes = os.pipe()
    if not (child := os.fork()):
        try:
            for name in [name for name in sys.modules if name.split(".")[0] == "pendula"]:
                del sys.modules[name]
            sys.path.insert(0, folder)
            numba.config.DISABLE_JIT, sys.dont_write_bytecode = True, True
            os.write(writes, first_failing().encode())
        finally:
            os._exit(0)
    os.close(writes)
    os.waitpid(child, 0)
    with open(reads) as said:
        return said.read()
