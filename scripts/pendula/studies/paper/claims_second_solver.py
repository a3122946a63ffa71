"""Section 5: the figures of the paper by its second solver.

Single runs of a chaotic case cannot agree for long. Where the motion is chaotic, a run of the
second solver is compared with the ensemble, as one more draw from it.
"""

import json

import numpy as np
from latticode.measures.confidence import chance_of_draw
from latticode.measures.difference import VISIBLE

from pendula.ledger import missing
from pendula.ledger.changes import repeat
from pendula.ledger.chaos import chaotic, regular
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
SIGNIFICANT = Cutoff(0.05, '"significant": the level that is customary in statistics')

SWEEPS = sweeps("fig5_left", "fig5_right", "fig6_left", "fig6_right")
SECOND_SWEEPS = tuple(f"{name}.crank_nicolson" for name in SWEEPS)
FINER = "sweeps/fig6_right.crank_nicolson.finer"
"""A chaotic sweep by the second solver with a finer step, on some of its half-widths."""
DRAWN = {"fig5": ("l2", "linf"), "fig6": ("l2",)}
"""The norms that the text says Figs 5 and 6 draw."""
READINGS = {
    "fig5": (("max", "[10, 50]"), ("mean", "[10, 50]")),
    "fig6": (("max", "[10, 70]"), ("mean", "[10, 40]")),
}
"""The statistic and the window that text and caption give these figures."""


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
        Control("chaotic cases required to agree as single runs", {"lyapunov": regular}),
    ),
)
def second_solver(solvers, lyapunov, members) -> Finding:
    chaos, cases = chaotic(lyapunov), list(map(str, solvers["case"].values))
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
def swept_chance(name: str, second, ensembles) -> float:
    """Return the chance that draws are as far from the means of the ensembles as this sweep.

    It is that of the furthest of the norms that the text draws, by both readings, at all
    half-widths that have an ensemble, by Bonferroni's bound.
    """
    if name not in ensembles["sweep"].values:
        raise UndecidableError(f"there is no ensemble of {name}")
    found = []
    for statistic, window in READINGS[name[:4]]:
        if window not in ensembles["window"].values or window not in second["window"].values:
            raise UndecidableError(f"{name} or its ensemble has no window {window}")
        at = {"quantity": "pair", "statistic": statistic, "window": window}
        drawn = ensembles.sel(sweep=name, **at).dropna("half_width", subset=["l2_mean"])
        shared = np.intersect1d(second["half_width"], drawn["half_width"])
        if len(shared) < FEWEST:
            raise UndecidableError(f"sweep and ensemble share fewer than {FEWEST} half-widths")
        drawn, run = drawn.sel(half_width=shared), second.sel(half_width=shared, **at)
        for norm in DRAWN[name[:4]]:
            moments = (drawn[f"{norm}_{part}"].values for part in ("mean", "deviation"))
            found.append(chance_of_draw(run[norm].values, *moments, int(drawn["swept_members"])))
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
    return bool(chaotic(lyapunov).values[same.values].any())


@claim(
    "Section 5, end",
    "With the second solver Figs 5 and 6 show no significant differences.",
    (*SWEEPS, *SECOND_SWEEPS, FINER, *checks("lyapunov", "ensembles")),
    controls=(
        Control(
            "the sweeps of the first solver, as those of the second",
            dict(zip(SECOND_SWEEPS, SWEEPS, strict=True)),
            confirms=True,
        ),
        Control(
            "Omega = -4 by the second solver for Omega = 8, in a regular sweep",
            {"fig6_left.crank_nicolson": "fig5_left.crank_nicolson"},
        ),
        Control(
            "Omega = 8 by the second solver for Omega = -4, by either step, in a chaotic sweep",
            dict.fromkeys((SECOND_SWEEPS[-1], FINER), "fig6_left.crank_nicolson"),
        ),
        Control("a finer step that changes nothing", {FINER: SECOND_SWEEPS[-1]}),
    ),
)
def second_solver_sweeps(*datasets) -> Finding:
    """Compare regular sweeps point by point, and chaotic ones with their ensembles."""
    (finer, lyapunov, ensembles), count = datasets[-3:], len(SWEEPS)
    measured, chances = {"largest_regular": 0.0}, {}
    for first, second in zip(datasets[:count], datasets[count : 2 * count], strict=True):
        name = str(first.attrs["case"])
        if is_chaotic(lyapunov, first):
            chances[f"chance_{name}"] = swept_chance(name, second, ensembles)
        else:
            measured[f"largest_{name}"] = regular_difference(first, second)
            measured["largest_regular"] = max(measured.values())
    measured |= chances
    regular_agree = Below(SEEN, "largest_regular", says="largest difference of a regular sweep")
    about = "probability of a chaotic sweep as far from its ensembles"
    likely = Above(SIGNIFICANT, *chances, says=about)
    if likely.failing(measured) == ["chance_fig6_right"] and regular_agree.holds(measured):
        measured["chance_by_finer_step"] = swept_chance("fig6_right", finer, ensembles)
        if measured["chance_by_finer_step"] > SIGNIFICANT.value:
            step, other = (one.attrs["solver_step"] for one in (datasets[2 * count - 1], finer))
            return undecided(
                measured,
                "the paper gives no step, and the verdict depends on it: with the assumed step,"
                f" {step:g}, fig6_right by the second solver is unlikely to come from the ensembles"
                f" (probability {measured['chance_fig6_right']:.2g}), and with {other:g} it may"
                f" (probability {measured['chance_by_finer_step']:.2g})",
            )
    return judge(measured, AllOf(regular_agree, likely))
