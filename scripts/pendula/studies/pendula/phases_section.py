"""What the report says of the paper's phases in the real pendula, and the pendula to look at."""

import base64
from typing import Any

import numpy as np

from pendula.ledger.claim import SETTLED
from pendula.numerics.elementary import cos, sin
from pendula.report.results import Results
from pendula.report.words import case_in_words, number, percent, with_error

from .claims_phases import late_levels
from .thermal_beside import thermal_beside

PHASES, SEA, TOP = "pendula/phases", "pendula/sea", "pendula/over_the_top"
FILM = "pendula/film"
NOT_KNOWN = "not known"


def phases(results: Results) -> dict[str, Any]:
    """Return norms by case and mu, the sea, first passages, and the pictures."""
    mus = [float(mu) for mu in results[PHASES]["mu"].values]
    return {
        "head": ["case", *(_name(mu) for mu in mus)],
        "rows": _norms(results),
        "lost": any("comment" in results[name].attrs for name in (PHASES, TOP)),
        "least_mu": results.quote(PHASES, min(mu for mu in mus if mu)),
        "border": not results.apart("trajectories/fig3_large"),
        "sea": _sea(results),
        "passages": _passages(results),
        "picture": results.picture("pendula_phases", _alt(results[PHASES])),
        "sea_picture": results.picture("pendula_over_the_top", _alt_of_sea(results[TOP])),
    }


def _name(mu: float) -> str:
    return f"μ = {number(mu)}" if mu else "amplitudes (4)"


def _norms(results: Results) -> list[list]:
    data, rows = results[PHASES], []
    if float(data["tau"][-1]) <= SETTLED:  # no window of the paper's
        return rows
    l2, linf = late_levels(data), late_levels(data, "linf")
    for case in data["case"].values:
        one = data.sel(case=case)
        pairs = zip(l2.sel(case=case).values, linf.sel(case=case).values, strict=True)
        cells = [
            results.say(PHASES, NOT_KNOWN if np.isnan(a) else f"{number(a)}, {number(b)}")
            for a, b in pairs
        ]
        rows.append([case_in_words(float(one["omega"]), str(one["initial"].values)), *cells])
    return rows


def _sea(results: Results) -> dict[str, Any]:
    data = results[SEA]
    power = data["site_power"]
    error = power.std("member", ddof=1) / np.sqrt(power.sizes["member"])
    pairs = zip(power.mean("member").values, error.values, strict=True)
    thermal = float(thermal_beside(data, results["unbounded/thermal"], "power")["power"])
    return {
        "omega": results.quote(SEA, float(data.attrs["omega"])),
        "members": results.quote(SEA, float(data.sizes["member"])),
        "window": results.say(SEA, str(data.attrs["window"])),
        "powers": [
            (_name(float(mu)), results.say(SEA, with_error(float(mean), float(off))))
            for mu, (mean, off) in zip(data["mu"].values, pairs, strict=True)
        ],
        "thermal": results.quote("unbounded/thermal", thermal) if np.isfinite(thermal) else "",
    }


def _passages(results: Results) -> dict[str, Any]:
    data = results[TOP]
    last = data.isel(tau=-1)
    rows = []
    for mu in data["mu"].values:
        one = last.sel(mu=mu)
        share = [percent(float(one[f"passed{end}"])) for end in ("", "_low", "_high")]
        rows.append([
            number(float(mu), 4),
            results.say(TOP, f"{share[0]} ({share[1]} to {share[2]})"),
            results.say(TOP, _median(float(one["passage_median"]))),
            results.say(TOP, _rate(one)),
            results.say(TOP, _turns(one)),
        ])  # fmt: skip
    return {
        "head": [
            "μ",
            "gone over the top",
            "median τ",
            "rate per unit of τ",
            "largest angle, turns",
        ],
        "rows": rows,
        "end": results.quote(TOP, float(data["tau"][-1])),
        "members": results.quote(TOP, float(data.sizes["member"])),
        "settled": results.quote(TOP, float(data.attrs["settled"])),
        "of_paper": not results.apart(TOP),
    }


def _median(tau: float) -> str:
    return number(tau) if np.isfinite(tau) else "not by then"


def _turns(one) -> str:
    turns = float(one["angle_so_far"].mean("member", skipna=False)) / (2.0 * np.pi)
    return NOT_KNOWN if np.isnan(turns) else number(turns)


def _rate(one) -> str:
    """Return a rate with its limits, or that nobody was waiting."""
    rate, low, high = (float(one[f"passage_rate{end}"]) for end in ("", "_low", "_high"))
    if np.isnan(rate):
        return "all passed before"
    return f"{number(rate, 2)} ({number(low, 2)} to {number(high, 2)})"


def _alt(data) -> str:
    """Describe the picture of the phases in words."""
    return (
        f"Norms against time, and the larger modulus of each pair over sites and time, for "
        f"{data.sizes['case']} cases by the amplitude equations and for pendula at "
        f"{data.sizes['mu'] - 1} values of mu."
    )


def _alt_of_sea(data) -> str:
    """Describe the picture of the sea in words."""
    last = data.isel(tau=-1)
    shares = [f"{number(float(mu))}: {percent(float(last['passed'].sel(mu=mu)))}"
              for mu in data["mu"].values]  # fmt: skip
    return (
        "Spectrum and distribution of the sea beside the thermal state; the share of members that "
        f"have gone over the top by tau, at the end by mu {', '.join(shares)}; and the largest "
        "angle in turns."
    )


# --- Pendula to look at ---------------------------------------------------------------------------


def film(results: Results) -> dict[str, Any]:
    """Return the films of all cases as the page's script reads them."""
    data = results[FILM]
    return {
        "mu": results.quote(FILM, float(data.attrs["mu"])),
        "sites": data.sizes["site"],
        "first": number(int(data["site"][0])),
        "last": number(int(data["site"][-1])),
        "periods": results.quote(FILM, float(data["period"][-1])),
        "per_period": int(data.attrs["per_period"]),
        "count": data.sizes["picture"],
        "players": [_player(results, data.sel(case=case)) for case in data["case"].values],
    }


def _player(results: Results, one) -> dict[str, Any]:
    steps = one["angle_step"].transpose("picture", "component", "site").values
    tau = one["period"].values * float(one["tau_of_period"])
    still = len(steps) - 1
    swings = np.abs(steps[-int(one.attrs["per_period"]) :]).max(axis=(0, 1))  # by site
    half_turn = int(one.attrs["half_turn"])
    largest = float(swings.max()) / half_turn * 180.0
    moving = int((swings > 0.5 * swings.max()).sum())
    return {
        "case": case_in_words(float(one["omega"]), str(one["initial"].values)),
        "frames": base64.b64encode(steps.astype(np.int8).tobytes()).decode(),
        "step": float(tau[1]),
        "end": results.quote(FILM, float(tau[-1])),
        "still": still,
        "largest": results.say(FILM, f"{largest:.0f}°"),
        "moving": results.quote(FILM, float(moving)),
        "rows": [
            _hanging(row, np.pi / half_turn * angles) for row, angles in enumerate(steps[still])
        ],
    }


def _hanging(row: int, angles: np.ndarray) -> list[dict[str, float]]:
    """Return where each pendulum of a row hangs in the still picture, and where its bob is."""
    hook = 65.0 + 120.0 * row
    return [
        {
            "from": 20.0 * (place + 3.5),
            "hook": hook,
            "x": round(20.0 * (place + 3.5) + 48.0 * float(sin(angle)), 1),
            "y": round(hook + 48.0 * float(cos(angle)), 1),
        }
        for place, angle in enumerate(angles)
    ]
