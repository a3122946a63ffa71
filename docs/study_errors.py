"""The error that each part of a study needs, and the one that the accepted results reach.

A study says in its configuration which error each of its parts needs, below `needs`. Here stands,
under the same name, how that error is read from the accepted datasets. Both go into
docs/studies.md, and a test holds the reached errors to the needed ones.
"""

from functools import cache
from pathlib import Path

import numpy as np
import xarray as xr
import yaml
from facts import BASELINE
from pendula.datasets.json_files import load_json
from pendula.measures.confidence import difference_limits
from pendula.studies.breathers.fates import shares_of_area
from pendula.studies.pendula.claims_phases import pendula_norms, same_sea
from pendula.studies.pendula.claims_remainder import STABLE, common_end
from pendula.studies.pendula.claims_threshold import limit_of, outside, smallest_mus
from pendula.studies.unbounded.claims import OF_A_SHORT_BULK, exponent_of, stays

CONFIG = Path(__file__).resolve().parents[1] / "config"


def chaos(baseline) -> dict[str, float]:
    """Return the errors of exponents, of lost evenness, and of ensembles."""
    lyapunov, lives = baseline["checks/lyapunov"], baseline["checks/lifetimes"]
    chaotic = lyapunov["chaotic"] == 1
    late = lyapunov["divergence_measured"]
    predicted = abs(lyapunov["divergence_predicted"] - late).where(np.isfinite(late))
    spectra = lyapunov.isel(spectrum_half_width=0)
    size, limits = abs(spectra["exponents"]), spectra["exponents_error"]
    spacing = 2.0 * size.max("index") / size.notnull().sum("index")  # mean distance of exponents
    swept = [baseline[f"checks/{name}"] for name in ("ensembles", "ensembles_uneven")]
    levels = baseline["checks/members"]["l2_level"].sel(quantity="pair").isel(window=0)
    panels = []  # limits of the difference between those of Fig 4, relative to the lower one
    for kind in ("even", "uneven"):
        small, large = (levels.sel(kind=kind, case=f"fig4_{one}").values for one in PANELS)
        panels.append(float(difference_limits(small, large).half / large.mean()))
    return {
        "exponents": _most((lyapunov["exponent_error"] / lyapunov["exponent"]).where(chaotic)),
        "divergence": _most(predicted),
        "spectra": _most(limits.isel(index=size.argmin("index")) / spacing),
        "undriven_spectra": _most(lyapunov["exponents_error_undriven"]),
        "evenness": _most(baseline["checks/symmetry"]["rounded"].where(~chaotic)),
        "sweeps": max(
            _most((one["l2_error"] / one["l2_mean"]).sel(quantity="pair")) for one in swept
        ),
        "members": max(panels),
        "lives": _most(lives["surviving_high"].isel(tau=-1).where(lives["surviving"][:, -1] == 0)),
        "rates": _most((lives["choice_rate_high"] / lives["choice_rate_low"]) ** 0.5),
    }


PANELS = ("small", "large")


def _most(values: xr.DataArray) -> float:
    return float(values.max())


def theory(baseline) -> dict[str, float]:
    """Return the errors of searches, thresholds and exponents."""
    growth = baseline["checks/chain_growth"]
    high, low = (growth[f"power_exponent_{end}"] for end in ("high", "low"))
    return {
        "searches": _most(baseline["checks/worst"]["last_rise"]),
        "thresholds": _most(baseline["checks/sharp_threshold"]["threshold_error"]),
        "spreading": _most(baseline["checks/threshold"]["spreading_error"]),
        "chain_growth": _most(0.5 * (high - low)),
    }


def pendula(baseline) -> dict[str, float]:
    """Return the errors of the parts of the study of the pendula."""
    beside = outside(smallest_mus(baseline["pendula/threshold"]))
    remainder, rates = baseline["pendula/remainder"], baseline["pendula/over_the_top"]
    sea = same_sea(baseline["pendula/sea"], baseline["unbounded/thermal"])
    low = rates["passage_rate_low"]
    order = remainder["order"].sel(case=list(STABLE), end=common_end(remainder))
    return {
        "threshold": _most(abs(limit_of(beside) / beside["gamma_0_lemma"] - 1.0)),
        "remainder": _most(abs(order - order.round())),
        "phases": pendula_norms(baseline["pendula/phases"]).measured["largest_difference"],
        "sea": sea.measured["its_limits"],
        "over_the_top": float((rates["passage_rate"] / low).where(low > 0).min()),
    }


def breathers(baseline) -> dict[str, float]:
    """Return the errors of rates, thresholds, periods, the law of drives, and shares."""
    steady, shares = baseline["breathers/steady"], baseline["breathers/sensitivity"]
    maps = baseline["breathers/fates"]["fate"]
    below, found_to = steady["stable_below"], given("breathers")["steady"]["stability"]["to"]
    rows = load_json(BASELINE / "claims.json")["rows"]
    (law,) = (row["measured"] for row in rows if row["name"] == "grows_by_drive")
    off = abs(steady["growth"] - steady["growth_half"]) / steady["growth"].where(steady["growth"])
    return {
        "steady": _most(off),
        "thresholds": _most(abs(below.diff("chain_half_width"))) + found_to,
        "periodic": float(baseline["breathers/periodic"].attrs["residual"]),
        "law": law["largest_difference"],
        "shares": _most(0.5 * (shares["share_high"] - shares["share_low"])),
        "fates": max(shares_of_area(one, mirrored=True).half.max() for one in maps.values),
    }


def unbounded(baseline) -> dict[str, float]:
    """Return the errors of the infinite chains, of their solver, and of the thermal states."""
    growth, front = baseline["unbounded/growth"], baseline["unbounded/front"]
    thermal, runs = baseline["unbounded/thermal"], [baseline[f"unbounded/{n}"] for n in CHAOTIC]
    regular = [baseline[f"unbounded/{name}"] for name in ("fig3_small", "fig2_large")]
    errors = [(thermal[f"{kind}power_error"] / thermal[f"{kind}power"]) for kind in ("", "warm_")]
    widest = baseline["unbounded/map_fig5_right"]["l2"].isel(end=-1)
    scatter = widest.std("member", ddof=1) / widest.sizes["member"] ** 0.5
    lost = []  # energy by the end, over the sites in motion
    for run in runs:
        moving = 2.0 * run["front"].isel(piece_tau=-1, front_power=0).clip(min=1.0)
        lost.append(_most(abs(run["energy"].isel(tau=-1) - run["energy"].isel(tau=0)) / moving))
    return {
        "slope": _most((growth["rate_limits"] / growth["law"]).isel(span=-1)),
        "band": _most(front["slope_power_error"] / front["expected_power"]),
        "front": _most(front["corrected_speed_error"]),
        "large": exponent_of(baseline["unbounded/fig3_large"], octaves=OF_A_SHORT_BULK).half,
        "regular": max(stays(run).measured["growth_at_most"] for run in regular),
        "maps": _most(scatter / widest.mean("member")),
        "energy": max(lost),
        "thermal": max(map(_most, errors)),
    }


CHAOTIC = ("fig4_small", "fig3_large", "omegas", "amplitudes")


def certified(baseline) -> dict[str, float]:
    """Return the largest proven error of each part of the proofs."""
    cases, framed = given("certified")["curves"]["cases"], given("certified")["frames"]
    proved = baseline["certified/breathers"]
    radii = [_most(proved[name]) for name in ("radius", "chain_radius")]
    return {
        "curves": max(_most(baseline[f"certified/{case}"]["bound"]) for case in cases),
        "frames": max(_most(baseline[f"proofs/{case}"]["bound"]) for case in framed),
        "breathers": max(radii),
    }


STUDIES = (chaos, theory, pendula, breathers, unbounded, certified)


def errors(baseline) -> dict[str, dict[str, float]]:
    """Return the reached error of every part of every study."""
    return {study.__name__: study(baseline) for study in STUDIES}


@cache
def given(study: str) -> dict:
    """Return a study's section of the configuration, read once; do not change it."""
    return yaml.safe_load((CONFIG / f"{study}.yaml").read_text(encoding="utf-8"))[study]
