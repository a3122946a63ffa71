"""Section 5: the figures of the paper by its second solver.

Single runs of a chaotic case cannot agree for long. Where the motion is chaotic, a run of the
second solver is held to the ensemble, as one more draw from it.
"""

import json
from collections.abc import Iterable

import numpy as np

from pendula.ledger import missing
from pendula.ledger.changes import repeat
from pendula.ledger.chaos import chaotic, regular
from pendula.ledger.claim import FEWEST, LARGE, SMALL, Control, checks, claim, number, sweeps
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
from pendula.measures.confidence import chance_of_draw, chance_of_means
from pendula.measures.difference import VISIBLE, difference, divergence_time
from pendula.measures.norms import largest, total_power

from .solvers import by

SECTION = 5

SEEN = Cutoff(VISIBLE, "a reader sees a difference of 1 % of full scale, wider than a line")
SIGNIFICANT = Cutoff(0.05, '"significant": the level that is customary in statistics')
REPEATED = Cutoff(1e-3, "one trajectory on two chains: norms within a tenth of what a reader sees")

SWEEPS = sweeps("fig5_left", "fig5_right", "fig6_left", "fig6_right")
NORMS = ("l2", "linf")
DRAWN = {"fig5": NORMS, "fig6": ("l2",)}
"""The norms that the text says Figs 5 and 6 draw."""
READINGS = {
    "fig5": {"text": ("max", "[10, 50]"), "caption": ("mean", "[10, 50]")},
    "fig6": {"text": ("max", "[10, 70]"), "caption": ("mean", "[10, 40]")},
}
"""The statistic and the window that text and caption give these figures."""
REGULAR = ("largest_regular", "beyond_step_error", "at_half_step")
"""What is measured of the regular cases: the difference, what the step's error leaves, at half."""
SECOND, SECOND_SWEEPS = by("crank_nicolson", (*SMALL, *LARGE)), by("crank_nicolson", SWEEPS)


# --- Figs 2 to 4 ----------------------------------------------------------------------------------


def are_chaotic(lyapunov, datasets) -> list[bool]:
    """Return whether the cases of trajectories or sweeps, which have its data, are chaotic."""
    cases = zip(lyapunov["omega"].values, lyapunov["initial"].values, strict=True)
    known = dict(zip(cases, chaotic(lyapunov).values, strict=True))
    found = []
    for about in (dataset.attrs for dataset in datasets):
        case = about["omega"], about["initial"]
        if case not in known:
            raise UndecidableError(f"it is not known whether {about['case']} is chaotic")
        found.append(bool(known[case]))
    return found


@once
def parted(first, second) -> tuple[float, float]:
    """Return the first tau at which two runs differ visibly, and their largest difference."""
    apart = difference(first, second)
    return float(divergence_time(apart)), float(apart.max())


@once
def off_by(steps, case: str, scheme: str, step: float) -> float:
    """Return the largest difference in a case of a scheme with this step from the first solver."""
    return number(steps, "scheme_difference", case=case, scheme=scheme, step=step)


@once
def late_chances(run, members, case: str, since: float) -> list[np.ndarray]:
    """Return by norm and time window the chance that a draw is as far from the mean as a run.

    The numbers are means of the pair's norms over the windows that begin at `since` or later.
    """
    if members.sizes["member"] < missing.FEWEST:
        raise UndecidableError(f"an ensemble has {missing.FEWEST} members at least")
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
        raise UndecidableError(f"no window of the ensemble of {case} begins after tau = {since:g}")
    return found


@claim(
    "Section 5, end",
    "With the second solver Figs 2 to 4 show no significant differences.",
    (*SMALL, *LARGE, *SECOND, *checks("lyapunov", "members", "second_solver")),
    controls=(
        Control(
            "Omega = -4 by the second solver for Omega = 8, in a regular case",
            {"fig2_small.crank_nicolson": "fig3_small.crank_nicolson"},
        ),
        Control(
            "Omega = -4 by the second solver for Omega = 0, in a chaotic case",
            {"fig4_large.crank_nicolson": "fig3_large.crank_nicolson"},
        ),
        Control("chaotic cases required to agree as single runs", {"lyapunov": regular}),
    ),
)
def second_solver(*datasets) -> Finding:
    (lyapunov, members, steps), count = datasets[-3:], len(SECOND)
    chances, off = [], {}
    measured, step = dict.fromkeys(REGULAR, 0.0), float(steps.attrs["configured_step"])
    pairs = zip(datasets[:count], datasets[count : 2 * count], strict=True)
    chaos = are_chaotic(lyapunov, datasets[:count])
    for (first, second), is_chaotic in zip(pairs, chaos, strict=True):
        case, (time, apart) = str(first.attrs["case"]), parted(first, second)
        measured[f"divergence_{case}"] = time
        if is_chaotic:
            if np.isfinite(time):
                chances.append(of_most(late_chances(second, members, case, time)))
            continue
        off[case] = apart
        beyond = apart - number(steps, "step_error", case=case, scheme="crank_nicolson")
        half = off_by(steps, case, "crank_nicolson", 0.5 * step)
        for name, value in zip(REGULAR, (apart, beyond, half), strict=True):
            measured[name] = max(measured[name], value)
    measured["chance"] = together(chances)
    criterion = AllOf(
        Below(SEEN, "beyond_step_error", says="difference of regular runs, less the step's error"),
        Below(SEEN, "at_half_step", says="difference at half of the assumed step"),
        Above(
            SIGNIFICANT,
            "chance",
            says="probability that most norms of a chaotic case are as far from its ensemble",
        ),
    )
    return judge(measured, criterion, _caveat(off, measured, steps))


def _caveat(regular: dict[str, float], measured, schemes) -> str:
    """Say which regular cases the assumed step spoils, and from when on chaos parts the runs."""
    step, said = float(schemes.attrs["configured_step"]), []
    for case, off in regular.items():
        if off > SEEN.value:
            half = off_by(schemes, case, "crank_nicolson", 0.5 * step)
            other = off_by(schemes, case, "implicit_midpoint", step)
            said.append(
                f"{case} differs visibly from tau = {measured[f'divergence_{case}']:.3g} on, by up "
                f"to {100 * off:.2g} % with the assumed step, {step:g}, and "
                f"{100 * half:.2g} % with half of it (the midpoint rule, the other reading "
                f"of the scheme: {100 * other:.2g} %)"
            )
    times = {
        name.removeprefix("divergence_"): at for name, at in measured.items() if "_fig" in name
    }
    apart = {case: at for case, at in times.items() if case not in regular and np.isfinite(at)}
    if apart:
        listed = ", ".join(f"{case} from tau = {at:.3g} on" for case, at in apart.items())
        said.append(f"chaotic cases become other members of the same ensembles: {listed}")
    return "; ".join(said)


# --- Figs 5 and 6 ---------------------------------------------------------------------------------


def distinct_runs(norms: Iterable[np.ndarray]) -> list[list[int]]:
    """Return the places of the half-widths of one sweep, those together that show one trajectory.

    A front that does not reach the ends leaves no trace of them, so that longer chains repeat it.
    `norms` are those of the sweep at each half-width.
    """
    both, close = np.stack(list(norms)), REPEATED.value
    groups: list[list[int]] = []
    for place in range(both.shape[1]):
        if groups and np.max(np.abs(both[:, place] / both[:, groups[-1][0]] - 1.0)) < close:
            groups[-1].append(place)
        else:
            groups.append([place])
    return groups


def swept_chances(name: str, second, ensembles, statistic: str, window: str) -> list[float]:
    """Return by distinct run the chance that a draw is as far from the mean as the second solver.

    The chance of a run is that of the least of the norms that the text draws and of its
    half-widths, by Bonferroni's bound. Where the second solver has draws too, means are compared.
    """
    drawn = ensembles.sel(sweep=name, quantity="pair", statistic=statistic, window=window)
    second = second.sel(quantity="pair", statistic=statistic, window=window)
    drawn = drawn.dropna("half_width", subset=["l2_mean"])
    shared = np.intersect1d(second["half_width"], drawn["half_width"])
    if len(shared) < FEWEST:
        raise UndecidableError(f"sweep and ensemble share fewer than {FEWEST} half-widths")
    second, drawn = second.sel(half_width=shared), drawn.sel(half_width=shared)
    members = int(drawn["swept_members"])
    chances = []
    for norm in DRAWN[name[:4]]:
        first = drawn[f"{norm}_mean"].values, drawn[f"{norm}_deviation"].values, members
        if "draw" in second.dims:
            chances.append(chance_of_means(_moments(second[norm]), first))
        else:
            chances.append(chance_of_draw(second[norm].values, *first))
    norms = second.isel(draw=0) if "draw" in second.dims else second
    runs = distinct_runs(norms[norm].values for norm in NORMS)
    return [together(np.stack(chances)[:, places]) for places in runs]


def _moments(draws) -> tuple[np.ndarray, np.ndarray, int]:
    return draws.mean("draw").values, draws.std("draw", ddof=1).values, draws.sizes["draw"]


@once
def swept_draws(name: str, second, ensembles) -> dict[str, list[float]]:
    """Return the chances of a chaotic sweep by the reading of the text and by that of the caption.

    With them comes how far off l2 is at most, relative to the mean of the ensemble, by the caption.
    """
    if name not in ensembles["sweep"].values:
        raise UndecidableError(f"there is no ensemble of {name}")
    found = {}
    for reading, (statistic, window) in READINGS[name[:4]].items():
        if window not in ensembles["window"].values or window not in second["window"].values:
            raise UndecidableError(f"{name} or its ensemble has no window {window}")
        found[reading] = swept_chances(name, second, ensembles, statistic, window)
    at = {"quantity": "pair", "statistic": statistic, "window": window}  # of the caption
    l2 = second["l2"].sel(at)
    l2 = l2.mean("draw") if "draw" in l2.dims else l2
    found["off"] = [float(abs(l2 / ensembles["l2_mean"].sel(sweep=name, **at) - 1.0).max())]
    return found


@once
def coverage(name: str, second, ensembles) -> str:
    """Say how many half-widths of a sweep have an ensemble, and which point without is furthest.

    Between two half-widths the mean moves by more than its deviation, so that an ensemble in
    between would be a guess: such a point does not decide. It is shown with its neighbours.
    """
    statistic, window = READINGS[name[:4]]["text"]
    at = {"quantity": "pair", "statistic": statistic, "window": window}
    run = second["l2"].sel(at)
    drawn = ensembles["l2_mean"].sel(sweep=name, **at).dropna("half_width")
    widths, known = run["half_width"].values, drawn["half_width"].values
    said = f"{np.isin(widths, known).sum()} of {len(widths)} half-widths of {name}"
    between = [w for w in widths if w not in known and known[0] < w < known[-1]]
    if not between:
        return said
    off = {}
    for width in between:
        value = float(run.sel(half_width=width))
        sides = known[known < width][-1], known[known > width][0]
        means = [float(drawn.sel(half_width=side)) for side in sides]
        nearer = min(means, key=lambda mean: abs(mean - value))
        beyond = max(min(means) - value, value - max(means)) / nearer  # negative in between
        off[beyond] = width, value, means[0], sides[0], means[1], sides[1]
    return (
        "{} (of the other M the furthest off is {}: l2 = {:.3g}, and the means beside it are "
        "{:.3g} at M = {} and {:.3g} at M = {})".format(said, *off[max(off)])
    )


def of_most(chances: list[np.ndarray]) -> float:
    """Return the chance that most of these chances are that small, dependent or not.

    Most are more than a half, up to the k-th least of n, and the bound is n / k times that one
    (B. Rueger, Metrika 25 (1978) 171). A single number cannot make it small: now and then a tall
    localised state lasts, and its norm is no draw from a normal distribution.
    """
    every = np.sort(np.concatenate([np.atleast_1d(one) for one in chances]))
    least = every.size // 2 + 1
    return float(min(1.0, every.size / least * every[least - 1]))


def together(chances: list[np.ndarray]) -> float:
    """Return the chance that the least of so many chances is that small, by Bonferroni's bound."""
    every = np.concatenate([np.ravel(one) for one in chances]) if len(chances) else np.ones(1)
    return float(min(1.0, every.size * every.min()))


@once
def regular_difference(first, second) -> float:
    """Return the largest relative difference of the pair's norms over all of a sweep."""
    if first.sizes["half_width"] < FEWEST:
        raise UndecidableError(f"the sweeps have fewer than {FEWEST} half-widths")
    pair = {"quantity": "pair"}
    off = [abs(second[norm] / first[norm] - 1.0).sel(pair).max() for norm in ("l2", "linf")]
    return float(max(off))


@once
def runs_by_step(steps) -> list:
    """Return the draws by each step, which are then measured once."""
    return [steps[["l2", "linf"]].isel(finer_step=i) for i in range(steps.sizes["finer_step"])]


@once
def is_drawn(second, steps) -> bool:
    """Return whether the draws by the assumed step are those of a sweep: the first one repeats it.

    The sweep is then judged by all of them, since in chaos a single run decides by its last digits.
    """
    at = {name: steps[name] for name in ("half_width", "window")}
    if not all(np.isin(steps[name], second[name]).all() for name in at):
        return False
    own = runs_by_step(steps)[0].isel(draw=0)
    off = (float(abs(second[norm].sel(at) / own[norm] - 1.0).max()) for norm in NORMS)
    return max(off) <= REPEATED.value


@once
def chance_by_step(name: str, steps) -> float:
    """Return the chance that the means of a sweep by the assumed and by a finer step are one."""
    own, finer = runs_by_step(steps)
    found = []
    for statistic, window in READINGS[name[:4]].values():
        at = {"quantity": "pair", "statistic": statistic, "window": window}
        for norm in DRAWN[name[:4]]:
            found.append(chance_of_means(*(_moments(run[norm].sel(at)) for run in (own, finer))))
    return together(found)


def without_finer_steps(steps):
    """Return the runs of the sweep by the assumed step in the place of those by the finer one."""
    return repeat("finer_step", *steps["finer_step"].values, names="l2")(steps)


@claim(
    "Section 5, end",
    "With the second solver Figs 5 and 6 show no significant differences.",
    (*SWEEPS, *SECOND_SWEEPS, *checks("lyapunov", "ensembles", "second_solver")),
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
            "Omega = 8 by the second solver for Omega = -4, in a chaotic sweep",
            {"fig6_right.crank_nicolson": "fig6_left.crank_nicolson"},
        ),
        Control("finer steps that change nothing", {"second_solver": without_finer_steps}),
    ),
)
def second_solver_sweeps(*datasets) -> Finding:
    (lyapunov, ensembles, steps), count = datasets[-3:], len(SWEEPS)
    level, drawn, covered, finer = {}, {}, [], {}
    pairs = zip(datasets[:count], datasets[count : 2 * count], strict=True)
    chaos = are_chaotic(lyapunov, datasets[:count])
    for (first, second), is_chaotic in zip(pairs, chaos, strict=True):
        name = str(first.attrs["case"])
        if is_chaotic:
            by_draws = is_drawn(second, steps)
            runs = runs_by_step(steps)[0] if by_draws else second
            drawn[name] = swept_draws(name, runs, ensembles)
            covered.append(coverage(name, second, ensembles))
            least = min(together(drawn[name][reading]) for reading in ("text", "caption"))
            if by_draws and least <= SIGNIFICANT.value:
                finer[name] = chance_by_step(name, steps)
        else:
            level[f"largest_{name}"] = regular_difference(first, second)
    measured = {"largest_regular": max(level.values(), default=0.0), **level}
    for reading in ("text", "caption"):
        chances = {name: found[reading] for name, found in drawn.items()}
        every = [chance for one in chances.values() for chance in one]
        measured |= {f"chance_{reading}": together(every), f"runs_{reading}": len(every)}
        measured |= {f"chance_{reading}_{name}": together(one) for name, one in chances.items()}
    measured |= {f"off_{name}": found["off"][0] for name, found in drawn.items()}
    measured |= {f"chance_by_step_{name}": chance for name, chance in finer.items()}
    regular_agree = Below(SEEN, "largest_regular", says="largest difference of a regular sweep")
    said = "probability of a run as far from its ensemble as the furthest, by the"
    likely = [Above(SIGNIFICANT, f"chance_{by}", says=f"{said} {by}") for by in ("text", "caption")]
    held = f"ensembles were run at {' and '.join(covered)}"
    apart = _swept_apart(measured, drawn, held)
    by_step = any(chance <= SIGNIFICANT.value for chance in finer.values())
    if by_step and regular_agree.holds(measured):
        means = ", ".join(f"{chance:.2g} in {name}" for name, chance in finer.items())
        return undecided(
            measured,
            f"the paper gives no step, and the verdict depends on the one assumed: {apart}; with a"
            f" quarter of this step the means differ significantly (probability {means})",
        )
    return judge(measured, AllOf(regular_agree, *likely), held if drawn else "", apart)


def _swept_apart(measured, drawn: dict[str, dict], held: str) -> str:
    """Say which sweeps of the second solver lie apart from the paper's."""
    parts = [
        f"{name.removeprefix('largest_')}, which is regular, differs by {100 * off:.2g} %"
        for name, off in measured.items()
        if name.startswith("largest_fig") and off >= SEEN.value
    ]
    for name, found in drawn.items():
        words = {"text": "maxima of the text", "caption": "averages of the caption"}
        chances = {said: together(found[reading]) for reading, said in words.items()}
        low = {said: chance for said, chance in chances.items() if chance <= SIGNIFICANT.value}
        if low:
            told = " and ".join(f"{chance:.2g} for the {said}" for said, chance in low.items())
            parts.append(
                f"{name} by the second solver is unlikely to come from the ensembles (probability "
                f"{told}); the averages differ by up to {100 * found['off'][0]:.2g} %"
            )
    return "; ".join([*parts, held]) if drawn else "; ".join(parts)
