"""What the configuration says of the hard cases: each with its solvers and what is expected.

Numbers may be anything, not finite ones too, since solvers must refuse what makes no sense.
"""

from typing import Annotated, Any, Literal

from latticode.configuration.values import AnyNumber, Model, Whole
from pydantic import Field, create_model

MEASURES = (
    *("miss_of_linear_flow", "drift_of_energy", "miss_of_other", "miss_of_scaled"),
    *("miss_of_short_chain", "run_anyway"),
)
"""The functions of `errors` by name."""


class AnySolver(Model):
    """A solver and its controls, sound or not."""

    name: Literal["ode45", "crank_nicolson", "delfour_fortin_payre", "dop853", "taylor"]
    rtol: AnyNumber | None = None
    atol: AnyNumber | None = None
    step: AnyNumber | None = None
    tolerance: AnyNumber | None = None
    iterations: Whole | None = None


NUMBERS = ("omega", "gamma", "size", "tau", "amplitude")
WHOLE = ("power", "sites", "half_width")
Arguments = create_model(
    "Arguments",
    __base__=Model,
    __doc__="What the functions of `errors` take; each takes some of them.",
    **dict.fromkeys(NUMBERS, (AnyNumber | None, None)),
    **dict.fromkeys(WHOLE, (Whole | None, None)),
)


class HardCase(Model):
    """A case that each of `solvers` must solve to an error of `expected`, or refuse in words."""

    case: str
    measure: Literal[MEASURES]
    arguments: Arguments = Arguments()
    solvers: Annotated[list[AnySolver], Field(min_length=1)]
    expected: AnyNumber | str


class Settings(Model):
    """Section `hard_cases` of the configuration."""

    cases: Annotated[list[HardCase], Field(min_length=1)]

    def plain(self) -> list[dict[str, Any]]:
        """Return the cases as plain values."""
        return self.model_dump(exclude_none=True)["cases"]
