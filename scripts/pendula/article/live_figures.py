"""Interactive figures of the article's page: Figs 2 to 4 with their datasets, and maps of fates."""

import base64
import json
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr
from jinja2 import Environment, FileSystemLoader
from latticode.datasets.netcdf import read
from replication.article.page import LiveParts
from replication.results import Results
from replication.words import number, percent

from pendula.live.write import THIS_FOLDER as LIVE
from pendula.live.write import data_of, worker_text
from pendula.studies.breathers.figures import LOOKS

from .values import LONG_STUDIES

THIS_FOLDER = Path(__file__).parent
OF_LIVE, OF_ARTICLE = ("runs.js", "panels.js"), ("figures.js", "maps.js")
FIGURES = {2: "fig2", 3: "fig3", 4: "fig4"}
"""Prefix of the cases that run below a figure of the article, by the number of the figure."""
FATES = "figure-8"
BREATHERS = next(name for name in LONG_STUDIES if name.endswith("breathers"))
STEP = 0.1
"""Time in tau between two points of a curve that is only displayed."""
FULL_SCALE = np.iinfo(np.uint16).max
NORMS = ("linf", "l2")
BLOCK = '<script type="{}" id="{}">{}</script>'
"""Data of the page for its script: type, id and content."""
IN_A_BYTE = 4
"""Number of fates in a byte, of two bits each."""


def gather_live_parts(results: Results, live: str, references: list[str]) -> LiveParts:
    """Return the interactive parts of the article, with solver and cases of the page `live`.

    `references` are the paths of these cases' trajectories in multiprecision.
    """
    page = Path(live).read_text(encoding="utf-8")
    data = data_of(page)
    cases = json.loads(data)["cases"]
    by_case = {Path(path).stem: read(path) for path in references}
    members = results["checks/members"]
    layers: dict[str, Any] = {
        case["name"]: layers_of(by_case[case["name"]], members.sel(case=case["name"]))
        for case in cases
    }
    layers["end_time"] = max(case["settings"]["end_time"] for case in cases)
    fates = fates_of(results[BREATHERS])
    blocks = {"data": data, "layers": json.dumps(layers), "fates": json.dumps(fates)}
    scripts = [*(LIVE / name for name in OF_LIVE), *(THIS_FOLDER / name for name in OF_ARTICLE)]
    return LiveParts(
        below_figures=_below_figures(cases, fates, float(members.attrs["band_share"])),
        data="".join(BLOCK.format("application/json", *block) for block in blocks.items())
        + BLOCK.format("text/plain", "worker", worker_text()),
        script="".join(map(_read, scripts)),
        style=_read(THIS_FOLDER / "live_figures.css"),
    )


def layers_of(reference: xr.Dataset, members: xr.Dataset) -> dict[str, Any]:
    """Return the curves of a case that are only displayed: its reference and its ensemble."""
    end_time = float(members["tau"][-1])
    stride = round(STEP / float(reference["tau"][1] - reference["tau"][0]))
    curves = reference.sel(tau=slice(0, end_time)).isel(tau=slice(None, None, stride))
    return {
        "reference": {norm: [_curve(values) for values in curves[norm].values] for norm in NORMS},
        "ensemble": {
            norm: [
                [_curve(values) for values in quantiles]
                for quantiles in members[norm].transpose("component", "quantile", "tau").values
            ]
            for norm in NORMS
        },
    }


def fates_of(study: xr.Dataset) -> dict[str, Any]:
    """Return the maps of fates: four cells in a byte, ordered by A_0 and then by B_0."""
    amplitudes = study["a0"].values
    return {
        "points": len(amplitudes),
        "start": float(np.fabs(amplitudes - 1.0).argmin()),
        "amplitudes": [round(float(value), 9) for value in amplitudes],
        "end_time": float(study.attrs["end_time"]),
        "colours": list(LOOKS.values()),
        "maps": [
            {"omega": float(omega), "cells": _packed(study["fate"].sel(omega=omega).values)}
            for omega in study["omega"].values
        ],
    }


def _packed(fates: np.ndarray) -> str:
    cells = np.zeros(-(-fates.size // IN_A_BYTE) * IN_A_BYTE, np.uint8)
    cells[: fates.size] = fates.ravel()
    shifted = cells.reshape(-1, IN_A_BYTE) << (2 * np.arange(IN_A_BYTE, dtype=np.uint8))
    return base64.b64encode(np.bitwise_or.reduce(shifted, axis=1).tobytes()).decode()


def _curve(values: np.ndarray) -> dict[str, Any]:
    """Return a curve with 16 bits per number, enough for a screen."""
    largest = float(values.max())
    scaled = np.rint(FULL_SCALE * values / (largest or 1.0)).astype("<u2")
    return {"largest": largest, "values": base64.b64encode(scaled.tobytes()).decode()}


def _below_figures(cases: list[dict], fates: dict[str, Any], share: float) -> dict[str, str]:
    """Return the controls below each figure of the article, by the id of the figure."""
    environment = Environment(
        loader=FileSystemLoader(THIS_FOLDER), autoescape=True, trim_blocks=True, lstrip_blocks=True
    )
    largest = f"{max(fates['amplitudes']):.0f}"
    environment.globals.update(share=percent(share), largest=largest, fates=LOOKS)
    template = environment.get_template("live_figures.html.j2").module
    controls = {
        f"figure-{figure}": template.run(
            figure, [case for case in cases if case["name"].startswith(name)]
        )
        for figure, name in FIGURES.items()
    }
    controls[FATES] = template.maps([number(entry["omega"]) for entry in fates["maps"]])
    return {name: str(text) for name, text in controls.items()}


def _read(file: Path) -> str:
    return file.read_text(encoding="utf-8")
