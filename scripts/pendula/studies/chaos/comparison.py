"""The paper's own runs among ensembles: how long inside their bands, how far from their means."""

from collections.abc import Mapping

import numpy as np
import xarray as xr

from pendula.measures.difference import is_of_same_case

BAND = (0.05, 0.95)
"""The quantiles that bound the band of an ensemble."""


def compare(
    ensembles: xr.Dataset,
    runs: Mapping[str, xr.Dataset],
    references: Mapping[str, xr.Dataset],
    sweeps: Mapping[str, xr.Dataset],
    windows: Mapping[str, str],
) -> xr.Dataset:
    """Return the paper's runs and the references of the same cases beside the ensembles.

    `ensembles` is the dataset of `ensemble_table`; the mappings are by case and by sweep, and
    `windows` names the time window of each sweep, such as "[10, 50]". All is dimensionless:
    `run`, `true` (case, tau) are l2 norms of the pair, `run_inside`, `true_inside` (case) the parts
    of the later half of the time that they are inside BAND, `band_width`, `band_middle` (case) the
    mean width of that band relative to the median and the mean median, over the same time;
    `l2_mean`, `l2_deviation`, `swept_run`, `deviations` (sweep, half_width) are the maxima of the
    ensemble and of the paper's run, and their distance in standard deviations.
    """
    pair = ensembles.sel(quantity="pair", drop=True)
    names = xr.Variable("case", list(runs), ensembles["case"].attrs)
    known = [
        references[case].where(is_of_same_case(run, references[case])) for case, run in runs.items()
    ]
    run, true = (_norms_of(pair, names, data) for data in (runs.values(), known))
    run.attrs = _words("l2 norm of the paper's run")
    true.attrs = _words("l2 norm of the true run")
    cases = pair[["omega", "initial"]].assign(run=run, true=true)
    cases["run_inside"], cases["true_inside"] = (_inside(pair, norm) for norm in (run, true))
    cases["band_width"], cases["band_middle"] = _band(pair)
    cases["band_share"] = (), BAND[1] - BAND[0], _words("part of the ensemble in the band")
    swept = [_compare_sweep(pair, name, sweeps[name], window) for name, window in windows.items()]
    name = xr.Variable("sweep", list(windows), _words("sweep"))
    title = "The paper's runs among ensembles from almost equal data"
    both = xr.merge([cases, xr.concat(swept, name)], combine_attrs="drop_conflicts")
    return both.drop_attrs(deep=False).assign_attrs(title=title)


def _words(long_name: str) -> dict[str, str]:
    return {"long_name": long_name, "units": "1"}


def _norms_of(pair: xr.Dataset, names: xr.Variable, runs) -> xr.DataArray:
    norms = [np.sqrt((run["l2"] ** 2).sum("component", skipna=False)) for run in runs]
    return xr.concat(norms, names, join="outer").reindex(tau=pair["tau"], method="nearest")


def _late(curve):
    """Return the later half of the time."""
    return curve.sel(tau=slice(float(curve["tau"].max()) / 2, None))


def _inside(pair: xr.Dataset, norm: xr.DataArray) -> xr.DataArray:
    """Return the part of the later half of the time in which a norm is within the band."""
    low, high = (pair["l2"].sel(quantile=quantile) for quantile in BAND)
    inside = ((norm >= low) & (norm <= high)).where(norm.notnull())
    name = f"part of the later half that {norm.attrs['long_name']} is within 5 to 95 %"
    found = _late(inside).mean("tau").drop_vars("quantile", errors="ignore")
    return found.assign_attrs(_words(name))


def _band(pair: xr.Dataset) -> tuple[xr.DataArray, xr.DataArray]:
    """Return the mean width of the band relative to the median, and the mean median."""
    late = _late(pair["l2"])
    low, high = (late.sel(quantile=quantile, drop=True) for quantile in BAND)
    middle = late.median("quantile")
    width = ((high - low) / middle).mean("tau")
    words = _words("mean width of the band from 5 to 95 % over the median, later half")
    return width.assign_attrs(words), middle.mean("tau").assign_attrs(
        _words("mean of the ensemble's median, later half")
    )


def _compare_sweep(pair: xr.Dataset, name: str, own: xr.Dataset, window: str) -> xr.Dataset:
    at = {"statistic": "max", "window": window, "drop": True}
    data = pair[["l2_mean", "l2_deviation"]].sel(sweep=name, **at)
    run = own["l2"].sel(quantity="pair", **at).reindex(half_width=data["half_width"])
    data["swept_run"] = run.assign_attrs(_words("maximum of the paper's run"))
    off = (run - data["l2_mean"]) / data["l2_deviation"]
    words = "maximum of the paper's run minus the mean, in standard deviations"
    data["deviations"] = off.assign_attrs(_words(words))
    data["swept_window"] = (), window, _words("window of the maximum")
    data["swept_omega"] = (), float(own.attrs["omega"]), _words("detuning Omega")
    data["swept_initial"] = (), str(own.attrs["initial"]), _words("initial {site: [A, B]}")
    return data


def mismatched(cases, lyapunov: xr.Dataset) -> xr.Variable:
    """Return how many cases are chaotic without an ensemble, or have one without being chaotic.

    Which cases get ensembles must be configured before any run; what is chaotic is measured. None
    may differ.
    """
    chaotic = {str(case) for case in lyapunov["case"].values[lyapunov["chaotic"].values == 1]}
    about = {"long_name": "cases that have an ensemble or are chaotic, but not both", "units": "1"}
    return xr.Variable((), len(chaotic ^ set(map(str, cases))), {**about, "tolerance": 0.0})
