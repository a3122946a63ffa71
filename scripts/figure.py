"""A Snakemake job that draws figures, each as PNG and PDF with its data and its description."""

import sys
from inspect import signature

import pendula.names  # noqa: F401, so that datasets have the paper's words
from job import arguments, called, datasets_in, name_of, run
from latticode.datasets.netcdf import read
from latticode.datasets.stated import stated
from latticode.drawing.style import save
from pendula.configuration.paper import in_short

KINDS = 4
"""A figure is so many files: PNG, PDF, data, description."""


def draw(snakemake) -> None:
    """Draw by each function that `params.call` names, draw_x, what gather_x beside it returns.

    gather_x is given those of the inputs and parameters that it names, datasets in place of paths
    and lists of datasets in place of lists (`rules.x.output` is one), and by their names what the
    figures before it show.
    """
    files = {name: datasets_in(value) for name, value in arguments(snakemake).items()}
    given = {name: _taken(value) for name, value in arguments(snakemake).items()}
    differs = given.pop("differs")
    given.setdefault("of_paper", not differs)
    paths = list(snakemake.output)
    for number, function in enumerate(called(snakemake)):
        topic = function.__name__.removeprefix("draw")
        gather = getattr(sys.modules[function.__module__], f"gather{topic}")
        wanted = given.keys() & signature(gather).parameters.keys()
        drawn = gather(**{name: given[name] for name in wanted})
        given.setdefault(topic.lstrip("_"), drawn)
        names = [name_of(path) for name in wanted & files.keys() for path in files[name]]
        shown = drawn.assign_attrs(stated({}, (), sorted(names), function))
        note = f"Not the paper's: {in_short(differs)}" if differs else ""
        if differs:
            words = f"the configuration differs in {', '.join(differs)}"
            shown = shown.assign_attrs(comment=words)
        save(function(drawn), shown, *paths[KINDS * number : KINDS * (number + 1)], note)


def _taken(value):
    if isinstance(value, str) and datasets_in(value):
        return read(value)
    return [read(path) for path in datasets_in(value)] or value


if __name__ == "__main__":
    run(draw, snakemake)  # noqa: F821
