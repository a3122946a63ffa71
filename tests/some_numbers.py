"""Datasets with numbers that no solver computes; a program that is run on each machine.

    python tests/some_numbers.py given made

writes them to the folder `made`. It calls the same functions as the rules, with the sizes of a full
run. Fronts are measured on the runs in the folder `given`. bits.py does the same for the numbers of
solvers.
"""

import sys
from pathlib import Path

import numpy as np
from helpers import chosen
from latticode.checks import check_breather
from latticode.datasets.netcdf import Variable, read, save, write
from latticode.datasets.trajectories import Contents
from latticode.localised.rest import describe_unstable_rest
from latticode.measures import confidence
from latticode.numerics.elementary import modulus
from pendula.studies.breathers.contents import solve_periodic_breathers, solve_steady_states
from pendula.studies.certified.proved_breathers import prove_breathers
from pendula.studies.theory.checks import CHECKS, run_checks
from pendula.studies.unbounded.measured import measure_fronts
from pendula.studies.unbounded.thermal import solve_thermal
from problems import problem_of

MEMBERS = 100
"""Largest number of members with confidence limits; studies of a full run have fewer."""
PLAYED = {
    "packages/latticode/latticode/checks.py": ("own",),
    "packages/latticode/latticode/localised/breathers.py": ("own", "proofs", "steady"),
    "packages/latticode/latticode/localised/rest.py": ("rest",),
    "packages/latticode/latticode/measures/confidence.py": ("confidence",),
    "scripts/pendula/studies/breathers/multipliers.py": ("periodic",),
    "scripts/pendula/studies/breathers/periodic.py": ("periodic",),
}
"""Datasets that cover each module that may call LAPACK, BLAS or the C library."""
NAMES = (*CHECKS, "fronts", "thermal", *{name: 0 for names in PLAYED.values() for name in names})


def make(accepted: Path, folder: Path) -> None:
    """Write the datasets of NAMES to the folder `folder`."""
    runs = (read(str(accepted / f"{name}.nc")) for name in ("omegas", "thermal"))
    datasets = dict(zip(CHECKS, run_checks(), strict=True)) | {"fronts": measure_fronts(*runs)}
    datasets["own"] = check_breather(problem_of("fig3_large"))
    for name, data in datasets.items():
        save(str(folder / f"{name}.nc"), data)
    breathers, chains = chosen("breathers"), chosen("unbounded")
    coupling = float(breathers.epsilon), float(breathers.gamma)
    contents = {
        "confidence": limits_of_all_counts(),
        "rest": sentence_on_rest(),
        "periodic": solve_periodic_breathers(
            *coupling, **breathers.periodic.model_dump(exclude={"long"})
        ),
        "proofs": prove_breathers(**chosen("certified").breathers.model_dump()),
        "steady": solve_steady_states(*coupling, **breathers.steady.model_dump()),
        "thermal": solve_thermal(*coupling, list(chains.omegas.values), chains.nodes),
    }
    for name, (variables, attributes) in contents.items():
        write(str(folder / f"{name}.nc"), variables, attributes)


def limits_of_all_counts() -> Contents:
    """Return confidence limits for each number of members, and of each share of MEMBERS."""
    counts, scores = np.arange(MEMBERS + 1), np.linspace(0.1, 9.0, MEMBERS)
    limits = {
        "student": [confidence.student(n) for n in counts[1:]],
        "chance": [[confidence.chance_below(-score, n) for score in scores] for n in counts[1:]],
        "share": [confidence.share_limits(n, MEMBERS)[1:] for n in counts],
        "rate": [confidence.event_rate([0.5] * n + [np.inf], 0.0, 1.0)[1:] for n in counts],
    }
    variables = {
        name: Variable((f"{name}_count", f"{name}_limit")[: np.ndim(values)], values, f"the {name}")
        for name, values in limits.items()
    }
    return variables, {"title": "Confidence limits"}


def sentence_on_rest() -> Contents:
    """Return the sentence on a chain without coupling in which only the central pair moves."""
    problem = problem_of("fig4_small", epsilon=0.0)
    moduli = np.stack([modulus(problem.amplitudes)] * 2, axis=-1)
    moduli[:, problem.half_width, 1] += 1.0
    sentence = Variable(("sentence",), [describe_unstable_rest(problem, moduli)], "on rest")
    return {"sentences": sentence}, {"title": "Sites at rest"}


if __name__ == "__main__":
    make(Path(sys.argv[1]), Path(sys.argv[2]))
