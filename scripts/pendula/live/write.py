"""The page on which a reader runs the cases of Figs 2 to 4, and compares the bits with ours.

A mark is a hash of all values of a run at an output time. `runs.js` computes the marks of its own
run, and the page reports the first time at which a bit differs.
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
from latticode.equations.initial_values import read_initial
from latticode.integrators import FAULTS
from latticode.kernels.webassembly import loader
from latticode.measures.difference import VISIBLE
from markupsafe import Markup
from replication.report import page

from pendula.case_words import case_of

from .experiments import EXPERIMENTS
from .kernel import ODE45, compile_for_any_processor

THIS_FOLDER = Path(__file__).parent
SCRIPTS = "runs.js", "panels.js", "pictures.js", "words.js", "chart.js", "live.js"
DATA = '<script type="application/json" id="data"'
"""The opening tag of the element with the page's data."""
LEVELS = 255
"""The integer for the largest growth rate on the page."""
OFFSET, PRIME = np.uint32(2166136261), np.uint32(16777619)
"""Constants of the 32-bit hash FNV-1a (Fowler, Noll and Vo), applied to words instead of bytes.
Any change of one word changes the hash."""


def write_live(runs: list[str], trust: str, chart: str, html: str) -> None:
    """Write the page `html` on the trajectories `runs` by ode45.

    `trust` and `chart` are the datasets checks/trust and checks/chart. A case with initial data
    outside the central pair is left out, because the page cannot set them.
    """
    by_case = {Path(path).name.partition(".")[0]: read(path) for path in runs}
    trusted = read(trust).sel(solver="ode45")
    data = {
        "solver": _describe_solver(next(iter(by_case.values())).attrs),
        "cases": [
            _describe_case(name, run, trusted.sel(case=name))
            for name, run in by_case.items()
            if set(read_initial(run.attrs["initial"])) == {0}
        ],
        "chart": _describe_chart(read(chart)),
        "faults": FAULTS,
        "visible": VISIBLE,
        "hash": {"offset": int(OFFSET), "prime": int(PRIME)},
    }
    style = _read(page.FOLDER / "style.css") + _read(THIS_FOLDER / "live.css")
    script = "".join(_read(THIS_FOLDER / name) for name in SCRIPTS)
    text = page.render(
        "live.html.j2",
        THIS_FOLDER,
        data=Markup(json.dumps(data, ensure_ascii=False)),
        experiments=EXPERIMENTS,
        chart=data["chart"],
        style=Markup(style),
        worker=Markup(worker_text()),
        script=Markup(script),
        style_hash=page.digest(style),
        script_hash=page.digest(script),
    )
    with complete_or_absent(html) as partial:
        Path(partial).write_text(text, encoding="utf-8")


def data_of(page: str) -> str:
    """Return the data of the page in JSON: its solver, its cases and their marks."""
    return page.partition(f"{DATA}>")[2].partition("</script>")[0]


def worker_text() -> str:
    """Return the script of the worker that runs the solver."""
    return loader() + _read(THIS_FOLDER / "solver.js")


def hash_outputs(run: xr.Dataset) -> np.ndarray:
    """Return the mark of each output time of a trajectory, (time,)."""
    hashes = np.full(run.sizes["tau"], OFFSET)
    retained = [(1, values) for values in (*run["linf"], *run["l2"], run["energy"])]
    if every := int(run.attrs["snapshot_every"]):
        half = run["modulus"].sel(site=slice(0, None))  # enough, since the run is even in n
        retained += [(every, values) for component in half for values in component]
    for step, values in retained:
        for words in np.ascontiguousarray(values).view("<u4").reshape(values.size, -1).T:
            hashes[::step] = (hashes[::step] ^ words) * PRIME
    return hashes


def _describe_solver(attributes: Mapping[str, Any]) -> dict[str, Any]:
    """Return the data of the page's solver, with the controls in a trajectory's attributes."""
    controls = {name: float(attributes[f"solver_{name}"]) for name in ODE45.controls}
    return {
        "code": _encode(compile_for_any_processor()),
        "controls": [*controls.values()],
        "named": yaml.safe_dump({"name": "ode45", **controls}, default_flow_style=True).strip(),
        "work": ODE45.work_arrays(sites=1, in_tiles=False),
    }


def _describe_case(name: str, run: xr.Dataset, trust: xr.Dataset) -> dict[str, Any]:
    """Return the data of a case on the page; `None` is an unknown time."""
    attributes = run.attrs
    a, b = read_initial(attributes["initial"])[0]
    settings = {key: float(attributes[key]) for key in ("omega", "gamma", "epsilon", "end_time")}
    settings |= {
        "half_width": int(attributes["half_width"]),
        "boundary": str(attributes["boundary"]),
    }
    settings |= {"a_re": a.real, "a_im": a.imag, "b_re": b.real, "b_im": b.imag}
    known = float(np.minimum(trust["horizon"], trust["known_until"]).fillna(0.0))
    return {
        "name": name,
        "title": f"Fig {name.removeprefix('fig')[0]}: {case_of(trust)}",
        "settings": settings,
        "output_step": float(attributes["output_step"]),
        "every": int(attributes["snapshot_every"]),
        "marks": _encode(hash_outputs(run).tobytes()),
        "horizon": known or None,
    }


def _describe_chart(chart: xr.Dataset) -> dict[str, Any]:
    """Return the growth rates of the chain at rest, by Omega and then by gamma, in 256 levels."""
    rates = chart["measured"].transpose("omega", "gamma").values.clip(min=0)
    levels = np.rint(rates / rates.max() * LEVELS).astype(int)
    axes = {name: [float(value) for value in chart[name].values] for name in ("omega", "gamma")}
    return axes | {"rates": levels.ravel().tolist()}


def _read(file: Path) -> str:
    return file.read_text(encoding="utf-8")


def _encode(content: bytes) -> str:
    return base64.b64encode(content).decode()
