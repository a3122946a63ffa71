"""Compute a curve of integers with a proven bound of its distance to the true one."""

from typing import Any

from pendula.datasets.netcdf import read, write
from pendula.problem import Problem
from pendula.studies.certified.contents import frame_contents


def certify_by_frames(
    data: str, name: str, problem: dict[str, Any], proof: dict[str, int], reference: list[str]
) -> None:
    """Write the norms of one case, the bound, and the parts that it is the sum of.

    `proof` are the arguments of `frames.certify`; `reference` is the path of the case in
    multiprecision.
    """
    write(data, *frame_contents(name, Problem.of(problem), proof, read(reference[0])))


if __name__ == "__main__":
    from job import run

    run(certify_by_frames, snakemake)  # noqa: F821
