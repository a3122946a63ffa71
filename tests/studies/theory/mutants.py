"""Names the first check that fails on the library on the path: one mutant a process."""

from pendula.datasets.checks import broken
from pendula.studies.theory.conservation import check_conservation
from pendula.studies.theory.growth import check_balance
from pendula.studies.theory.hamiltonian import check_gradient, check_symmetries
from pendula.studies.theory.pt_symmetry import check_pt_form
from pendula.studies.theory.spectrum import check_dispersion

CONSTANTS = (1.0, 1.0, -4.0)

CHECKS = {
    "gradient": lambda: check_gradient(CONSTANTS, 3, 1),
    "dispersion": lambda: check_dispersion([(-4.0, 1.0), (0.0, 1.0)], 1.0, 5),
    "pt_form": lambda: check_pt_form(CONSTANTS, 3, 0.2),
    "balance": lambda: check_balance(CONSTANTS, 3, 0.2, 1),
    "symmetries": lambda: check_symmetries(CONSTANTS, 3, 0.2),
    "conservation": lambda: check_conservation(1.0, 1.0, [-4.0], 3, 0.3),
}

if __name__ == "__main__":
    print(next((name for name, check in CHECKS.items() if broken(check())), "none"))
