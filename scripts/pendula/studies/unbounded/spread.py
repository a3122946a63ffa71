"""A long run on the active window: in pieces, with checkpoints, reduced to series in time.

Each piece starts the solver anew from the state alone, so that a run continued from a checkpoint
has the bits of one that was never interrupted (the new first step costs half a per cent).
"""

from pathlib import Path
from typing import NamedTuple

import numpy as np

from pendula.problem import Problem

from . import checkpoint
from .window import Piece, advance, open_window, powers, widen

LEVELS = np.array([1e-6, 1e-2, 1.0, 4.0])
"""Powers |A|^2 + |B|^2 at which the front is found: its leading edge, and where it breaks."""

PIECE = 2.0
"""Units of tau between two looks at the window's end."""


class Spread(NamedTuple):
    """Series of a run: of the pair (A, B), at every output, or at the end of every piece."""

    tau: np.ndarray  # (time,)
    l2: np.ndarray  # (time,)
    linf: np.ndarray  # (time,)
    energy: np.ndarray  # (time,)
    piece_tau: np.ndarray  # (piece,)
    front: np.ndarray  # (piece, level): outermost site above each of LEVELS, -1 if none
    width: np.ndarray  # (piece,): W, the last site integrated
    evaluations: np.ndarray  # (piece,): right-hand sides taken
    state: np.ndarray  # (row, 1 + site) at the end


SERIES = Spread._fields[:-1]


def spread(
    problem: Problem, rest: float, keep_at: str | Path | None = None, keep_every: int = 50
) -> Spread:
    """Return the run of `problem`, continued from the checkpoint `keep_at` if there is one.

    Its data are even in n, its half-width is None where the chain has no ends; `rest` is what
    counts as at rest ahead of the front (see `window`). A checkpoint is written after each
    `keep_every` pieces, and left.
    """
    description = checkpoint.describe(problem, rest)
    outputs = round(PIECE / problem.output_step)
    count = round(problem.end_time / PIECE)
    kept = checkpoint.recall(keep_at, description) if keep_at else None
    series, state = _start(problem) if kept is None else _continue(kept)
    for piece in range(len(series["piece_tau"]), count):
        state = widen(state, problem.half_width, rest)
        times = problem.output_step * np.arange(piece * outputs, (piece + 1) * outputs + 1)
        done = advance(problem.constants, state, times, problem.solver)
        _add(series, times, done, first=piece == 0)
        if keep_at and (piece + 1) % keep_every == 0:
            checkpoint.keep(keep_at, description, {**_joined(series), "state": state})
    return Spread(**_joined(series), state=state)


def find_front(state: np.ndarray) -> np.ndarray:
    """Return the outermost site whose power is above each of LEVELS, -1 where there is none."""
    power = powers(state)
    return np.array([np.flatnonzero(power > level).max(initial=-1) for level in LEVELS])


def _start(problem: Problem) -> tuple[dict, np.ndarray]:
    return {name: [] for name in SERIES}, open_window(problem.initial, problem.half_width)


def _continue(kept: dict) -> tuple[dict, np.ndarray]:
    return {name: list(kept[name]) for name in SERIES}, kept["state"]


def _add(series: dict, times: np.ndarray, done: Piece, first: bool) -> None:
    """Append a piece; its first output is the last of the piece before."""
    new = slice(0 if first else 1, None)
    copies = 3 - len(done.record.l2)  # A = B: the one component counts twice
    series["tau"].extend(times[new])
    series["l2"].extend(np.sqrt(copies * (done.record.l2[:, new] ** 2).sum(axis=0)))
    series["linf"].extend(done.record.linf[:, new].max(axis=0))
    series["energy"].extend(done.record.energy[new])
    series["piece_tau"].append(times[-1])
    series["front"].append(find_front(done.state))
    series["width"].append(done.state.shape[1] - 3)
    series["evaluations"].append(done.outcome.evaluations)


def _joined(series: dict) -> dict[str, np.ndarray]:
    return {name: np.array(values) for name, values in series.items()}
