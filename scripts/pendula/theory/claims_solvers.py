"""Deciding functions for what Section 5 says of the solvers: energy and agreement."""

import numpy as np

from .readings import CHANGE, largest, powers
from .verdicts import Finding, UndecidableError, judge

# ASSUME: "up to the order of 10^-k" allows up to twice that number, as in the table of solvers.
ORDER = 2.0
# ASSUME: two curves part for the eye at one per cent of full scale.
VISIBLE = 0.01


def drift(trajectory) -> float:
    """Return the largest |H - H(0)| of a trajectory."""
    energy = trajectory["energy"].values
    return float(np.abs(energy - energy[0]).max())


def energy_kept(order: float, trajectories) -> Finding:
    """Return the finding of an energy claim over the cases it names."""
    measured = {str(ds.attrs["case"]): drift(ds) for ds in trajectories}
    failing = [name for name, value in measured.items() if value > ORDER * order]
    fails = f"not for {', '.join(failing)}, by a solver whose tolerances the paper does not give"
    return judge(measured, f"|H - H(0)| <= {ORDER * order:.0e}", not failing, fails=fails)


def energy_small(*trajectories) -> Finding:
    """H is kept to the order of 1e-6 for the smaller data."""
    return energy_kept(1e-6, trajectories)


def energy_large(*trajectories) -> Finding:
    """H is kept to the order of 1e-4 for the larger data."""
    return energy_kept(1e-4, trajectories)


def parting_time(one, other, share: float = VISIBLE) -> float:
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


def solvers_agree(*trajectories) -> Finding:
    """The second solver gave no significant differences: first all by one, then by the other."""
    half = len(trajectories) // 2
    pairs = list(zip(trajectories[:half], trajectories[half:], strict=True))
    parting = {str(a.attrs["case"]): parting_time(a, b) for a, b in pairs}
    apart = {name: time for name, time in parting.items() if np.isfinite(time)}
    difference = max(late_difference(a, b) for a, b in pairs)
    measured = {f"parting_{name}": time for name, time in parting.items()}
    measured["largest_late_difference"] = difference
    caveat = ""
    if apart:
        first = min(apart.values())
        caveat = f"{', '.join(apart)} part by 1 % from tau = {first:.1f} on; their means agree"
    return judge(measured, "mean norms of the second half within 25 %", difference < CHANGE, caveat)


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
