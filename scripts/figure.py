"""A Snakemake job that draws a figure as PNG and PDF, with its data and a description."""

from pendula.contract.log import run  # first: its hook logs an import that fails

# isort: split

from typing import Any

import pendula.names  # noqa: F401, so that datasets have the paper's words
from latticode.datasets.netcdf import read
from latticode.datasets.stated import stated
from latticode.drawing.style import save
from pendula.contract.arguments import function_of, gather_for, load_arguments
from replication.differences import in_short
from xarray import Dataset


def draw(snakemake: Any) -> None:
    """Draw the data of gather_x with draw_x, the function in `params.call`, and write the figure.

    The inputs and parameters of the rule are the arguments of gather_x, which is in the same
    module. `params.unlike_paper` lists differences of the configuration from the paper's.
    """
    function = function_of(snakemake.params.call)
    gather = gather_for(function)
    arguments = load_arguments(gather, snakemake, {Dataset: read})
    shown = gather(**arguments.values)
    names = sorted(name for names in arguments.sources.values() for name in names)
    shown = shown.assign_attrs(stated({}, (), names, function))
    if differs := snakemake.params.unlike_paper:
        comment = f"the configuration differs in {', '.join(differs)}"
        shown = shown.assign_attrs(comment=comment)
    note = f"Not the paper's: {in_short(differs)}" if differs else ""
    save(function(shown), shown, *snakemake.output, note)


if __name__ == "__main__":
    run(draw, snakemake)  # noqa: F821
