"""Section 5: the energy by the paper's first solver."""

import numpy as np

from pendula.ledger.claim import LARGE, SMALL, Control, claim
from pendula.ledger.criterion import AllOf, AtMost, Finding, UndecidableError, judge, undecided
from pendula.measures.difference import first_above
from pendula.measures.norms import drift

from .solvers import EARLY, ORDER, STATED_DRIFT, by

SECTION = 5


def drifts(trajectories, size: str) -> Finding:
    """Return the finding of a claim on the energy over the cases with data of this size.

    The paper gives the order and the tolerances of the solver. It says neither to which time the
    order holds nor whether it is that of H or relative to H(0). Where these readings part, no
    number decides.
    """
    end = min(float(ds["tau"][-1]) for ds in trajectories)
    if end < 2.0 * EARLY:
        raise UndecidableError(f"the runs end at tau = {end:g}, before {2.0 * EARLY:g}")
    cases = [str(ds.attrs["case"]) for ds in trajectories]
    order, measured, tenfold, limits, kept = STATED_DRIFT[size], {}, {}, [], []
    # ASSUME: the order is that of |H - H(0)| itself, as figures and tables show it.
    for suffix, of in (("", ""), ("_relative", " / |H(0)|")):
        found, until = _kept(trajectories, size, relative=bool(suffix))
        kept.append(until)
        measured |= {f"{name}{suffix}": value for name, value in found.items()}
        near = sum(found[case] <= 10.0 * order for case in cases)
        tenfold[f"cases_within_tenfold{suffix}"] = near
        for part, to in (("_early", EARLY), ("", end)):
            names = (f"{case}{part}{suffix}" for case in cases)
            says = f"largest |H - H(0)|{of} to tau = {to:g}"
            limits.append(AtMost(ORDER.value * order, *names, says=says))
    measured |= tenfold
    held = [limit.holds(measured) for limit in limits]
    fails = f"|H - H(0)| stays below {ORDER.value:g} times that order {kept[0]}"
    first, second = tenfold.values()
    divided = (
        f"|H - H(0)| / |H(0)| does so {kept[1]}; the first stays below 10 times that order to"
        f" the end in {first} of {len(cases)} cases, and the second in {second}"
    )
    if held[:2] != held[2:]:
        return undecided(measured, f"{fails}, and {divided}; the paper does not say which it means")
    if held[0] and not held[1]:
        return undecided(measured, f"{fails}, and the paper does not say up to which time")
    return judge(measured, AllOf(*limits), fails=f"{fails}, and {divided}")


def _kept(trajectories, size: str, relative: bool) -> tuple[dict[str, float], str]:
    """Return the largest drift of each case, early and to the end, and until when it is small."""
    measured, until = {}, {}
    for ds in trajectories:
        case, off = str(ds.attrs["case"]), drift(ds["energy"])
        off = off / abs(float(ds["energy"][0])) if relative else off
        measured |= {case: off.max(), f"{case}_early": off[ds["tau"].values <= EARLY].max()}
        until[case] = float(first_above(ds["tau"], off, ORDER.value * STATED_DRIFT[size]))
    if all(map(np.isinf, until.values())):
        return measured, "in every case"
    said = (
        f"in {case} to {'the end' if np.isinf(time) else f'tau = {time:.3g}'}"
        for case, time in until.items()
    )
    return measured, ", ".join(said)


def of_high_order(names: tuple[str, ...]) -> Control:
    fed = dict(zip(names, by("dop853", names), strict=True))
    return Control("runs of a solver of high order at tight tolerances", fed, confirms=True)


@claim(
    "Section 5",
    "H is conserved to the order of 1e-6 for the smaller initial conditions.",
    SMALL,
    controls=(of_high_order(SMALL),),
)
def energy_small(*trajectories) -> Finding:
    return drifts(trajectories, "small")


@claim(
    "Section 5",
    "H is conserved to the order of 1e-4 for the larger initial conditions.",
    LARGE,
    controls=(
        of_high_order(LARGE),
        Control(
            "a run of the second solver, whose scheme does not conserve H",
            {"fig3_large": "fig3_large.crank_nicolson"},
        ),
    ),
)
def energy_large(*trajectories) -> Finding:
    return drifts(trajectories, "large")
