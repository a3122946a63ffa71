"""The page on which a reader runs the cases of Figs 2 to 4, and compares the bits with these runs.

A mark is a hash of all that a run keeps at one output time, as `live.js` makes it of its own run:
so the page tells at which time a bit is wrong.
"""

import base64
import hashlib
import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr
from markupsafe import Markup

from pendula.datasets import complete_or_absent
from pendula.datasets.netcdf import read
from pendula.integrators import FAULTS
from pendula.measures.difference import VISIBLE
from pendula.problem import read_initial
from pendula.simulation.solvers import SOLVERS
from pendula.simulation.webassembly import webassembly

from .page import HERE, render
from .words import case_of

OFFSET, PRIME = np.uint32(2166136261), np.uint32(16777619)
"""Of the hash FNV-1a with 32 bits (Fowler, Noll and Vo), which takes words here, not bytes. Any
change of one word changes it."""


def write_live(runs: list[str], trust: str, lines: str, html: str) -> None:
    """Write the page `html`; the names of `runs` are <case>.<solver>.nc."""
    by_case = {}
    for path in map(Path, runs):
        case, solver, _ = path.name.split(".")
        by_case.setdefault(case, {})[solver] = read(path)
    with complete_or_absent(html) as partial:
        Path(partial).write_text(live_page(by_case, read(trust), read(lines)), encoding="utf-8")


def live_page(runs: Mapping[str, Mapping[str, xr.Dataset]], trust, lines) -> str:
    """Return the page; `runs` has the trajectories of each case by each solver that the page has.

    `trust` is the dataset checks/trust, `lines` is certified/lines. A case with data beside the
    central pair is left out, since the page cannot set them.
    """
    solvers = {solver: run for by_solver in runs.values() for solver, run in by_solver.items()}
    data = {
        "solvers": {solver: _solver(solver, run.attrs) for solver, run in solvers.items()},
        "cases": [
            _case(name, by_solver, trust.sel(case=name, level="visible"), lines.sel(case=name))
            for name, by_solver in runs.items()
            if set(_initial(next(iter(by_solver.values())))) == {0}
        ],
        "faults": FAULTS,
        "visible": VISIBLE,
        "hash": {"offset": int(OFFSET), "prime": int(PRIME)},
    }
    style, script = ((HERE / f"live.{kind}").read_text(encoding="utf-8") for kind in ("css", "js"))
    return render(
        "live.html.j2",
        data=Markup(json.dumps(data, ensure_ascii=False)),
        live_style=Markup(style),
        live_script=Markup(script),
        style_hash=_digest(style),
        script_hash=_digest(script),
    )


def marks(run: xr.Dataset) -> np.ndarray:
    """Return the mark of each output time of a trajectory, (time,)."""
    found = np.full(run.sizes["tau"], OFFSET)
    for values in (*run["linf"].values, *run["l2"].values, run["energy"].values):
        for words in np.ascontiguousarray(values).view("<u4").reshape(-1, 2).T:
            found = (found ^ words) * PRIME
    every = int(run.attrs["snapshot_every"])
    for words in run["modulus"].values.astype("<f4").view("<u4").reshape(-1, run.sizes["snapshot"]):
        found[::every] = (found[::every] ^ words) * PRIME
    return found


def _initial(run: xr.Dataset) -> dict:
    return read_initial(run.attrs["initial"])


def _solver(name: str, about: Mapping[str, Any]) -> dict[str, Any]:
    controls = [float(about[f"solver_{control}"]) for control in SOLVERS[name].controls]
    return {"code": _text(webassembly(name)), "controls": controls, "work": SOLVERS[name].work}


def _case(name: str, by_solver: Mapping[str, xr.Dataset], trust, lines) -> dict[str, Any]:
    """Return what the page holds of a case; a time of `None` is not known."""
    solver, run = next(iter(by_solver.items()))
    (a, b), about = _initial(run)[0], run.attrs
    settings = {key: float(about[key]) for key in ("omega", "gamma", "epsilon", "end_time")}
    settings |= {"half_width": int(about["half_width"]), "boundary": str(about["boundary"])}
    settings |= {"a_re": a.real, "a_im": a.imag, "b_re": b.real, "b_im": b.imag, "solver": solver}
    horizon = np.minimum(trust["horizon"], trust["known_until"]).fillna(0.0)
    return {
        "title": f"Fig {name.removeprefix('fig')[0]}: {case_of(trust)}",
        "settings": settings,
        "output_step": float(about["output_step"]),
        "every": int(about["snapshot_every"]),
        "marks": {one: _text(marks(data).tobytes()) for one, data in by_solver.items()},
        "horizon": {one: float(horizon.sel(solver=one)) or None for one in by_solver},
        "contained": float(lines["contained_until"].min(skipna=False).fillna(0.0)) or None,
    }


def _text(content: bytes) -> str:
    return base64.b64encode(content).decode()


def _digest(text: str) -> str:
    """Return the hash by which a Content-Security-Policy allows a style or a script."""
    return _text(hashlib.sha256(text.encode()).digest())
