"""Integrate one case twice in multiprecision, and keep what both runs agree on."""

from pendula.datasets.netcdf import write
from pendula.problem import Problem
from pendula.studies.reference.verified_run import (
    as_case,
    as_variables,
    compare,
    integrate,
    require_agreement,
)


def integrate_reference(
    dataset: str,
    name: str,
    problem: dict,
    snapshots: list[float],
    bits: tuple[int, int],
    decimal: bool,
) -> None:
    """Write the reference of a case; `bits` are those of the stored run and of the second one.

    States are kept at those of the times `snapshots` that are output times.
    Where `decimal` is false, the parameters and data are the doubles nearest to the decimals.
    """
    case = Problem.of(problem)
    run, check = (integrate(case, snapshots, some, decimal) for some in bits)
    apart = compare(run, check)
    for one in (run, check):
        print(f"{name}: {one.bits} bits, order {one.order}, {one.steps} steps")
    print(f"{name}: the norms differ by {apart.norms.max():.1e}, H drifts {apart.energy_drift:.1e}")
    require_agreement(name, run, check, apart)
    write(
        dataset,
        as_variables(run, apart),
        as_case(name, case, run, check, apart, decimal),
    )


if __name__ == "__main__":
    from job import run

    run(integrate_reference, snakemake)  # noqa: F821
