"""Attributes of variables that the comparison, the ledger and the article read.

The code that makes a variable sets them, so that the readers need no lists of names:

`missing_meaning`  why a value is NaN; without it a NaN is unknown, and confirms no claim
`rests_on_chaos`   of a variable or a dataset: "no", "yes", "by case", "by case at all times", or
                   "along x", where x is a dimension with values of a case's parameter
`compared_as`      "upper bound" (proven), or "statistic" of a few runs
`fewest_samples`   of a coordinate: the number of values that a claim needs, by default FEWEST

The default of `rests_on_chaos` is "by case", for a dataset that names a case of the configuration:
then a number rests on chaos after the horizon of trust of its case.
"""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import xarray as xr

VARIATION = "variation"
"""The dimension along which a number is measured again with other choices."""

MISSING = "missing_meaning"
CHAOS = "rests_on_chaos"
KIND = "compared_as"
SAMPLES = "fewest_samples"

NO, YES, BY_CASE, ALWAYS, ALONG = "no", "yes", "by case", "by case at all times", "along "
"""Values of `rests_on_chaos`."""
BOUND, STATISTIC = "upper bound", "statistic"
"""Values of `compared_as`."""

REGULAR = {CHAOS: NO}
"""For values from theory, references or the configuration in datasets of chaotic runs."""
CHAOTIC = {CHAOS: YES}
"""For values that differ between correct runs."""
ALL_TIMES = {CHAOS: ALWAYS}
"""For values that depend on the end of a run at all times, such as a curve over its maximum."""
PROVEN = {KIND: BOUND}
SCATTERED = {KIND: STATISTIC}
"""For an error, a deviation or a correlation of a few runs, which is itself uncertain."""
FEW_CHOICES = {SAMPLES: 1}
"""For a coordinate whose values are single choices, not a series."""


def missing(meaning: str) -> dict[str, str]:
    """Return the attribute that declares the meaning of NaN."""
    return {MISSING: meaning}


def chaotic_along(dimension: str) -> dict[str, str]:
    """Return the attribute of a variable that rests on chaos only at some values of `dimension`.

    The dimension has the values of a parameter. The variable is chaotic where a case is chaotic.
    """
    return {CHAOS: f"{ALONG}{dimension}"}


def mark(dataset: "xr.Dataset", attributes: Mapping[str, Any], *names: str) -> "xr.Dataset":
    """Return the dataset with these attributes added to its variables `names`."""
    marked = {name: dataset[name].assign_attrs(attributes) for name in names if name in dataset}
    return dataset.assign(marked)
