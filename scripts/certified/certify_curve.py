"""Compute a curve with a proven bound of its distance to the true one."""

from typing import Any

from pendula.datasets.netcdf import read, write
from pendula.problem import Problem
from pendula.studies.certified.contents import curve_contents


def certify_curve(
    data: str, name: str, problem: dict[str, Any], made_for: dict[str, float], reference: list[str]
) -> None:
    """Write the norms of one case, the bound, and the parts that it is the sum of.

    The curve is made for the constants `made_for` in place of the problem's, if there are any.
    `reference` is the path of the case in multiprecision, or nothing.
    """
    known = read(reference[0]) if reference else None
    write(data, *curve_contents(name, Problem.of(problem), made_for, known))


if __name__ == "__main__":
    from job import run

    run(certify_curve, snakemake)  # noqa: F821
