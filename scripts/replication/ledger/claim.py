"""How a study declares a claim, and how the function that decides it reads datasets."""

import sys
from collections.abc import Callable, Mapping
from enum import StrEnum
from typing import NamedTuple

from .criterion import UndecidableError, Verdict
from .cutoff import Cutoff

# ASSUME: the paper's words for sizes, one measure for each word wherever it stands, so
# that none is fitted to the numbers of one row.
FACTOR = Cutoff(2.0, '"comparable", "the same level", "mix up", "grows": a factor of 2')
MUCH = Cutoff(3.0, '"large", "significantly larger": a factor of 3')
CHANGE = Cutoff(0.25, '"do not change much", "saturates": by less than a quarter')
CONSTANT = Cutoff(0.02, '"does not change": by less than 2 %, which a figure of 5 cm hardly shows')
NEARLY_ALL = Cutoff(0.75, '"nearly monotonic": three of four steps go up', 1.0)

SETTLED = 10.0
"""The paper takes its statistics from here on: its time windows start at tau = 10."""
FEWEST = 6
"""A sweep with fewer half-widths decides nothing."""


Wrong = str | Callable | tuple[str, Callable]


class Control(NamedTuple):
    """A wrong case for a deciding function, which must not confirm the claim by it.

    `fed` says, by the name of a needed dataset, what takes its place: the name of another dataset,
    a function that makes the wrong dataset from the right one, as those of `changes` do, or a pair
    of a name and a function that makes it from the right and the named dataset. Where the claim
    needs one dataset alone, `fed` is what takes the place of that. A folder can be left out of the
    names that the claim needs, and of a name in the same folder.

    `confirms` turns the control round, for a claim that is not reproduced: the function must
    confirm this right case, or it could not have confirmed anything. `on` names the paper's cases
    and sweeps that the control takes from a dataset of many.
    """

    says: str
    fed: Mapping[str, Wrong] | Wrong
    confirms: bool = False
    on: tuple[str, ...] = ()

    @property
    def must(self) -> str:
        """What the function must say of it, in words."""
        return "be confirmed" if self.confirms else "be rejected"

    @property
    def names(self) -> list[str]:
        """The other datasets that it needs."""
        parts = [wrong if isinstance(wrong, tuple) else (wrong,) for wrong in self.fed.values()]
        return [part[0] for part in parts if isinstance(part[0], str)]


class Origin(StrEnum):
    """Whose sentence a claim is: the place of each claim decides it, see `Claim.origin`."""

    PAPER = "of the paper"
    OPEN = "on its open questions"
    OWN = "of this project"


class Kind(StrEnum):
    """What a claim is: an identity or a theorem has the same verdict in every run."""

    IDENTITY = "identity"  # both sides are one polynomial, or differ by a sum of squares
    THEOREM = "theorem"  # the paper proves it; numbers can only contradict it
    OBSERVATION = "observation"
    CONCLUSION = "conclusion"  # what the paper infers from a figure about what it does not show


BEYOND, BREATHERS, PENDULA = "Beyond the paper", "Section 6, breathers", "for the pendula (1)"
"""How the places of claims begin or end that are no sentences of the paper."""


class Claim(NamedTuple):
    """A sentence of the paper, the function that decides it, and the controls of that function.

    `needs` names the datasets that decide it: paths below results/ without their ending. `on` names
    the cases and sweeps that it is on, where a dataset holds others as well.
    """

    name: str
    place: str
    says: str
    needs: tuple[str, ...]
    decide: Callable
    controls: tuple[Control, ...]
    on: tuple[str, ...] = ()
    kind: Kind = Kind.OBSERVATION

    @property
    def section(self) -> int:
        """The section of the paper with which the module of this function begins."""
        return sys.modules[self.decide.__module__].SECTION

    @property
    def origin(self) -> Origin:
        """Whose sentence it is: the paper asks in its Section 6 about breathers and the pendula."""
        if self.place.startswith(BEYOND):
            return Origin.OWN
        asked = self.place.startswith(BREATHERS) or self.place.endswith(PENDULA)
        return Origin.OPEN if asked else Origin.PAPER

    @property
    def refuted(self) -> Verdict:
        """The verdict on it where the numbers contradict it."""
        if self.kind == Kind.CONCLUSION:
            return Verdict.NOT_FOLLOWING
        return Verdict.NOT_CARRIED if self.place.endswith(PENDULA) else Verdict.NOT_REPRODUCED


def claim(
    place: str,
    says: str,
    needs: tuple[str, ...],
    controls: tuple[Control, ...] = (),
    on: tuple[str, ...] = (),
    kind: Kind = Kind.OBSERVATION,
) -> Callable:
    """Return a decorator: the function, which takes the datasets in `needs`, decides this claim.

    The claim has the name of the function.
    """

    def declare(function: Callable) -> Callable:
        fed = tuple(_by_name(control, needs) for control in controls)
        about = (function.__name__, place, says, needs, function, fed, on, kind)
        function.claim = Claim(*about)
        return function

    return declare


def _by_name(control: Control, needs: tuple[str, ...]) -> Control:
    """Return the control with what it feeds by names that all have their folder."""
    fed, found = control.fed, {}
    if not isinstance(fed, Mapping):
        if len(needs) > 1:
            raise ValueError(f"control {control.says!r}: say which of {', '.join(needs)} it feeds")
        fed = {needs[0]: fed}
    for name, wrong in fed.items():
        right = [need for need in needs if name in (need, need.partition("/")[2])]
        if len(right) != 1:
            raise ValueError(f"control {control.says!r}: {name} is not one of {', '.join(needs)}")
        other, *change = wrong if isinstance(wrong, tuple) else (wrong,)
        if isinstance(other, str) and "/" not in other:
            other = f"{right[0].partition('/')[0]}/{other}"
        found[right[0]] = (other, *change) if change else other
    return control._replace(fed=found)


def _in(folder: str) -> Callable[..., tuple[str, ...]]:
    """Return a function that takes names and returns those of the datasets in a folder."""
    return lambda *names: tuple(f"{folder}/{name}" for name in names)


checks, runs = _in("checks"), _in("trajectories")
sweeps, unbounded = _in("sweeps"), _in("unbounded")
SMALL = runs("fig2_small", "fig3_small", "fig4_small")


def late(trajectory, start: float = SETTLED):
    """Return the trajectory from tau = `start` on, which must leave as long a time again."""
    end = float(trajectory["tau"][-1])
    if end < 2.0 * start:
        raise UndecidableError(f"the run ends at tau = {end:g}, before {2.0 * start:g}")
    return trajectory.sel(tau=slice(start, None))


def swept(sweep, norm: str, statistic: str, window: str, quantity: str = "pair"):
    """Return the half-widths of a sweep and one statistic of a norm of the pair at each."""
    if window not in sweep["window"].values:
        raise UndecidableError(f"the sweep has no window {window}")
    values = sweep[norm].sel(quantity=quantity, statistic=statistic, window=window).values
    if len(values) < FEWEST:
        raise UndecidableError(f"the sweep has fewer than {FEWEST} half-widths")
    return sweep["half_width"].values, values


def at_one_omega(one, other) -> None:
    """Raise an error unless two runs or sweeps are at one Omega, as a comparison of them is."""
    if one.attrs["omega"] != other.attrs["omega"]:
        raise UndecidableError("these data are at two values of Omega")


def number(check, name: str, **selection) -> float:
    """Return one number of a check's dataset."""
    return float(check[name].sel(selection).values)
