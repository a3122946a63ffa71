"""The page on which a reader runs the cases of Figs 2 to 4, and compares the bits with these runs.

A mark is a hash of all that a run keeps at one output time. `live.js` makes the same of its own run
and reports the first time at which a bit differs.
"""

import base64
import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr
import yaml
from latticode.datasets import complete_or_absent
from latticode.datasets.netcdf import read
from latticode.equations.ends import DIRICHLET, MIRROR
from latticode.integrators import FAULTS
from latticode.kernels.webassembly import loader, webassembly
from latticode.measures.difference import VISIBLE
from latticode.simulation.integration import Solver
from latticode.simulation.observables import blank_record
from latticode.simulation.problem import read_initial
from markupsafe import Markup

from pendula.models.amplitudes import Chain
from pendula.models.solvers import SOLVERS
from pendula.report import page
from pendula.report.words import case_of

HERE = Path(__file__).parent
OFFSET, PRIME = np.uint32(2166136261), np.uint32(16777619)
"""Of the hash FNV-1a with 32 bits (Fowler, Noll and Vo), which takes words here, not bytes. Any
change of one word changes it."""


def write_live(runs: list[str], trust: str, html: str) -> None:
    """Write the page `html` on the trajectories `runs`, all by one solver.

    `trust` is the dataset checks/trust. A case with initial data beside the central pair is left
    out, since the page cannot set them.
    """
    by_case = {Path(path).name.partition(".")[0]: read(path) for path in runs}
    about = next(iter(by_case.values())).attrs
    trusted = read(trust).sel(solver=about["solver"])
    data = {
        "solver": _solver(about),
        "cases": [
            _case(name, run, trusted.sel(case=name))
            for name, run in by_case.items()
            if set(read_initial(run.attrs["initial"])) == {0}
        ],
        "faults": FAULTS,
        "visible": VISIBLE,
        "hash": {"offset": int(OFFSET), "prime": int(PRIME)},
    }
    files = (page.HERE / "style.css", HERE / "live.css", HERE / "live.js")
    common, own, drawing = (file.read_text(encoding="utf-8") for file in files)
    script = f"{loader()}\n{drawing}"
    text = page.render(
        "live.html.j2",
        HERE,
        data=Markup(json.dumps(data, ensure_ascii=False)),
        style=Markup(common + own),
        script=Markup(script),
        style_hash=page.digest(common + own),
        script_hash=page.digest(script),
    )
    with complete_or_absent(html) as partial:
        Path(partial).write_text(text, encoding="utf-8")


def marks(run: xr.Dataset) -> np.ndarray:
    """Return the mark of each output time of a trajectory, (time,)."""
    found = np.full(run.sizes["tau"], OFFSET)
    kept = [(1, values) for values in (*run["linf"], *run["l2"], run["energy"])]
    if every := int(run.attrs["snapshot_every"]):
        half = run["modulus"].sel(site=slice(0, None))  # the data are even, and so is the run
        kept += [(every, values) for component in half for values in component]
    for step, values in kept:
        for words in np.ascontiguousarray(values).view("<u4").reshape(values.size, -1).T:
            found[::step] = (found[::step] ^ words) * PRIME
    return found


def _solver(about: Mapping[str, Any]) -> dict[str, Any]:
    """Return what the page holds of the solver that the attributes of a trajectory name."""
    name, controls = str(about["solver"]), SOLVERS[str(about["solver"])].controls
    solver = {"name": name, **{one: float(about[f"solver_{one}"]) for one in controls}}
    return {
        "code": _text(_code_of(SOLVERS[name])),
        "controls": [solver[one] for one in controls],
        "named": yaml.safe_dump(solver, default_flow_style=True).strip(),
        "work": SOLVERS[name].work,
    }


def _code_of(solver: Solver) -> bytes:
    """Return the WebAssembly of a solver of (4) on half a chain; its sizes are arguments of it."""
    y = np.zeros((4, 4))
    chain = Chain(1.0, 1.0, 0.0, MIRROR, DIRICHLET)
    controls, record = (0.0,) * len(solver.controls), blank_record(2, 2, 2, 1)
    work, stop = solver.room_for(None, y), np.zeros(1, np.bool_)
    return webassembly(solver.run, chain, y, np.zeros(2), controls, work, record, stop)


def _case(name: str, run: xr.Dataset, trust: xr.Dataset) -> dict[str, Any]:
    """Return what the page holds of a case; a time of `None` is not known."""
    about = run.attrs
    a, b = read_initial(about["initial"])[0]
    settings = {key: float(about[key]) for key in ("omega", "gamma", "epsilon", "end_time")}
    settings |= {"half_width": int(about["half_width"]), "boundary": str(about["boundary"])}
    settings |= {"a_re": a.real, "a_im": a.imag, "b_re": b.real, "b_im": b.imag}
    known = float(np.minimum(trust["horizon"], trust["known_until"]).fillna(0.0))
    return {
        "name": name,
        "title": f"Fig {name.removeprefix('fig')[0]}: {case_of(trust)}",
        "settings": settings,
        "output_step": float(about["output_step"]),
        "every": int(about["snapshot_every"]),
        "marks": _text(marks(run).tobytes()),
        "horizon": known or None,
    }


def _text(content: bytes) -> str:
    return base64.b64encode(content).decode()
