"""How a study declares a claim, how its function reads datasets, and the verdicts on all claims."""

import math
from collections.abc import Callable, Iterable, Mapping
from enum import StrEnum
from functools import cache
from types import ModuleType
from typing import NamedTuple

from pendula import studies
from pendula.configuration.paper import Differences, reason

from .criterion import REFUTED, Finding, UndecidableError, Verdict, not_applicable, undecided
from .cutoff import Cutoff, Flip, flips, recorded
from .missing import missing

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
    confirm this right case, or it could not have confirmed anything. `undecided` says that the
    function must leave this case undecided, for example because a bound does not exist there. `on`
    names the paper's cases and sweeps that the control takes from a dataset of many.
    """

    says: str
    fed: Mapping[str, Wrong] | Wrong
    confirms: bool = False
    undecided: bool = False
    on: tuple[str, ...] = ()

    @property
    def must(self) -> str:
        """What the function must say of it, in words."""
        if self.confirms:
            return "be confirmed"
        return "be left undecided" if self.undecided else "be rejected"

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


BEYOND, BREATHERS, PENDULA = "Beyond the paper", "Section 6, breathers", "for the pendula (1)"
"""How the places of claims begin or end that are no sentences of the paper."""


class Claim(NamedTuple):
    """A sentence of the paper, the function that decides it, and the controls of that function.

    `needs` names the datasets that decide it: paths below results/ without their ending. `on` names
    the cases and sweeps that it is on, where a dataset holds others as well. Functions of several
    studies may decide one sentence: each has a `reading` then, such as "ensembles".
    """

    name: str
    place: str
    says: str
    needs: tuple[str, ...]
    decide: Callable
    controls: tuple[Control, ...]
    on: tuple[str, ...] = ()
    reading: str = ""

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
        return Verdict.NOT_CARRIED if self.place.endswith(PENDULA) else Verdict.NOT_REPRODUCED


def claim(
    place: str,
    says: str,
    needs: tuple[str, ...],
    controls: tuple[Control, ...] = (),
    on: tuple[str, ...] = (),
    reading: str = "",
) -> Callable:
    """Return a decorator: the function, which takes the datasets in `needs`, decides this claim.

    The claim has the name of the function.
    """

    def declare(function: Callable) -> Callable:
        fed = tuple(_by_name(control, needs) for control in controls)
        function.claim = Claim(function.__name__, place, says, needs, function, fed, on, reading)
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
LARGE = runs("fig2_large", "fig3_large", "fig4_large")


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


# --- All claims, and their verdicts ---------------------------------------------------------------


@cache
def all_claims(*modules: str) -> tuple[Claim, ...]:
    """Return the claims of all studies, or those in `modules`, in the order of the paper.

    `modules` are starts of names, such as "theory/claims" and "paper/claims_norms".
    """
    return tuple(
        function.claim
        for module in _in_order(modules)
        for function in vars(module).values()
        if hasattr(function, "claim")
    )


def _in_order(modules: tuple[str, ...]) -> list[ModuleType]:
    found = [module for start in modules or ("claims",) for module in studies.all_modules(start)]
    return sorted(found, key=lambda module: module.SECTION)


def sections(*modules: str) -> dict[str, int]:
    """Return the section of the paper with which each module begins, by its name in the rows."""
    return {_home(module.__name__): module.SECTION for module in _in_order(modules)}


def _home(module: str) -> str:
    return module.removeprefix(f"{studies.__name__}.")


def in_order(rows: Iterable[dict], sections: Mapping[str, int]) -> list[dict]:
    """Return rows of several parts of the ledger in the order of the paper.

    Each module of claims names the SECTION of the paper with which it begins; modules of one
    section come in the order of the list of studies.
    """

    def place(row: dict) -> tuple:
        module = row["function"].rpartition(".")[0]
        return sections[module], studies.STUDIES.index(module.partition(".")[0]), module

    return sorted(rows, key=place)


def needed(*modules: str) -> list[str]:
    """Return every dataset that the claims in `modules` read, once each, in their order."""
    names: list[str] = []
    for claim in all_claims(*modules):
        names += claim.needs
        names += [name for control in claim.controls for name in control.names]
    return list(dict.fromkeys(names))


def decide(claim: Claim, sources: Mapping) -> Finding:
    """Return the finding of one claim; without its datasets it cannot be decided."""
    absent = [name for name in claim.needs if name not in sources]
    if absent:
        return undecided({}, f"{', '.join(absent)} was not made")
    try:
        finding = claim.decide(*(sources[name] for name in claim.needs))
    except UndecidableError as reason:
        return undecided({}, str(reason))
    if finding.verdict in REFUTED:
        return finding._replace(verdict=claim.refuted)
    lacking = missing(claim.needs, sources, claim.on) if confirmed(finding) else ""
    return undecided(finding.measured, lacking) if lacking else finding


def feed(claim: Claim, control: Control, sources: Mapping) -> Finding:
    """Return the finding of a claim's function on a control."""
    absent = [name for name in (*claim.needs, *control.names) if name not in sources]
    if absent:
        return undecided({}, f"{', '.join(absent)} was not made")

    def made(name: str, wrong: Wrong):
        if isinstance(wrong, str):
            return sources[wrong]
        if isinstance(wrong, tuple):
            other, change = wrong
            return change(sources[name], sources[other])
        return wrong(sources[name])

    try:
        fed = {name: made(name, wrong) for name, wrong in control.fed.items()}
    except UndecidableError as reason:
        return undecided({}, str(reason))
    return decide(claim, {**sources, **fed})


def passes(control: Control, finding: Finding) -> bool | None:
    """Return whether a finding is what the control must give, None where it does not apply.

    A refusal must come from numbers: what is missing or no number refuses everything.
    """
    if finding.verdict == Verdict.NOT_APPLICABLE:
        return None
    if control.confirms:
        return confirmed(finding)
    if control.undecided:
        return finding.verdict == Verdict.UNDECIDED
    judged = finding.criterion.names if finding.criterion else ()
    known = not any(math.isnan(finding.measured[name]) for name in judged)
    return finding.verdict in REFUTED and known


def confirmed(finding: Finding) -> bool:
    """Return whether a claim is confirmed, with a caveat or without."""
    return finding.verdict in (Verdict.CONFIRMED, Verdict.CAVEAT)


def apart(differs: Differences, claim: Claim, control: Control | None = None) -> str:
    """Return why a claim, or a control of it, is not on the paper's cases; empty where it is."""
    own = reason(differs, claim.needs, claim.on)
    if own or control is None:
        return own
    of_same = reason(differs, claim.needs, control.on) if control.on else ""
    return of_same or reason(differs, control.names, control.on)


def evaluate(
    sources: Mapping, differs: Differences | None = None, modules: Iterable[str] = ()
) -> list[dict]:
    """Return every claim with its verdict, ready for JSON, from {dataset name: opened dataset}.

    `modules` are those of the claims, as `all_claims` takes them; without any they are all.

    A verdict that changes where a cut-off moves by a third says so. Where a control comes out
    wrong, its function cannot decide the claim. `differs` says where the
    configuration is not the paper's: a claim or a control that rests on such a key is not
    applicable.
    """
    return [_row(claim, sources, differs or {}) for claim in all_claims(*modules)]


def _row(claim: Claim, sources: Mapping, differs: Differences) -> dict:
    why = apart(differs, claim)
    if why:
        finding, cutoffs, moved = not_applicable(why), set(), []
    else:
        with recorded() as cutoffs:
            finding = decide(claim, sources)
        moved = flips(finding.verdict, cutoffs, lambda: str(decide(claim, sources).verdict))
    controls = [
        (control, not_applicable(why) if why else feed(claim, control, sources))
        for control in claim.controls
        for why in (apart(differs, claim, control),)
    ]
    finding = _severe(finding, moved, controls)
    return {
        "name": claim.name,
        "names": [claim.name],
        "place": claim.place,
        "origin": str(claim.origin),
        "says": claim.says,
        "reading": claim.reading,
        "decided_by": list(claim.needs),
        "function": f"{_home(claim.decide.__module__)}.{claim.decide.__name__}",
        "measured": _plain(finding),
        "criterion": str(finding.criterion or ""),
        "verdict": str(finding.verdict),
        "because": finding.because,
        "cutoffs": [_cutoff_row(cutoff) for cutoff in sorted(cutoffs)],
        "rests_on": [
            _cutoff_row(flip.cutoff) | {"moved_to": plain(flip.value), "verdict": flip.verdict}
            for flip in moved
        ],
        "controls": [
            {
                "fed": control.says,
                "must": control.must,
                "verdict": str(fed.verdict),
                "because": fed.because,
                "measured": _plain(fed),
                "passes": passes(control, fed),
            }
            for control, fed in controls
        ],
    }


def _severe(
    finding: Finding, moved: list[Flip], controls: list[tuple[Control, Finding]]
) -> Finding:
    """Return the finding with what the moved cut-offs and the controls say against it."""
    failed = next(((c, fed) for c, fed in controls if passes(c, fed) is False), None)
    if failed is not None and finding.verdict != Verdict.UNDECIDED:
        control, fed = failed
        wrong = f"{control.says}: must {control.must}, found: {fed.verdict}"
        return undecided(finding.measured, f"its function fails a control: {wrong}")
    if not moved:
        return finding
    rests = f"depends on the cut-off: {'; '.join(map(str, moved))}"
    because = f"{finding.because}; {rests}" if finding.because else rests
    kept = Verdict.CAVEAT if finding.verdict == Verdict.CONFIRMED else finding.verdict
    return finding._replace(because=because, verdict=kept)


def _cutoff_row(cutoff: Cutoff) -> dict:
    return {"value": plain(cutoff.number), "from": cutoff.origin}


def _plain(finding: Finding) -> dict:
    return {name: plain(value) for name, value in finding.measured.items()}


def plain(value: float) -> float | str:
    """Return a number as JSON can hold it: six digits, the infinite as a word."""
    return float(f"{value:.6g}") if math.isfinite(value) else "infinite" if value > 0 else "none"


def controls_of(rows: list[dict]) -> list[dict]:
    """Return what every claim's function said of its controls, from the rows of the ledger."""
    return [{"claim": row["name"], **control} for row in rows for control in row["controls"]]


def cutoff_lines(rows: list[dict]) -> list[tuple]:
    """Return (value, origin, claims that read it, claims that rest on it) of every cut-off."""
    decides: dict[tuple, dict] = {}
    rest: dict[tuple, dict] = {}
    for key, users in (("cutoffs", decides), ("rests_on", rest)):
        for row in rows:
            for cutoff in row[key]:
                users.setdefault((cutoff["value"], cutoff["from"]), {})[row["name"]] = None
    return [(*one, ", ".join(decides[one]), ", ".join(rest.get(one, ()))) for one in decides]
