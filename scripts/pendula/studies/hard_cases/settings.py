"""The keys of config/hard_cases.yaml: cases, each with its solvers and the expected outcome.

NaN and infinite numbers are allowed, because solvers must reject them.
"""

from typing import Annotated, Any, Literal

from latticode.configuration.values import AnyNumber, Integer, Section, faults
from pydantic import Field, create_model, model_validator

ARGUMENTS = {
    "miss_of_linear_flow": (("omega", "gamma", "size"), ("tau",)),
    "drift_of_energy": (("tau",), ()),
    "miss_of_other": (("sites",), ()),
    "miss_of_scaled": (("power",), ()),
    "miss_of_short_chain": (("half_width",), ()),
    "run_anyway": ((), ("amplitude", "tau", "omega")),
}
"""The required and the optional arguments of each function of `errors`."""
BY_TOLERANCE, BY_ITERATION = ("rtol", "atol"), ("step", "tolerance", "iterations")
CONTROLS = {
    **dict.fromkeys(("ode45", "dop853", "taylor"), BY_TOLERANCE),
    **dict.fromkeys(("crank_nicolson", "delfour_fortin_payre"), BY_ITERATION),
}
"""The controls that each solver requires."""
FARTHEST_POWER, SHORT_CHAIN = 500, 30
"""The largest allowed power, for a finite (2^power)^2, and the short chain's half-width."""


class AnySolver(Section):
    """A solver and its controls, which may be invalid on purpose."""

    name: Literal[tuple(CONTROLS)]
    rtol: AnyNumber | None = None
    atol: AnyNumber | None = None
    step: AnyNumber | None = None
    tolerance: AnyNumber | None = None
    iterations: Integer | None = None

    @model_validator(mode="after")
    def _complete(self) -> "AnySolver":
        _reject(_wrong_keys(self, CONTROLS[self.name], ("name",), self.name))
        return self


NUMBERS = ("omega", "gamma", "size", "tau", "amplitude")
INTEGERS = ("power", "sites", "half_width")
Arguments = create_model(
    "Arguments",
    __base__=Section,
    __doc__="All arguments of the functions of `errors`; each function uses some of them.",
    **dict.fromkeys(NUMBERS, (AnyNumber | None, None)),
    **dict.fromkeys(INTEGERS, (Integer | None, None)),
)


class HardCase(Section):
    """A case that each of `solvers` must solve, or must reject.

    If `expected` is a number, it is the largest allowed error; a text must be part of the message
    of the rejection.
    """

    case: str
    measure: Literal[tuple(ARGUMENTS)]
    arguments: Arguments = Arguments()
    solvers: Annotated[list[AnySolver], Field(min_length=1)]
    expected: AnyNumber | str

    @model_validator(mode="after")
    def _fitting(self) -> "HardCase":
        needed, optional = ARGUMENTS[self.measure]
        arguments = self.arguments
        errors = _wrong_keys(arguments, needed, optional, self.measure)
        if arguments.sites is not None and not (arguments.sites > 0 and arguments.sites % 2):
            errors.append(("sites", f"is {arguments.sites}; it must be odd and at least 1"))
        if arguments.power is not None and abs(arguments.power) > FARTHEST_POWER:
            ends = f"from -{FARTHEST_POWER} to {FARTHEST_POWER}"
            errors.append(("power", f"is {arguments.power}; it must be {ends}"))
        if arguments.half_width is not None and arguments.half_width < SHORT_CHAIN:
            text = f"is {arguments.half_width}; it must be at least {SHORT_CHAIN}"
            errors.append(("half_width", f"{text}, the half-width of the chain to compare with"))
        if arguments.tau is not None and arguments.tau <= 0.0:
            errors.append(("tau", f"is {arguments.tau:g}; it must be greater than 0"))
        _reject([(f"arguments.{key}", text) for key, text in errors])
        return self


def _wrong_keys(
    section: Section, needed: tuple, optional: tuple, user: str
) -> list[tuple[str, str]]:
    """Return (key, message) for each key that `section` lacks, or that `user` does not use."""
    present, errors = section.model_dump(exclude_none=True), []
    errors += [(key, f"is missing: {user} needs it") for key in needed if key not in present]
    accepted = ", ".join(key for key in (*needed, *optional) if key != "name")
    errors += [
        (key, f"is not used by {user}, which uses {accepted}")
        for key in present
        if key not in (*needed, *optional)
    ]
    return errors


def _reject(errors: list[tuple[str, str]]) -> None:
    if errors:
        raise faults(errors)


class Settings(Section):
    """Section `hard_cases` of the configuration."""

    cases: Annotated[list[HardCase], Field(min_length=1)]

    def plain_cases(self) -> list[dict[str, Any]]:
        """Return the cases as plain values, without the keys that they omit."""
        return self.model_dump(exclude_none=True)["cases"]
