"""Section 5: the figures of the paper by its second solver.

Single runs of a chaotic case cannot agree for long. Where the motion is chaotic, a run of the
second solver is compared with the ensemble, as one more draw from it.
"""

import json

import numpy as np
import xarray as xr
from latticode.measures.confidence import chance_of_difference, chance_of_draw
from latticode.measures.difference import VISIBLE

from pendula.ledger import missing
from pendula.ledger.changes import exchange, put, repeat
from pendula.ledger.claim import FEWEST, Control, checks, claim, sweeps
from pendula.ledger.criterion import (
    Above,
    AllOf,
    Below,
    Finding,
    UndecidableError,
    judge,
    undecided,
)
from pendula.ledger.cutoff import Cutoff, once

SECTION = 5

SEEN = Cutoff(VISIBLE, "a reader sees a difference of 1 % of full scale, wider than a line")
RARE = Cutoff(0.0027, "three standard errors, which chance exceeds a few times in a thousand")
SIGNIFICANT = Cutoff(0.05, '"significant": the level that is customary in statistics')

REGULAR, CHAOTIC = sweeps("fig5_left", "fig6_left"), ("fig5_right", "fig6_right")
BY_SECOND = tuple(f"{name}.crank_nicolson" for name in REGULAR)
BY_EITHER = ENSEMBLES, SECOND, FINER = checks("ensembles", "ensembles_second", "ensembles_finer")
"""The chaotic sweeps by the first solver, and by the second one with the assumed step and less."""
DRAWN = {"fig5": ("l2", "linf"), "fig6": ("l2",)}
"""The norms that the text says Figs 5 and 6 draw."""
READINGS = {
    "fig5": (("max", "[10, 50]"), ("mean", "[10, 50]")),
    "fig6": (("max", "[10, 70]"), ("mean", "[10, 40]")),
}
"""The statistic and the window that text and caption give these figures."""

LEAST = 1e-6
"""The digits of a chance: no smaller one is told from zero."""


# --- Figs 2 to 4 ----------------------------------------------------------------------------------


@once
def late_chances(solvers, members, case: str) -> list[float]:
    """Return by norm and window the chance that a draw is as far from the mean as this solver.

    The numbers are means of the pair's norms over the windows after the two solvers diverge.
    """
    if members.sizes["member"] < missing.FEWEST:
        raise UndecidableError(f"an ensemble has {missing.FEWEST} members at least")
    run, found = solvers.sel(case=case), []
    since = float(run["second_divergence"][0])
    for window in map(str, members["window"].values):
        start, end = json.loads(window)
        if start < since or end > float(run["tau"][-1]):
            continue
        kept = run.sel(tau=slice(start, end))
        drawn = members.sel(kind="even", case=case, quantity="pair", window=window)
        for name in ("l2", "linf"):
            level = drawn[f"{name}_level"].values
            value = kept[f"second_{name}"].values.mean()
            found.append(chance_of_draw(value, level.mean(), level.std(ddof=1), len(level)))
    if not found:
        raise UndecidableError(f"no window of the ensemble of {case} begins after tau = {since:g}")
    return found


@claim(
    "Section 5, end",
    "With the second solver Figs 2 to 4 show no significant differences.",
    checks("solvers", "lyapunov", "members"),
    controls=(
        Control(
            "a regular case whose curves differ as those of a chaotic one",
            {"solvers": repeat("case", "fig4_small", at="fig2_small", names="second_difference")},
        ),
        Control(
            "Omega = -4 by the second solver for Omega = 0, in a chaotic case",
            {
                "solvers": repeat(
                    "case", "fig3_large", at="fig4_large", names=("second_l2", "second_linf")
                )
            },
        ),
        Control("chaotic cases required to agree as single runs", {"lyapunov": put("chaotic", 0)}),
    ),
)
def second_solver(solvers, lyapunov, members) -> Finding:
    chaos, cases = lyapunov["chaotic"], list(map(str, solvers["case"].values))
    if unknown := [case for case in cases if case not in chaos["case"].values]:
        raise UndecidableError(f"it is not known whether {', '.join(unknown)} is chaotic")
    is_chaotic = {case: bool(chaos.sel(case=case)) for case in cases}
    steady = [case for case in cases if not is_chaotic[case]]
    off = solvers["second_difference"].sel(case=steady)
    times = {case: float(solvers["second_divergence"].sel(case=case)[0]) for case in cases}
    apart = {case: time for case, time in times.items() if np.isfinite(time)}
    drawn = [case for case in apart if is_chaotic[case]]
    chances = [of_most(late_chances(solvers, members, case)) for case in drawn]
    measured = {
        "largest_regular": float(off[:, 0].max()) if steady else 0.0,
        "at_half_step": float(off[:, 1].max()) if steady else 0.0,
        **{f"divergence_{case}": time for case, time in times.items()},
        "chance": min([1.0, *(len(chances) * chance for chance in chances)]),  # Bonferroni's bound
    }
    criterion = AllOf(
        Below(SEEN, "at_half_step", says="difference of regular runs at half of the assumed step"),
        Above(
            SIGNIFICANT,
            "chance",
            says="probability that most norms of a chaotic case are as far from its ensemble",
        ),
    )
    return judge(measured, criterion, _caveat(off, times))


def _caveat(off, times: dict[str, float]) -> str:
    """Say which regular cases the assumed step spoils, and from when on chaos parts the runs."""
    said = [
        f"{case} differs visibly from tau = {times[case]:.3g} on, by up to {values[0]:.2g} with the"
        f" assumed step, {off['second_step'].values[0]:g}, and {values[1]:.2g} with half of it"
        for case, values in zip(map(str, off["case"].values), off.values, strict=True)
        if values[0] > SEEN.value
    ]
    chaotic_ones = {case: at for case, at in times.items() if case not in off["case"]}
    parted = [f"{case} from tau = {at:.3g} on" for case, at in chaotic_ones.items() if at < np.inf]
    if parted:
        said.append(
            f"chaotic cases become other members of the same ensembles: {', '.join(parted)}"
        )
    return "; ".join(said)


def of_most(chances: list) -> float:
    """Return the chance that most of these chances are that small, dependent or not.

    Most are more than a half, up to the k-th least of n, and the bound is n / k times that one
    (B. Rueger, Metrika 25 (1978) 171). A single number cannot make it small: now and then a tall
    localised state lasts, and its norm is no draw from a normal distribution.
    """
    every = np.sort(chances)
    least = every.size // 2 + 1
    return float(min(1.0, every.size / least * every[least - 1]))


# --- Figs 5 and 6 ---------------------------------------------------------------------------------


@once
def swept_chance(name: str, *ensembles) -> float:
    """Return the chance that two ensembles of a sweep are so far apart though they have one law.

    It is that of the most distant means of the norms that the text draws, by both readings, at all
    half-widths that both have, by Bonferroni's bound.
    """
    if any(name not in each["sweep"].values for each in ensembles):
        raise UndecidableError(f"there is no ensemble of {name}")
    found = []
    for statistic, window in READINGS[name[:4]]:
        if any(window not in each["window"].values for each in ensembles):
            raise UndecidableError(f"an ensemble of {name} has no window {window}")
        at = {"sweep": name, "quantity": "pair", "statistic": statistic, "window": window}
        known = [each.sel(at).dropna("half_width", subset=["l2_mean"]) for each in ensembles]
        known = xr.align(*known)
        if not known[0].sizes["half_width"]:
            raise UndecidableError(f"the ensembles of {name} share no half-width")
        members = [int(each["swept_members"]) for each in known]
        for norm in DRAWN[name[:4]]:
            means, errors = (
                [each[f"{norm}_{part}"].values for each in known] for part in ("mean", "error")
            )
            found.append(chance_of_difference(means, errors, members))
    return float(min(1.0, np.size(found) * np.min(found)))


@once
def regular_difference(first, second) -> float:
    """Return the largest relative difference of the pair's norms over all of a sweep."""
    if first.sizes["half_width"] < FEWEST:
        raise UndecidableError(f"the sweeps have fewer than {FEWEST} half-widths")
    off = [
        abs(second[norm] / first[norm] - 1.0).sel(quantity="pair").max() for norm in ("l2", "linf")
    ]
    return float(max(off))


def is_chaotic(lyapunov, sweep) -> bool:
    """Return whether the case of a sweep is chaotic, which has its data on another chain."""
    same = (lyapunov["omega"] == sweep.attrs["omega"]) & (
        lyapunov["initial"] == sweep.attrs["initial"]
    )
    if not same.any():
        raise UndecidableError(f"it is not known whether {sweep.attrs['case']} is chaotic")
    return bool(lyapunov["chaotic"].values[same.values].any())


@claim(
    "Section 5, end",
    "With the second solver Figs 5 and 6 show no significant differences.",
    (*REGULAR, *BY_SECOND, *checks("lyapunov"), *BY_EITHER),
    controls=(
        Control(
            "the sweeps of the first solver, as those of the second",
            {**dict(zip(BY_SECOND, REGULAR, strict=True)), SECOND: ENSEMBLES},
            confirms=True,
        ),
        Control(
            "Omega = -4 by the second solver for Omega = 8, in a regular sweep",
            {BY_SECOND[1]: BY_SECOND[0]},
        ),
        Control(
            "Omega = 0 by the second solver for Omega = -4, by either step, in chaotic sweeps",
            dict.fromkeys((SECOND, FINER), exchange("sweep")),
        ),
        Control("a finer step that changes nothing", {FINER: SECOND}),
    ),
)
def second_solver_sweeps(*datasets) -> Finding:
    """Compare regular sweeps point by point, and chaotic ones as ensembles of both solvers.

    Nothing is decided where they differ by no more than three standard errors, or come nearer with
    a finer step, for the paper gives none.
    """
    lyapunov, ensembles, second, finer = datasets[4:]
    measured = {"largest_regular": 0.0}
    for first, other in zip(datasets[:2], datasets[2:4], strict=True):
        name = str(first.attrs["case"])
        if is_chaotic(lyapunov, first):
            raise UndecidableError(f"there is no ensemble of {name}")
        measured[f"largest_{name}"] = regular_difference(first, other)
        measured["largest_regular"] = max(measured.values())
    chances = {f"chance_{name}": swept_chance(name, ensembles, second) for name in CHAOTIC}
    measured |= chances
    regular_agree = Below(SEEN, "largest_regular", says="largest difference of a regular sweep")
    likely = Above(SIGNIFICANT, *chances, says="probability of ensembles as far apart")
    if regular_agree.holds(measured) and (off := likely.failing(measured)):
        names = [name.removeprefix("chance_") for name in off]
        nearer = {name: swept_chance(name, ensembles, finer) for name in names}
        by_step = {name: swept_chance(name, second, finer) for name in names}
        measured |= {f"finer_{name}": chance for name, chance in nearer.items()}
        measured |= {f"step_{name}": chance for name, chance in by_step.items()}
        by_any = [
            one
            for one, name in zip(off, names, strict=True)
            if by_step[name] > SIGNIFICANT.value or nearer[name] <= chances[one]
        ]
        if not any(chances[one] < RARE.value for one in by_any):
            steps = "{:g} and {:g}".format(*(one.attrs["solver_step"] for one in (second, finer)))
            said = "; ".join(
                f"{max(LEAST, chances[one]):.2g} and {nearer[name]:.2g} ({name})"
                for one, name in zip(off, names, strict=True)
            )
            because = (
                f"the paper gives no step, and with the steps {steps} ensembles of both solvers are"
                f" as far apart by chance with probabilities of {said}"
            )
            return undecided(measured, because)
    return judge(measured, AllOf(regular_agree, likely))
