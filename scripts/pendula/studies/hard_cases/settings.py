"""What the configuration says of the hard cases: each with its solvers and what is expected.

Numbers may be anything, not finite ones too, since solvers must refuse what makes no sense.
"""

from typing import Annotated, Any, Literal

from latticode.configuration.values import AnyNumber, Model, Name, Whole
from pydantic import Field, create_model, model_validator
from pydantic_core import PydanticCustomError

MEASURES = (
    *("miss_of_linear_flow", "miss_near_threshold", "miss_of_rotation", "drift_of_norms"),
    *("drift_of_energy", "motion_of_rest", "miss_of_other", "miss_of_scaled"),
    *("miss_of_single_pairs", "miss_of_short_chain", "run_anyway"),
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


NUMBERS = ("omega", "gamma", "factor", "size", "turns", "tau", "amplitude")
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
    against: str
    measure: Literal[MEASURES]
    arguments: Arguments = Arguments()
    solvers: Name | list[AnySolver]
    expected: AnyNumber | str


class Settings(Model):
    """Section `hard_cases` of the configuration."""

    solvers: dict[Name, Annotated[list[AnySolver], Field(min_length=1)]]
    cases: Annotated[list[HardCase], Field(min_length=1)]

    @model_validator(mode="after")
    def _solvers_are_known(self) -> "Settings":
        for case in self.cases:
            if isinstance(case.solvers, str) and case.solvers not in self.solvers:
                known = ", ".join(self.solvers)
                raise PydanticCustomError(
                    "solvers",
                    "{case}: there are no solvers {name}; known are {known}",
                    {"case": repr(case.case), "name": repr(case.solvers), "known": known},
                )
        return self

    def plain(self) -> list[dict[str, Any]]:
        """Return the cases as plain values, every one with its own list of solvers."""
        shared, cases = self.model_dump(exclude_none=True)["solvers"], []
        for case in self.model_dump(exclude_none=True)["cases"]:
            named = isinstance(case["solvers"], str)
            cases.append(case | {"solvers": shared[case["solvers"]] if named else case["solvers"]})
        return cases
