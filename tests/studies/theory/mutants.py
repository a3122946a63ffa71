"""Names the first check that fails on the library on the path: one mutant a process."""

from pendula.datasets.checks import broken
from pendula.problem import Constants
from pendula.studies.theory.dispersion import check_dispersion
from pendula.studies.theory.equations import check_conservation, check_gradient
from pendula.studies.theory.estimates import check_balance
from pendula.studies.theory.other_forms import check_pt_form, check_symmetries

CONSTANTS = Constants(epsilon=1.0, gamma=1.0, omega=-4.0)

CHECKS = {
    "gradient": lambda: check_gradient(CONSTANTS, 3, 1, 1),
    "dispersion": lambda: check_dispersion([(-4.0, 1.0), (0.0, 1.0)], 1.0, 5),
    "pt_form": lambda: check_pt_form(CONSTANTS, 3, 0.2, 3),
    "balance": lambda: check_balance(CONSTANTS, 3, 0.2, 1, 7),
    "symmetries": lambda: check_symmetries(CONSTANTS, 3, 0.2, 2),
    "conservation": lambda: check_conservation(1.0, 1.0, [-4.0], 3, 0.3, 13),
}

if __name__ == "__main__":
    print(next((name for name, check in CHECKS.items() if broken(check())), "none"))
