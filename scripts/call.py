"""A Snakemake job that calls a function, which reads and writes files itself."""

from typing import Any

from pendula.contract.arguments import function_of, load_arguments
from pendula.contract.log import run


def call(snakemake: Any) -> None:
    """Call the function that `params.call` names, with the rule's inputs, outputs, parameters."""
    function = function_of(snakemake.params.call)
    function(**load_arguments(function, snakemake, {}).values)


if __name__ == "__main__":
    run(call, snakemake)  # noqa: F821
