"""Run a group of checks and write each as a dataset, whether it holds or not."""

import xarray
from pendula.datasets.checks import describe
from pendula.datasets.netcdf import save
from pendula.studies.theory.checks import run_check
from pendula.studies.theory.settings import WRONG_FOLDER


def run_checks(
    datasets: list[str], checks: dict[str, dict], kernels: list[str] | tuple = ()
) -> None:
    """Write the numbers of each of `checks` to the path of the same place in `datasets`.

    `checks` has the arguments of each by its name, as the configuration gives them.

    A check that does not hold does not stop the run: it is said here and in the table of claims,
    and it turns the verdicts that rest on it.
    """
    for (name, arguments), path in zip(checks.items(), datasets, strict=True):
        check = run_check(name, arguments)
        said = describe(name, check)
        print(
            f"a wrong statement, for a control: {name}" if name.startswith(WRONG_FOLDER) else said
        )
        save(path, xarray.Dataset.from_dict(check))


if __name__ == "__main__":
    from job import run

    run(run_checks, snakemake)  # noqa: F821
