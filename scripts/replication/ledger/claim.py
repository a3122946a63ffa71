"""Claims and their controls, as a study declares them above the function that decides them."""

import sys
from collections.abc import Callable, Iterable, Mapping
from enum import StrEnum
from types import ModuleType
from typing import NamedTuple

from .criterion import Verdict

Wrong = str | Callable | tuple[str, Callable]


class ClaimControl(NamedTuple):
    """A wrong case for which the deciding function must not confirm the claim.

    `fed` maps the name of a needed dataset to its replacement. This is the name of another dataset,
    a function that makes the wrong dataset from the right one (see `changes`), or a pair: a name,
    and a function of the right and the named dataset. If the claim needs one dataset, `fed` is the
    replacement itself. A name may omit its folder if this is the folder of the claim's dataset.

    With `confirms` the case is right and the function must confirm it. This shows that a function
    which rejects the paper's claim can confirm a right one. `on` names the paper's cases and sweeps
    that the control uses, if a dataset has others as well.
    """

    description: str
    fed: Mapping[str, Wrong] | Wrong
    confirms: bool = False
    on: tuple[str, ...] = ()

    @property
    def must(self) -> str:
        """The outcome that the control requires."""
        return "be confirmed" if self.confirms else "be rejected"

    @property
    def names(self) -> list[str]:
        """The names of the further datasets that the control needs."""
        sources = [wrong if isinstance(wrong, tuple) else (wrong,) for wrong in self.fed.values()]
        return [source[0] for source in sources if isinstance(source[0], str)]


class Origin(StrEnum):
    """The author of a claim: the paper, its open questions, or this project."""

    PAPER = "of the paper"
    OPEN = "on its open questions"
    OWN = "of this project"


class Kind(StrEnum):
    """Kinds of claims; identities and theorems have the same verdict in every run."""

    IDENTITY = "identity"  # both sides are equal, or differ by a sum of squares
    THEOREM = "theorem"  # the paper proves it; numbers can only contradict it
    OBSERVATION = "observation"
    CONCLUSION = "conclusion"  # inferred from a figure that does not show it


class Claim(NamedTuple):
    """A sentence of the paper, the function that decides it, and the controls of that function.

    `needs` names the datasets that decide it: paths below results/ without suffix. `on` names the
    cases and sweeps that the sentence is about, if a dataset has others as well.
    """

    name: str
    place: str
    statement: str
    needs: tuple[str, ...]
    decide: Callable
    controls: tuple[ClaimControl, ...]
    on: tuple[str, ...] = ()
    kind: Kind = Kind.OBSERVATION
    origin: Origin = Origin.PAPER
    rejected: Verdict = Verdict.NOT_REPRODUCED

    @property
    def section(self) -> int:
        """The section of the paper, SECTION in the module of the deciding function."""
        return sys.modules[self.decide.__module__].SECTION

    @property
    def refuted(self) -> Verdict:
        """The verdict if the numbers contradict the claim."""
        return Verdict.NOT_FOLLOWING if self.kind == Kind.CONCLUSION else self.rejected


def claim(
    place: str,
    statement: str,
    needs: tuple[str, ...],
    controls: tuple[ClaimControl, ...] = (),
    on: tuple[str, ...] = (),
    kind: Kind = Kind.OBSERVATION,
    origin: Origin = Origin.PAPER,
    rejected: Verdict = Verdict.NOT_REPRODUCED,
) -> Callable:
    """Return a decorator for the function that decides this claim from the datasets in `needs`.

    The claim has the function's name. `rejected` is the verdict if the numbers contradict it.
    """

    def declare(function: Callable) -> Callable:
        fed = tuple(_by_name(control, needs) for control in controls)
        function.claim = Claim(
            function.__name__, place, statement, needs, function, fed, on, kind, origin, rejected
        )
        return function

    return declare


def _by_name(control: ClaimControl, needs: tuple[str, ...]) -> ClaimControl:
    """Return the control with complete names of datasets in `fed`."""
    fed, complete = control.fed, {}
    if not isinstance(fed, Mapping):
        if len(needs) > 1:
            raise ValueError(
                f"control {control.description!r}: `fed` must be a mapping with names out of "
                f"{', '.join(needs)}"
            )
        fed = {needs[0]: fed}
    for name, wrong in fed.items():
        right = [need for need in needs if name in (need, need.partition("/")[2])]
        if len(right) != 1:
            raise ValueError(
                f"control {control.description!r}: {name} is not one of {', '.join(needs)}"
            )
        replacement, *change = wrong if isinstance(wrong, tuple) else (wrong,)
        if isinstance(replacement, str) and "/" not in replacement:
            replacement = f"{right[0].partition('/')[0]}/{replacement}"
        complete[right[0]] = (replacement, *change) if change else replacement
    return control._replace(fed=complete)


def claims_of(modules: Iterable[ModuleType]) -> tuple[Claim, ...]:
    """Return the claims that modules declare, in the order of the paper's sections.

    Raises ValueError for a module without a claim: its study would be left out of the ledger.
    """
    claims: list[Claim] = []
    for module in modules:
        declared = [each.claim for each in vars(module).values() if hasattr(each, "claim")]
        if not declared:
            raise ValueError(f"{module.__name__} declares no claim: delete it, or use @claim there")
        claims += declared
    return tuple(sorted(claims, key=lambda claim: claim.section))
