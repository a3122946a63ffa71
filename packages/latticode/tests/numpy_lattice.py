"""The text of a model, run on plain NumPy arrays: what is computed from it is not the library's.

The arrays go on beyond the ends of the chain, where fields are what the ends make of them. A shift
moves such an array, and what it does not know is NaN.
"""

from types import SimpleNamespace

import latticode
import numpy as np
from scipy.integrate import solve_ivp

MARGIN = 8
"""Sites beyond each end: more than an equation may look far."""


class Sites(np.ndarray):
    """Numbers at the sites of a chain and at MARGIN more beyond each end."""

    @property
    def right(self):
        return shift(self, 1)

    @property
    def left(self):
        return shift(self, -1)


def shift(w, m):
    moved = np.full_like(w, np.nan)
    if m >= 0:
        moved[: w.size - m] = w[m:]
    else:
        moved[-m:] = w[:m]
    return moved


def lap(w):
    return w.right - 2 * w + w.left


def couple(matrix, w):
    """A matrix times the sites of the chain; beyond its ends nothing is known."""
    sums = np.full_like(w, np.nan)
    sums[MARGIN:-MARGIN] = matrix @ np.asarray(w)[MARGIN:-MARGIN]
    return sums


NAMES = {
    "couple": couple,
    "shift": shift,
    "lap": lap,
    "conj": np.conj,
    "abs2": lambda w: w.real**2 + w.imag**2,
    **{name: getattr(np, name) for name in ("exp", "log", "sqrt", "sin", "cos")},
}


def beyond_ends(values, boundary, of_field=True):
    """Return the values of a field (site,), or of a parameter, as Sites."""
    n = np.arange(-MARGIN, values.size + MARGIN)
    turns, place = n // values.size, n % values.size
    mirrored = np.where(turns % 2 == 0, place, values.size - 1 - place)
    match boundary:
        case "periodic":
            extended = values[place]
        case "antiperiodic":
            extended = values[place] * ((-1.0) ** turns if of_field else 1.0)
        case "free" if of_field:
            extended = values[mirrored]
        case "dirichlet" if of_field:
            extended = np.where(turns == 0, values[place], 0.0)
        case _:
            extended = values[np.clip(n, 0, values.size - 1)]
    return extended.view(Sites)


def run(text, names=NAMES):
    """Return the names that the text of a model makes, where its functions are these."""
    namespace = dict(names)
    exec(text, namespace)
    return namespace


def traced(text):
    """Return the same for the library, whose functions record what is done."""
    return run(text, {name: getattr(latticode, name) for name in NAMES})


def slope_of(text, parameters, boundary, fields, form):
    """Return dy/dt(t, y) of a model on flat states; `form` names its function.

    They have the fields one after the other, and behind those of `d2_dt2` all velocities.
    """
    namespace, second_order = run(text), form == "d2_dt2"
    equations = namespace[form]
    takes_velocities = equations.__code__.co_argcount > 1 + fields

    def everywhere(value, field):
        if np.ndim(value) == 2:
            return value
        return beyond_ends(np.broadcast_to(value, field.shape), boundary, of_field=False)

    def slope(t, y):
        states = y.reshape(fields * (1 + second_order), -1)
        rows = [beyond_ends(state, boundary) for state in states]
        numbers = {
            name: everywhere(value, states[0]) for name, value in {**parameters, "t": t}.items()
        }
        arguments = rows if takes_velocities else rows[:fields]
        returned = equations(SimpleNamespace(**numbers), *arguments)
        returned = returned if isinstance(returned, tuple) else (returned,)
        inside = [
            np.broadcast_to(rate, rows[0].shape)[MARGIN:-MARGIN].view(np.ndarray)
            for rate in returned
        ]
        if second_order:
            return np.concatenate([y[y.size // 2 :], *inside])
        return np.concatenate(inside) * {"i_dt": -1j, "dt": 1.0}[form]

    return slope


def solution(slope, start, end_time, tolerance=1e-12):
    """Return the state at the end by SciPy's DOP853; None where the solution leaves order one."""
    with np.errstate(all="ignore"):
        run = solve_ivp(
            slope, (0.0, end_time), start, method="DOP853", rtol=tolerance, atol=tolerance
        )
    return run.y[:, -1] if run.success and np.abs(run.y).max() < 10.0 else None
