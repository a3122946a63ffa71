"""How the norms grow on chains without ends: bands of ensembles, exponents of tau, and a law.

Where the chain at rest is unstable, a front moves at the speed v of linear spreading and leaves a
thermal bulk of mean power P per site on both sides. The norm is then l2 = (2 v P tau)^(1/2).
"""

from collections.abc import Mapping

import numpy as np
import xarray as xr

from pendula.measures.growth import local_powers

POINTS, OCTAVES = 120, 4
"""Times of a series, equally spaced in log tau; the last octaves of time with an exponent each."""
NORMS = {"l2": "l2", "linf": "l-infinity"}
STATISTICS = ["lowest", "mean", "highest"]


def measure_growth(runs: Mapping[str, xr.Dataset], thermal: xr.Dataset) -> xr.Dataset:
    """Return series, exponents and laws of the ensembles in `runs`, by case.

    `runs` are datasets of `spread_variables`, of which the first variant is measured; `thermal`
    holds the mean power of the thermal states over Omega. All values are dimensionless:
    `l2`, `linf` (case, statistic, point) over `tau` (case, point); `l2_exponent` and
    `linf_exponent` (case, octave) with standard errors, at `octave_tau` (case, octave); `law`
    (case), the coefficient of tau^(1/2), NaN where the chain at rest is stable.
    """
    first = [run.isel(variant=0) for run in runs.values()]
    case = xr.Variable("case", list(runs), _words("case of the paper, on a chain without ends"))
    data = xr.concat([_measure(run) for run in first], case)
    data["omega"] = "case", [float(run["omega"]) for run in first], _words("detuning Omega")
    initials = [str(run.attrs["initial"]) for run in first]
    data["initial"] = "case", initials, _words("initial {site: [A, B]}")
    laws = [_law(run, thermal) for run in first]
    title = "coefficient of tau^(1/2) by linear spreading and the thermal bulk"
    data["law"] = "case", laws, _words(title)
    same = {key: first[0].attrs[key] for key in ("epsilon", "gamma", "version") if key in
            first[0].attrs}  # fmt: skip
    title = "Growth of the norms on chains without ends"
    return data.assign_attrs(title=title, **same)


def _words(long_name: str) -> dict[str, str]:
    return {"long_name": long_name, "units": "1"}


def _law(run: xr.Dataset, thermal: xr.Dataset) -> float:
    """Return (2 v P)^(1/2), NaN where the chain at rest is stable or no state was sampled."""
    near = thermal.sel(omega=run["omega"], method="nearest")
    if not (run["predicted_delay"] > 0 and abs(near["omega"] - run["omega"]) < 1e-9):
        return float("nan")
    return float(np.sqrt(2.0 * run["predicted_speed"] * near["power"]))


def _measure(run: xr.Dataset) -> xr.Dataset:
    tau = run["tau"].values
    grid = np.geomspace(1.0, tau[-1], POINTS)
    found = xr.Dataset({"tau": ("point", grid, _words("slow time"))})
    for name, title in NORMS.items():
        values = run[name].transpose("member", "tau").values
        drawn = np.array([np.interp(grid, tau, series) for series in values])
        band = [drawn.min(axis=0), drawn.mean(axis=0), drawn.max(axis=0)]
        found[name] = ("statistic", "point"), np.array(band), _words(f"{title} norm of (A, B)")
        middles, fits = local_powers(tau, values, OCTAVES)
        exponents, errors = np.array(fits).T
        title = f"exponent of tau in the {title} norm over an octave"
        found[f"{name}_exponent"] = "octave", exponents, _words(title)
        found[f"{name}_exponent_error"] = "octave", errors, _words(f"standard error of the {title}")
    found["octave_tau"] = "octave", middles, _words("middle of an octave of tau")
    return found.assign_coords(statistic=("statistic", STATISTICS, _words("over the ensemble")))
