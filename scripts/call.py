"""A Snakemake job that calls a function of the library with the paths of its inputs and outputs."""

from job import arguments, called, run


def call(snakemake) -> None:
    """Call the function that `params.call` names; it reads and writes its files itself."""
    (function,) = called(snakemake)
    function(**arguments(snakemake), **dict(snakemake.output.items()))


if __name__ == "__main__":
    run(call, snakemake)  # noqa: F821
