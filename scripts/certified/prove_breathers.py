"""Prove that steady breathers exist, and whether they are stable on a finite chain."""

from pendula.datasets.netcdf import write
from pendula.studies.certified.proved_breathers import breathers_contents


def prove_breathers(
    data: str, gamma: float, half_widths: dict[str, int], proofs: list[dict], wrong: list[dict]
) -> None:
    """Write the proofs of the given families, and the refusals of the wrong ones."""
    write(data, *breathers_contents(gamma, half_widths, proofs, wrong))


if __name__ == "__main__":
    from job import run

    run(prove_breathers, snakemake)  # noqa: F821
