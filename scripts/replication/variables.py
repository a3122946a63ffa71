"""Attributes of variables that the comparison, the ledger and the article read.

The code that makes a variable writes them, because the readers then need no lists of names:

`missing_meaning`  why a value is NaN; without it a NaN is unknown, and confirms no claim
`rests_on_chaos`   "no", "yes", "by case" or "by case at all times", or "along x", where x is a
                   dimension with values of a case's parameter; for a variable, or for a dataset
`compared_as`      "upper bound" of what is proved, or "statistic" of a few runs
`fewest_samples`   of a coordinate: a claim needs so many values along it; without it, FEWEST

The default of `rests_on_chaos` is "by case", for a dataset that names a case of the configuration:
then a number rests on chaos from the time on at which its case is no longer known.
"""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import xarray as xr

VARIATION = "variation"
"""The dimension of a number's values when it is measured again with other choices."""

MISSING = "missing_meaning"
CHAOS = "rests_on_chaos"
KIND = "compared_as"
SAMPLES = "fewest_samples"

NO, YES, BY_CASE, ALWAYS, ALONG = "no", "yes", "by case", "by case at all times", "along "
"""Values of `rests_on_chaos`."""
BOUND, STATISTIC = "upper bound", "statistic"
"""Values of `compared_as`."""

REGULAR = {CHAOS: NO}
"""For values of theory, references or the configuration, also in datasets of chaotic runs."""
CHAOTIC = {CHAOS: YES}
"""For values that differ between correct runs."""
ALL_TIMES = {CHAOS: ALWAYS}
"""For values that depend on the end of a run at all times, such as one divided by its maximum."""
PROVEN = {KIND: BOUND}
SCATTERED = {KIND: STATISTIC}
"""For an error, a deviation or a correlation of a few runs, which is uncertain itself."""
FEW_CHOICES = {SAMPLES: 1}
"""For a coordinate whose values are single choices and no series."""


def missing(meaning: str) -> dict[str, str]:
    """Return the attribute with the meaning of NaN."""
    return {MISSING: meaning}


def chaotic_along(dimension: str) -> dict[str, str]:
    """Return the attribute of a variable that is chaotic where a case with this parameter is."""
    return {CHAOS: f"{ALONG}{dimension}"}


def mark(dataset: "xr.Dataset", attributes: Mapping[str, Any], *names: str) -> "xr.Dataset":
    """Return a dataset whose variables of these names have more attributes."""
    marked = {name: dataset[name].assign_attrs(attributes) for name in names if name in dataset}
    return dataset.assign(marked)
