"""Section 5: the energy by the paper's first solver, and its figures by the second one.

Single runs of a chaotic case cannot agree for long. Where the motion is chaotic, a run of the
second solver is held to the ensemble, as one more draw from it.
"""

import json

import numpy as np

from pendula.ledger.claim import FEWEST, LARGE, SMALL, Control, checks, claim, sweeps
from pendula.ledger.criterion import (
    Above,
    AllOf,
    AtMost,
    Below,
    Finding,
    UndecidableError,
    judge,
    undecided,
)
from pendula.ledger.cutoff import Cutoff
from pendula.measures.confidence import chance_of_draw, share_limits
from pendula.measures.difference import VISIBLE, difference, divergence_time, first_above
from pendula.measures.norms import drift, largest, total_power

from .solvers import EARLY, ORDER, STATED_DRIFT

SECTION = 5

SEEN = Cutoff(VISIBLE, "what a reader sees: a part of full scale somewhat wider than a line")
SIGNIFICANT = Cutoff(0.05, '"significant": the level that is customary in statistics')

SWEEPS = sweeps("fig5_left", "fig5_right", "fig6_left", "fig6_right")
TEXT = {"fig5": ("[10, 50]", ("l2", "linf")), "fig6": ("[10, 70]", ("l2",))}
"""What the text says Figs 5 and 6 draw: maxima over these windows of these norms."""
CAPTION = {"fig5": "[10, 50]", "fig6": "[10, 40]"}
"""The windows over which their captions average."""


def by(solver: str, names: tuple[str, ...]) -> tuple[str, ...]:
    """Return the names of the same runs or sweeps by another solver."""
    return tuple(f"{name}.{solver}" for name in names)


SECOND, SECOND_SWEEPS = by("crank_nicolson", (*SMALL, *LARGE)), by("crank_nicolson", SWEEPS)


# --- The energy -----------------------------------------------------------------------------------


def drifts(trajectories, size: str) -> Finding:
    """Return the finding of a claim on the energy over the cases with data of this size.

    The paper gives the order and the tolerances of the solver, not the time to which it holds. So
    the order has to hold early or not at all, and where it holds early only, the end time decides.
    """
    end = min(float(ds["tau"][-1]) for ds in trajectories)
    if end < 2.0 * EARLY:
        raise UndecidableError(f"the runs end at tau = {end:g}, before {2.0 * EARLY:g}")
    allowed, measured, until = ORDER.value * STATED_DRIFT[size], {}, {}
    for ds in trajectories:
        case, off = str(ds.attrs["case"]), drift(ds["energy"])
        measured |= {case: off.max(), f"{case}_early": off[ds["tau"].values <= EARLY].max()}
        until[case] = float(first_above(ds["tau"], off, allowed))
    kept = ", ".join(
        f"{case} to {'the end' if np.isinf(time) else f'tau = {time:.3g}'}"
        for case, time in until.items()
    )
    early, whole = (
        AtMost(allowed, *names, says=f"largest |H - H(0)| to tau = {to:g}")
        for names, to in (([f"{case}_early" for case in until], EARLY), (list(until), end))
    )
    fails = f"at the paper's tolerances H keeps to {ORDER.value:g} times that order in {kept}"
    if early.holds(measured) and not whole.holds(measured):
        return undecided(measured, f"{fails}, and the paper does not say at which time it ends")
    return judge(measured, AllOf(early, whole), fails=fails)


def of_high_order(names: tuple[str, ...]) -> Control:
    fed = dict(zip(names, by("dop853", names), strict=True))
    return Control("the runs of a solver of high order at tight tolerances", fed, confirms=True)


@claim(
    "Section 5",
    "H is conserved to the order of 1e-6 for the smaller data.",
    SMALL,
    controls=(of_high_order(SMALL),),
)
def energy_small(*trajectories) -> Finding:
    return drifts(trajectories, "small")


@claim(
    "Section 5",
    "H is conserved to the order of 1e-4 for the larger data.",
    LARGE,
    controls=(
        of_high_order(LARGE),
        Control(
            "the second solver's run, whose scheme does not conserve H, for that of the first",
            {"trajectories/fig2_large": "trajectories/fig2_large.crank_nicolson"},
        ),
    ),
)
def energy_large(*trajectories) -> Finding:
    return drifts(trajectories, "large")


# --- The second solver: Figs 2 to 4 ---------------------------------------------------------------


def is_chaotic(lyapunov, dataset) -> bool:
    """Return whether the case of a trajectory or a sweep, which has its data, is chaotic."""
    about = dataset.attrs
    same = (lyapunov["omega"] == about["omega"]) & (lyapunov["initial"] == about["initial"])
    if not same.any():
        raise UndecidableError(f"it is not known whether {about['case']} is chaotic")
    return bool(lyapunov["chaotic"].values[same.values][0])


def late_chances(run, members, case: str, since: float) -> list[np.ndarray]:
    """Return by norm and time window the chance that a draw is as far from the mean as a run.

    The numbers are means of the pair's norms over the windows that begin at `since` or later.
    """
    found = []
    for window in map(str, members["window"].values):
        start, end = json.loads(window)
        if start < since or end > float(run["tau"][-1]):
            continue
        kept = run.sel(tau=slice(start, end))
        drawn = members.sel(kind="even", case=case, quantity="pair", window=window)
        norms = {"l2": np.sqrt(total_power(kept)), "linf": largest(kept)}
        for name, values in norms.items():
            level = drawn[f"{name}_level"].values
            spread = level.std(ddof=1)
            found.append(chance_of_draw(values.mean(), level.mean(), spread, len(level)))
    if not found:
        raise UndecidableError(f"no window of the ensemble follows tau = {since:g} in {case}")
    return found


@claim(
    "Section 5, end",
    "Figs 2 to 4 come out of the second solver without significant differences.",
    (*SMALL, *LARGE, *SECOND, *checks("lyapunov", "members", "second_solver")),
    controls=(
        Control(
            "Omega = -4 by the second solver for Omega = 8, in a regular case",
            {"trajectories/fig2_small.crank_nicolson": "trajectories/fig3_small.crank_nicolson"},
        ),
        Control(
            "Omega = -4 by the second solver for Omega = 0, in a chaotic case",
            {"trajectories/fig4_large.crank_nicolson": "trajectories/fig3_large.crank_nicolson"},
        ),
        Control(
            "chaotic cases held to agree as single runs",
            {"checks/lyapunov": lambda ds: ds.assign(chaotic=0 * ds["chaotic"])},
        ),
    ),
)
def second_solver(*datasets) -> Finding:
    (lyapunov, members, steps), count = datasets[-3:], len(SECOND)
    steps, chances, off = steps.sel(scheme="crank_nicolson"), [], {}
    measured = {"largest_regular": 0.0, "beyond_step_error": 0.0, "at_half_step": 0.0}
    for first, second in zip(datasets[:count], datasets[count : 2 * count], strict=True):
        case, apart = str(first.attrs["case"]), difference(first, second)
        time = measured[f"divergence_{case}"] = float(divergence_time(apart))
        if is_chaotic(lyapunov, first):
            chances += late_chances(second, members, case, time) if np.isfinite(time) else []
        else:
            at = steps.sel(case=case)
            off[case] = float(apart.max())
            beyond = off[case] - float(at["step_error"])
            half = float(at["scheme_difference"].sel(step=0.5 * at.attrs["configured_step"]))
            regular = {"largest_regular": off[case], "beyond_step_error": beyond}
            for name, value in (regular | {"at_half_step": half}).items():
                measured[name] = max(measured[name], value)
    measured["chance"] = together(chances)
    criterion = AllOf(
        Below(SEEN, "beyond_step_error", says="difference of regular runs beyond the step's error"),
        Below(SEEN, "at_half_step", says="that at half of the assumed step"),
        Above(SIGNIFICANT, "chance", says="chance of the largest difference from the ensembles"),
    )
    return judge(measured, criterion, _caveat(off, measured, datasets[-1]))


def _caveat(regular: dict[str, float], measured, schemes) -> str:
    """Say which regular cases the assumed step spoils, and from when on chaos parts the runs."""
    step, said = float(schemes.attrs["configured_step"]), []
    for case, off in regular.items():
        if off > SEEN.value:
            found = schemes["scheme_difference"].sel(case=case)
            half = found.sel(scheme="crank_nicolson", step=0.5 * step)
            other = found.sel(scheme="implicit_midpoint", step=step)
            said.append(
                f"{case} differs by {100 * off:.2g} % from tau = "
                f"{measured[f'divergence_{case}']:.3g} on by the assumed step, {step:g}, and by "
                f"{100 * float(half):.2g} % at half of it (the midpoint rule, the other reading of "
                f"the scheme: {100 * float(other):.2g} %)"
            )
    times = {
        name.removeprefix("divergence_"): at for name, at in measured.items() if "_fig" in name
    }
    apart = {case: at for case, at in times.items() if case not in regular and np.isfinite(at)}
    if apart:
        listed = ", ".join(f"{case} from tau = {at:.3g} on" for case, at in apart.items())
        said.append(f"chaotic cases are other runs of the same ensembles: {listed}")
    return "; ".join(said)


# --- The second solver: Figs 5 and 6 --------------------------------------------------------------


def swept_chances(second, drawn, norm: str) -> np.ndarray:
    """Return by half-width the chance that a draw is as far from the mean as the second solver.

    `second` and `drawn` are a sweep and its ensemble at one quantity, statistic and window.
    """
    run = second[norm].reindex(half_width=drawn["half_width"]).dropna("half_width")
    if run.sizes["half_width"] < FEWEST:
        raise UndecidableError("sweep and ensemble share fewer than six half-widths")
    drawn = drawn.sel(half_width=run["half_width"])
    mean, spread = drawn[f"{norm}_mean"].values, drawn[f"{norm}_deviation"].values
    return chance_of_draw(run.values, mean, spread, int(drawn.attrs["swept_members"]))


def swept_draws(name: str, second, ensembles) -> dict[str, list]:
    """Return the chances of a chaotic sweep by the reading of the text and by that of the caption.

    With them comes the largest relative difference from the mean of the ensemble, by the caption.
    """
    if name not in ensembles["sweep"].values:
        raise UndecidableError(f"there is no ensemble of {name}")
    ensemble, (window, norms) = ensembles.sel(sweep=name, quantity="pair"), TEXT[name[:4]]
    read = {"text": ("max", window), "caption": ("mean", CAPTION[name[:4]])}
    found = {}
    for reading, (statistic, window) in read.items():
        if window not in ensemble["window"].values or window not in second["window"].values:
            raise UndecidableError(f"{name} or its ensemble has no window {window}")
        at = {"statistic": statistic, "window": window}
        run, drawn = second.sel(quantity="pair", **at), ensemble.sel(at)
        found[reading] = [swept_chances(run, drawn, norm) for norm in norms]
    found["off"] = [float(abs(run["l2"] / drawn["l2_mean"] - 1.0).max())]
    return found


def together(chances: list[np.ndarray]) -> float:
    """Return the chance that the least of so many chances is that small, by Bonferroni's bound."""
    every = np.concatenate([np.atleast_1d(one) for one in chances]) if chances else np.ones(1)
    return float(min(1.0, every.size * every.min()))


def outside(chances: list[np.ndarray]) -> tuple[int, int]:
    """Return how many points are no likely draws, and how many points there are.

    The deviation of so few members is uncertain, and maxima are not normal. So a single point far
    away says little, and what counts is whether more lie outside than chance leaves there.
    """
    every = np.concatenate([np.atleast_1d(one) for one in chances]) if chances else np.ones(0)
    return int((every < SIGNIFICANT.value).sum()), every.size


def regular_difference(first, second) -> float:
    """Return the largest relative difference of the pair's norms over all of a sweep."""
    if first.sizes["half_width"] < FEWEST:
        raise UndecidableError("the sweeps have fewer than six half-widths")
    pair = {"quantity": "pair"}
    off = [abs(second[norm] / first[norm] - 1.0).sel(pair).max() for norm in ("l2", "linf")]
    return float(max(off))


@claim(
    "Section 5, end",
    "So do Figs 5 and 6.",
    (*SWEEPS, *SECOND_SWEEPS, *checks("lyapunov", "ensembles")),
    controls=(
        Control(
            "Omega = -4 by the second solver for Omega = 8, in a regular sweep",
            {"sweeps/fig6_left.crank_nicolson": "sweeps/fig5_left.crank_nicolson"},
        ),
        Control(
            "Omega = 8 by the second solver for Omega = -4, in a chaotic sweep",
            {"sweeps/fig6_right.crank_nicolson": "sweeps/fig6_left.crank_nicolson"},
        ),
        Control(
            "chaotic sweeps held to agree point by point",
            {"checks/lyapunov": lambda ds: ds.assign(chaotic=0 * ds["chaotic"])},
        ),
    ),
)
def second_solver_sweeps(*datasets) -> Finding:
    (lyapunov, ensembles), count = datasets[-2:], len(SWEEPS)
    regular, drawn = {}, {}
    for first, second in zip(datasets[:count], datasets[count : 2 * count], strict=True):
        name = str(first.attrs["case"])
        if is_chaotic(lyapunov, first):
            drawn[name] = swept_draws(name, second, ensembles)
        else:
            regular[f"largest_{name}"] = regular_difference(first, second)
    measured = {"largest_regular": max(regular.values(), default=0.0), **regular}
    for reading in ("text", "caption"):
        count, points = outside([one for found in drawn.values() for one in found[reading]])
        least = float(share_limits(count, points).low) if points else 0.0
        measured |= {f"outside_{reading}": count, f"points_{reading}": points}
        measured |= {f"share_outside_{reading}_at_least": least}
    measured |= {f"off_{name}": found["off"][0] for name, found in drawn.items()}
    criterion = AllOf(
        Below(SEEN, "largest_regular", says="largest difference of a point of a regular sweep"),
        AtMost(
            SIGNIFICANT,
            "share_outside_text_at_least",
            says="lower limit of the share of chaotic points beyond the limits of the ensembles",
        ),
    )
    off = ", ".join(f"{100 * found['off'][0]:.2g} % ({name})" for name, found in drawn.items())
    text, caption = measured["outside_text"], measured["outside_caption"]
    caveat = (
        f"by the maxima of the text {text} of {measured['points_text']} chaotic points lie beyond "
        f"the limits of the ensembles; by the averages of the captions {caption} do, up to {off} "
        "off their means, since these averages begin before chaos has spread the ensembles"
    )
    return judge(measured, criterion, caveat if drawn else "")
