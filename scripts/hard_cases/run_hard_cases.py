"""Run the hard cases: a dataset of what each solver made of them."""

from pendula.datasets.netcdf import write
from pendula.studies.hard_cases.outcomes import outcomes, variables


def run_hard_cases(data: str, cases: list[dict], kernels: list[str] | tuple = ()) -> None:
    """Write the dataset of `cases` (plain values, as the configuration has them).

    A row that does not end as expected is said here and marked in it.
    """
    results = outcomes(cases)
    title = "Hard cases for the solvers: errors against what is known, or refusals in words"
    seeds = "the number of sites, for random data; cases say their constants"
    write(data, variables(results), {"title": title, "seed": seeds})
    for result in results:
        if not result.sound:
            print(f"NOT AS EXPECTED: {result.case}, {result.solver}: {result.error:.3g} ")


if __name__ == "__main__":
    from job import run

    run(run_hard_cases, snakemake)  # noqa: F821
