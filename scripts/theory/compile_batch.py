"""Compile the runs in lanes once, so that parallel jobs find them in the cache."""

from pathlib import Path

from pendula.simulation import batches
from pendula.sources import digest_of_modules


def compile_batch(kernels: str) -> None:
    """Run a batch over a short time, then record what it was compiled from."""
    batches.integrate_batch(
        [(1.0, 1.0, 0.0)], "dirichlet", [[[1.0], [0.1]]], [0.0, 0.1], 1e-9, 1e-9
    )
    digest = digest_of_modules(Path(batches.__file__).resolve())
    Path(kernels).write_text(f"{digest}\n", encoding="utf-8")


if __name__ == "__main__":
    from job import run

    run(compile_batch, snakemake)  # noqa: F821
