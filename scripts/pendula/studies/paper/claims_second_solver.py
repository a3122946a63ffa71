"""Section 5, end: the figures by the paper's second solver."""

import numpy as np

from pendula.ledger.readings import CHANGE, largest, powers
from pendula.ledger.row import LARGE, SMALL, SWEEPS, by_second, claim
from pendula.ledger.verdicts import Finding, UndecidableError, judge

# ASSUME: two curves part for the eye at one per cent of full scale.
VISIBLE = 0.01


def divergence_time_of(one, other, share: float = VISIBLE) -> float:
    """Return when the l2 or l-infinity norms differ by `share` of full scale; inf if never."""
    apart = np.zeros(one.sizes["tau"], bool)
    for name in ("l2", "linf"):
        a, b = one[name].values, other[name].values
        if a.shape != b.shape:
            raise UndecidableError("the two solvers' outputs are not at the same times")
        apart |= (np.abs(a - b) > share * a.max()).any(axis=0)
    return float(one["tau"].values[np.argmax(apart)]) if apart.any() else np.inf


def late_difference(one, other) -> float:
    """Return the relative difference of the mean norms over the second half of the time."""
    half = one["tau"].values >= 0.5 * float(one["tau"][-1])
    l2 = np.mean(np.sqrt(powers(other))[half]) / np.mean(np.sqrt(powers(one))[half])
    linf = np.mean(largest(other)[half]) / np.mean(largest(one)[half])
    return float(max(abs(l2 - 1.0), abs(linf - 1.0)))


@claim(
    "second_solver",
    "Section 5, end",
    "Figs 2 to 4 come out of the second solver without significant differences.",
    (*SMALL, *LARGE, *by_second(*SMALL, *LARGE)),
)
def solvers_agree(*trajectories) -> Finding:
    """The second solver gave no significant differences: first all by one, then by the other."""
    half = len(trajectories) // 2
    pairs = list(zip(trajectories[:half], trajectories[half:], strict=True))
    divergence_time = {str(a.attrs["case"]): divergence_time_of(a, b) for a, b in pairs}
    apart = {name: time for name, time in divergence_time.items() if np.isfinite(time)}
    difference = max(late_difference(a, b) for a, b in pairs)
    measured = {f"divergence_{name}": time for name, time in divergence_time.items()}
    measured["largest_late_difference"] = difference
    caveat = ""
    if apart:
        first = min(apart.values())
        caveat = f"{', '.join(apart)} part by 1 % from tau = {first:.1f} on; their means agree"
    return judge(measured, "mean norms of the second half within 25 %", difference < CHANGE, caveat)


@claim(
    "second_solver_sweeps",
    "Section 5, end",
    "So do Figs 5 and 6.",
    (*SWEEPS, *by_second(*SWEEPS)),
)
def sweeps_agree(*sweeps) -> Finding:
    """The second solver reproduces Figs 5 and 6."""
    half = len(sweeps) // 2
    measured = {}
    for one, other in zip(sweeps[:half], sweeps[half:], strict=True):
        a = one["l2"].sel(quantity="pair", statistic="max").values
        b = other["l2"].sel(quantity="pair", statistic="max").values
        if a.shape != b.shape:
            raise UndecidableError("the two solvers' sweeps differ in their half-widths")
        if len(a) < 6:
            raise UndecidableError("the sweeps have fewer than six half-widths")
        name, difference = str(one.attrs["case"]), np.abs(b / a - 1.0)
        measured[f"largest_{name}"] = difference.max()
        measured[f"median_{name}"] = np.median(difference)
    differ = {name: value for name, value in measured.items() if name.startswith("largest_")}
    visible = [name.removeprefix("largest_") for name in differ if differ[name] > VISIBLE]
    apart = [name.removeprefix("largest_") for name in differ if not differ[name] < CHANGE]
    caveat = f"points of {', '.join(visible)} differ visibly: the motion is chaotic there"
    typical = max((measured[f"median_{name}"] for name in apart), default=0.0)
    fails = f"points of {', '.join(apart)} differ by more, half of them below {100 * typical:.2g} %"
    text = "every point within 25 %"
    return judge(measured, text, not apart, caveat if visible else "", fails)
