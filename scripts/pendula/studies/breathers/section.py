"""The report's part on breathers: families, growth by the drive, sensitivity, and fates."""

from collections.abc import Iterator
from typing import Any

import numpy as np
import xarray as xr

from pendula.ledger.section import Ledger
from pendula.report.page import Picture
from pendula.report.results import Results, Section
from pendula.report.words import number, percent, span, symbols

from .fate_contents import LONGEST, TIMES
from .nearest import HALF_PERIODS, NEAR, WAVES

STEADY, PERIODIC = "breathers/steady", "breathers/periodic"
GROWTH, SENSITIVITY, MAP = "breathers/growth", "breathers/sensitivity", "breathers/fates"


def gather(results: Results, ledger: Ledger) -> dict[str, Any]:
    """Return the families as tables, and what runs show, in words."""
    return {
        "steady_head": ["family", *(f"Ω = {omega:g}" for omega in _omegas(results))],
        "steady": [_steady_row(results, str(name)) for name in results[STEADY]["family"].values],
        "large": results.quote(SENSITIVITY, float(results[SENSITIVITY].attrs["omega"])),
        "all_spread": ledger.holds("detuning_decides"),
        "forbidden": results.quote(STEADY, _forbidden(results)),
        "born": [_birth(results, i) for i in range(results[STEADY].sizes["born_family"])],
        "thresholds": [
            _threshold(results, str(name)) for name in results[STEADY]["stable_family"].values
        ],
        "families": [_family(results, float(omega), str(family))
                     for omega in results[PERIODIC]["omega"].values
                     for family in results[PERIODIC]["family"].values],
        "families_head": ["Ω", "family", "P at the lowest frequency", "least P",
                          "least P within a period", "unstable at"],
        "collisions_head": ["Ω", "family", "λ", "perturbation", "multiplier over half a period",
                            "signatures"],
        "collisions": list(_collisions(results)),
        "edge": results.say(PERIODIC, _span(results[PERIODIC]["highest_wave"].values)),
        "within": _within(results),
        "lower_free": results.say(PERIODIC, _lower_free(results)),
        "frequencies": results.say(PERIODIC, _span(results[PERIODIC]["frequency"].values)),
        "growth": _growth(results),
        "sensitivity": _sensitivity(results),
        "fates": _fates(results),
        "pictures": _pictures(results),
    }  # fmt: skip


def _forbidden(results: Results) -> float:
    """Return the Omega from which on the form of `steady` is definite."""
    about = results[STEADY].attrs
    return 4.0 * float(about["epsilon"]) + 2.0 * float(about["gamma"])


def _omegas(results: Results) -> list[float]:
    return [float(omega) for omega in results[STEADY]["omega"].values]


def _span(values: np.ndarray) -> str:
    ends = number(float(values.min())), number(float(values.max()))
    return ends[0] if ends[0] == ends[1] else " to ".join(ends)


def _steady_row(results: Results, family: str) -> list:
    """Return the rates of growth of a family; "stable" where none is positive."""
    rates = results[STEADY]["growth"].sel(family=family).values
    cells = ["none" if np.isnan(r) else number(float(r)) if r else "stable" for r in rates]
    return [symbols(family), *(results.say(STEADY, cell) for cell in cells)]


def _birth(results: Results, index: int) -> dict[str, Any]:
    one = results[STEADY].isel(born_family=index)
    return {
        "family": str(one["born_family"].item()),
        "omega": results.quote(STEADY, float(one["pitchfork"]), 6),
    }


def _threshold(results: Results, family: str) -> dict[str, Any]:
    below = results[STEADY]["stable_below"].sel(stable_family=family).values
    return {"family": symbols(family), "omega": results.quote(STEADY, float(below[-1]), 4)}


def _family(results: Results, omega: float, family: str) -> list:
    one = results[PERIODIC].sel(omega=omega, family=family)
    power, frequency = one["power"].sum("component", skipna=False).values, one["frequency"].values
    found = np.flatnonzero(np.isfinite(power))
    if not found.size:
        return [number(omega), symbols(family), *["none"] * 4]
    lowest = found[frequency[found].argmin()]
    unstable = frequency[one["growth"].values > 0]
    said = "no frequency" if not unstable.size else f"λ of {_span(unstable)}"
    return [
        number(omega),
        symbols(family),
        results.quote(PERIODIC, float(power[lowest])),
        *(results.quote(PERIODIC, float(least)) for least in one["least_power"].values),
        results.say(PERIODIC, said),
    ]


def _collisions(results: Results) -> Iterator[list]:
    """Yield a row for each collision: where it is, what meets, and with which signatures."""
    data = results[PERIODIC]
    met = data["collision_frequency"].transpose("omega", "family", "frequency", "parity")
    for at in np.argwhere(np.isfinite(met.values)):
        one = data.isel(dict(zip(met.dims, at, strict=True)))
        real, imaginary = one["collision_multiplier"].values
        signs = ("+" if sign > 0 else "−" for sign in one["collision_signature"].values)
        value = (
            number(real, 4) if not imaginary else f"{number(real, 4)} ± {number(imaginary, 4)} i"
        )
        yield [
            number(float(one["omega"])),
            symbols(str(one["family"].item())),
            results.quote(PERIODIC, float(one["collision_frequency"]), 5),
            str(one["parity"].item()),
            results.say(PERIODIC, value),
            results.say(PERIODIC, " and ".join(signs)),
        ]


def _within(results: Results) -> str:
    """Return how fast breathers grow whose frequency is that of a wave, on two chains."""
    data = results[PERIODIC]
    rates = data[["growth", "growth_half"]].where(data["frequency"] <= data["highest_wave"])
    said = [
        f"at λ = {number(float(frequency))} a perturbation of {symbols(str(family))} grows at the"
        f" rate {number(float(one['growth']))}, and on half of the chain at"
        f" {number(float(one['growth_half']))}, per unit of τ"
        for family in data["family"].values
        for frequency in data["frequency"].values
        for one in [rates.sel(family=family, frequency=frequency).max("omega")]
        if np.isfinite(one["growth"])
    ]
    return results.say(PERIODIC, "; ".join(said)) if said else ""


def _lower_free(results: Results) -> str:
    """Return the intervals of frequencies below the waves none of whose multiples meets a band."""
    low, high = (results[PERIODIC][f"free_{end}"].values for end in ("low", "high"))
    ends = sorted(
        {(a, b) for a, b in zip(low.ravel(), high.ravel(), strict=True) if np.isfinite(b)}
    )
    return "; ".join(f"{number(a, 4)} to {number(b, 4)}" for a, b in ends) or "none"


def _growth(results: Results) -> dict[str, Any]:
    growth = results[GROWTH]
    law = float(growth["predicted_gain"].max())
    strong = growth.sel(gamma=growth["gamma"].max())
    passed = float(strong["time"].where(strong["gained"] > law).min())
    return {
        "start": results.quote(GROWTH, growth.attrs["start_frequency"]),
        "drives": results.say(GROWTH, span(growth["gamma"].values, 2)),
        "law": results.quote(GROWTH, law),
        "strongest": results.quote(GROWTH, float(strong["gamma"])),
        "passed": np.isfinite(passed) and results.quote_time(GROWTH, passed),
    }


def _sensitivity(results: Results) -> dict[str, Any]:
    data = results[SENSITIVITY]
    rows = [
        [
            number(float(size)),
            *(
                results.say(SENSITIVITY, percent(float(data[f"share{end}"].sel(size=size))))
                for end in ("", "_low", "_high")
            ),
        ]
        for size in data["size"].values
    ]
    return {
        "rows": rows,
        "head": ["relative change of the data", "share that spreads", "lower limit", "upper limit"],
        "members": results.quote(SENSITIVITY, float(data.attrs["members"])),
        "scanned": results.quote(SENSITIVITY, data.sizes["initial"]),
        "spread": results.quote(SENSITIVITY, int(data["spread"].sum())),
        "range": results.say(SENSITIVITY, _span(data["initial"].values)),
        "paper": not results.apart("breathers/sensitivity"),
    }


def _fates(results: Results) -> dict[str, Any]:
    """Return shares of area, which of what stays is periodic, and runs on other terms."""
    data = results[MAP]
    omegas = [float(omega) for omega in data["omega"].values]
    stay = data["checked_fate"] == list(data["fate_name"].values).index("stays")
    stay_on = stay.isel(conditions=0) & stay.sel(conditions=LONGEST)
    return {
        "head": ["Ω", "data", *map(str, data["fate_name"].values)],
        "planes": {
            plane: [_shares(results, plane, omega) for omega in omegas]
            for plane in map(str, data["plane"].values)
        },
        "ratio": results.quote(MAP, float(data.attrs["ratio"])),
        "end": results.quote(MAP, float(data.attrs["end_time"])),
        "periodic": [one for omega in omegas if (one := _periodic(results, omega))],
        "half_periods": results.quote(MAP, HALF_PERIODS),
        "waves": results.quote(MAP, WAVES),
        "within": results.quote(MAP, NEAR),
        "stay": results.quote(MAP, int(stay.isel(conditions=0).sum())),
        "stay_on": results.quote(MAP, int(stay_on.sum())),
        "longest": results.quote(MAP, TIMES * float(data.attrs["end_time"])),
        "fine": bool((data["common"] > 0).all()),
        "common": results.quote(MAP, int(data["common"].sum()), 6),
        "agreed": results.quote(MAP, int(data["agreed"].sum()), 6),
        "checked": [_checked(results, str(one)) for one in data["conditions"].values[1:]],
        "checked_points": results.quote(MAP, data["checked_fate"][0].size),
        "cases": [_case(results, str(case)) for case in data["case"].values],
        "of_paper": not results.apart(MAP),
    }  # fmt: skip


AXES = {"amplitudes": ("a0", "b0"), "phases": ("turned_a0", "phase")}


def _shares(results: Results, plane: str, omega: float) -> list:
    """Return a row: how many data there are, and the share of each fate with its limits."""
    data = results[MAP].sel(plane=plane, omega=omega)
    count = int(np.prod([data.sizes[axis] for axis in AXES[plane]]))
    fates = (data.isel(fate_name=i) for i in range(data.sizes["fate_name"]))
    shares = (results.say(MAP, share_with_limits(one)) for one in fates)
    return [number(omega), results.quote(MAP, count, 6), *shares]


def share_with_limits(one: xr.Dataset) -> str:
    """Return the share of an area and its limits in per cent, such as 14.2 % (14 to 14.4)."""
    names = ("area", "area_low", "area_high")
    value, low, high = (_in_per_cent(float(one[name])) for name in names)
    return f"{value} % ({low} to {high})"


def _in_per_cent(share: float) -> str:
    """Return three digits, which are those of the rest where nearly everything is meant."""
    rest = 100.0 * (1.0 - share)
    nearly = f"{100.0 - float(f'{rest:.3g}'):.12g}"
    return nearly if 0 < rest < 0.1 else number(100.0 * share, 3)


def _periodic(results: Results, omega: float) -> dict[str, Any] | None:
    """Return the share of what stays on the first map that is periodic, and how near to families.

    A = B is left out as in the shares: it has families of its own. Returns None if nothing stays.
    """
    data = results[MAP]
    here = data[["fate", "periodic", "family_distance"]].sel(omega=omega)
    here = here.where(here["a0"] != here["b0"])
    stays = here["fate"] == list(data["fate_name"].values).index("stays")
    known = here["family_distance"].values[np.isfinite(here["family_distance"].values)]
    if not stays.any():
        return None
    return {
        "omega": results.quote(MAP, omega),
        "share": results.say(MAP, percent(float((here["periodic"] == 1).sum() / stays.sum()))),
        "near": known.size and results.say(MAP, percent(float((known <= NEAR).mean()))),
        "median": known.size and results.quote(MAP, float(np.median(known)), 2),
    }


def _checked(results: Results, conditions: str) -> dict[str, Any]:
    fates = results[MAP]["checked_fate"]
    changed = (fates.sel(conditions=conditions) != fates.isel(conditions=0)).sum()
    return {"terms": conditions, "changed": results.quote(MAP, int(changed))}


def _case(results: Results, case: str) -> dict[str, Any]:
    one = results[MAP].sel(case=case)
    off = one["case_distance"].values
    found = {
        "case": case,
        "fate": results.say(MAP, str(results[MAP]["fate_name"].values[int(one["case_fate"])])),
    }
    if np.isfinite(off).any():
        found["frequency"] = results.quote(MAP, float(one["case_breather_frequency"]), 4)
        found["family"] = symbols(str(results[MAP]["family"].values[np.nanargmin(off)]))
        found["distance"] = results.quote(MAP, float(np.nanmin(off)), 2)
    return found


def _pictures(results: Results) -> dict[str, Picture]:
    power = results[PERIODIC]["power"].sum("component", skipna=False)
    spread = results[MAP]["area"].sel(plane="amplitudes", fate_name="spreads")
    said = "; ".join(
        f"Ω = {float(omega):g}: {percent(float(spread.sel(omega=omega)))} spread"
        for omega in spread["omega"].values
    )
    described = {
        "breathers": f"P against the frequency for {power.sizes['family']} families, and what a "
        "localised motion gains from the drive beside the law of weak drives.",
        "sensitivity": "The share of runs that spread against the size of a random change of the "
        "data, and the largest norm against the initial amplitude.",
        "fates": "What becomes of data on one pair, by their amplitudes, and by the phase between "
        f"them: they disperse, stay, move or spread. By this run's coarse map, {said}.",
    }
    return {name: results.picture(name, alt) for name, alt in described.items()}


SECTIONS = (Section("breathers", "Breathers, and why some data spread", gather),)
