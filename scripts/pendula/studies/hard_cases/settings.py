"""What the configuration says of the hard cases: each with its solvers and what is expected.

Numbers may be anything, not finite ones too, since solvers must refuse what makes no sense.
"""

from typing import Annotated, Any, Literal

from latticode.configuration.values import AnyNumber, Model, Whole, faults
from pydantic import Field, create_model, model_validator

TAKES = {
    "miss_of_linear_flow": (("omega", "gamma", "size"), ("tau",)),
    "drift_of_energy": (("tau",), ()),
    "miss_of_other": (("sites",), ()),
    "miss_of_scaled": (("power",), ()),
    "miss_of_short_chain": (("half_width",), ()),
    "run_anyway": ((), ("amplitude", "tau", "omega")),
}
"""The functions of `errors` by name: the arguments that each needs, and those that it may take."""
BY_TOLERANCE, BY_ITERATION = ("rtol", "atol"), ("step", "tolerance", "iterations")
CONTROLS = {
    **dict.fromkeys(("ode45", "dop853", "taylor"), BY_TOLERANCE),
    **dict.fromkeys(("crank_nicolson", "delfour_fortin_payre"), BY_ITERATION),
}
"""The controls that each solver needs."""
FARTHEST_POWER, SHORT_CHAIN = 500, 30
"""The square of 2 to a larger power overflows; the half-width of the chain to compare with."""


class AnySolver(Model):
    """A solver and its controls, sound or not."""

    name: Literal[tuple(CONTROLS)]
    rtol: AnyNumber | None = None
    atol: AnyNumber | None = None
    step: AnyNumber | None = None
    tolerance: AnyNumber | None = None
    iterations: Whole | None = None

    @model_validator(mode="after")
    def _complete(self) -> "AnySolver":
        _refuse(_misfits(self, CONTROLS[self.name], ("name",), self.name))
        return self


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
    measure: Literal[tuple(TAKES)]
    arguments: Arguments = Arguments()
    solvers: Annotated[list[AnySolver], Field(min_length=1)]
    expected: AnyNumber | str

    @model_validator(mode="after")
    def _fitting(self) -> "HardCase":
        needed, others = TAKES[self.measure]
        given = self.arguments
        found = _misfits(given, needed, others, self.measure)
        if given.sites is not None and not (given.sites > 0 and given.sites % 2):
            found.append(("sites", f"is {given.sites}; it must be odd and at least 1"))
        if given.power is not None and abs(given.power) > FARTHEST_POWER:
            ends = f"from -{FARTHEST_POWER} to {FARTHEST_POWER}"
            found.append(("power", f"is {given.power}; it must be {ends}"))
        if given.half_width is not None and given.half_width < SHORT_CHAIN:
            text = f"is {given.half_width}; it must be at least {SHORT_CHAIN}"
            found.append(("half_width", f"{text}, that of the chain to compare with"))
        if given.tau is not None and given.tau <= 0.0:
            found.append(("tau", f"is {given.tau:g}; it must be greater than 0"))
        _refuse([(f"arguments.{key}", text) for key, text in found])
        return self


def _misfits(given: Model, needed: tuple, others: tuple, what: str) -> list[tuple[str, str]]:
    """Return the keys that are missing or that `what` does not take."""
    known, found = given.model_dump(exclude_none=True), []
    found += [(key, f"is missing: {what} needs it") for key in needed if key not in known]
    takes = ", ".join(key for key in (*needed, *others) if key != "name")
    found += [
        (key, f"is not taken by {what}, which takes {takes}")
        for key in known
        if key not in (*needed, *others)
    ]
    return found


def _refuse(found: list[tuple[str, str]]) -> None:
    if found:
        raise faults(found)


class Settings(Model):
    """Section `hard_cases` of the configuration."""

    cases: Annotated[list[HardCase], Field(min_length=1)]

    def plain(self) -> list[dict[str, Any]]:
        """Return the cases as plain values."""
        return self.model_dump(exclude_none=True)["cases"]
