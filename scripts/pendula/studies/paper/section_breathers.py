"""What the study of breathers changes for each figure of the paper, in numbers."""

import json
from typing import Any

from pendula.configuration.paper import MAPS
from pendula.report.results import Results
from pendula.report.words import number, percent

SENSITIVITY, PERIODIC = "breathers/sensitivity", "breathers/periodic"
FATES = "breathers/fates"


def beside_breathers(results: Results, which: int) -> dict[str, dict[str, Any]]:
    """Return what data on one pair do at the detunings of a figure, as its `breathers`.

    A part that says nothing of the figure is None; all is empty where a run is not of the paper's
    data.
    """
    names = (SENSITIVITY, PERIODIC, FATES)
    if not all(name in results for name in names) or results.apart(*names, on=(MAPS,)):
        return {"breathers": {}}
    below, above, within = "fig3_small", "fig2_large", "fig4_large"
    parts = {
        2: {"fates": (_fates, above)},
        3: {"small": (_small, below), "knife": (_knife, SENSITIVITY)},
        4: {"fates": (_fates, within)},
        5: {"small": (_small, below), "fates": (_fates, "fig4_small")},
        6: {"fates": (_fates, above), "knife": (_knife, SENSITIVITY)},
    }[which]
    found = {
        name: part(results, of)
        for name, (part, of) in parts.items()
        if of == SENSITIVITY or not results.apart(f"trajectories/{of}")
    }
    return {"breathers": {"small": None, "fates": None, "knife": None} | found}


def _knife(results: Results, source: str) -> dict[str, Any]:
    """Return which of almost equal data spread: by the size of a change, and by a scan."""
    data = results[source].sortby("size")
    near, far = data.isel(size=0), data.isel(size=-1)
    scanned = data["initial"].values
    return {
        "omega": results.quote(SENSITIVITY, float(data.attrs["omega"])),
        "near": results.say(SENSITIVITY, percent(float(near["share"]))),
        "near_size": results.quote(SENSITIVITY, float(near["size"])),
        "far": results.say(SENSITIVITY, percent(float(far["share"]))),
        "far_size": results.quote(SENSITIVITY, float(far["size"])),
        "scanned": results.quote(SENSITIVITY, scanned.size),
        "range": results.say(
            SENSITIVITY, f"{number(float(scanned.min()))} to {number(float(scanned.max()))}"
        ),
        "spread": results.quote(SENSITIVITY, int(data["spread"].sum())),
    }


def _fates(results: Results, case: str) -> dict[str, Any] | None:
    """Return the shares of data on one pair that spread, and that stay, at a case's detuning."""
    about, data = results[f"trajectories/{case}"].attrs, results[FATES]
    omega = float(about["omega"])
    if omega not in data["omega"].values:
        return None
    area = data["area"].sel(omega=omega, plane="amplitudes")
    shares = {kind: percent(float(area.sel(fate_name=kind))) for kind in ("stays", "spreads")}
    return {
        "omega": results.quote(FATES, omega),
        "own": _own_fate(data, case, json.loads(about["initial"])),
        "points": results.quote(FATES, data["fate"].sel(omega=omega).size, 6),
        "stays": results.say(FATES, shares["stays"]),
        "spreads": results.say(FATES, shares["spreads"]),
    }


def _own_fate(data, case: str, initial: dict) -> str:
    """Return what became of the data of a case; an empty text where these are other data."""
    if case not in data["case"].values:
        return ""
    one = data.sel(case=case)
    if initial != {"0": [float(one["case_a0"]), float(one["case_b0"])]}:
        return ""
    return str(data["fate_name"].values[int(one["case_fate"])])


def _small(results: Results, case: str) -> dict[str, Any] | None:
    """Return P of small data beside the least P of a breather at their detuning, if it is less."""
    run, periodic = results[f"trajectories/{case}"], results[PERIODIC]
    omega = float(run.attrs["omega"])
    if omega not in periodic["omega"].values:
        return None
    least = float(periodic["least_power"].sel(omega=omega).min())
    power = float((run["l2"].isel(tau=0) ** 2).sum())
    if not power < least:
        return None
    return {
        "omega": results.quote(PERIODIC, omega),
        "least": results.quote(PERIODIC, least),
        "data": results.quote(f"trajectories/{case}", power),
    }
