"""Until when the printed lines of Figs 2 to 4 contain the true curves: as proved, and as measured.

A line is drawn through the outputs of a run, and has a width. It contains the true curve at an
output if the run's value there is no further from the true one than half of that width, in the
units of the panel. The true value is known to within its proven bound, so this is a theorem; with
the multiprecision reference in its place it is a measurement. Between two outputs the line is
straight, and nothing is said.
"""

from collections.abc import Mapping

import numpy as np
import xarray as xr

from pendula.drawing.strips import half_line
from pendula.measures.difference import NORMS, at_times, is_of_same_case

WORDS = {
    "norm": "norm",
    "half_line": "how far a printed line surely reaches from its points, in units of the norm",
    "contained_until": "tau to which the printed line contains the true curve at every output, as "
    "proved; NaN: nothing is proved",
    "measured_until": "tau to which it contains the multiprecision reference; NaN: none is known",
    "largest_distance": "largest proven distance of the drawn curve to the true one; infinite: "
    "nothing is proved",
    "run_end": "end of the runs of the case",
}


def contain_curves(
    runs: Mapping[str, xr.Dataset],
    proved: Mapping[str, xr.Dataset],
    proofs: Mapping[str, xr.Dataset],
    references: Mapping[str, xr.Dataset],
) -> xr.Dataset:
    """Return by case and curve until when the printed line contains the true curve.

    The datasets are by case: curves `proved` in this run, and `proofs` that are committed. Cases in
    neither have no theorem, and a reference of another problem decides nothing.
    """
    certified = {**proved, **proofs}
    cases = [_of_case(run, certified.get(name), references[name]) for name, run in runs.items()]
    data = xr.concat(cases, xr.Variable("case", list(runs)))
    for name, long_name in WORDS.items():
        data[name].attrs = {"long_name": long_name, "units": "1"}
    return data.assign_attrs(title="Until when the printed lines contain the true curves")


def _of_case(run: xr.Dataset, proved: xr.Dataset | None, reference: xr.Dataset) -> xr.Dataset:
    half, known = half_lines(run), is_of_same_case(run, reference)
    curves = _curves(run)
    off = distance(run, proved) if proved is not None else np.inf * curves
    apart = abs(curves - _curves(at_times(reference, run["tau"])))

    def until(distances: xr.DataArray) -> xr.DataArray:
        """Return the last tau up to which no distance is larger than half of a line."""
        inside = (distances <= half).astype(int).cumprod("tau")
        return run["tau"].where(inside == 1).max("tau")

    return xr.Dataset(
        {
            "half_line": half,
            "contained_until": until(off).where(np.isfinite(off).any("tau")),
            "measured_until": until(apart).where(known),
            "largest_distance": off.max("tau"),
            "run_end": float(run["tau"][-1]),
            "omega": float(run.attrs["omega"]),
            "initial": str(run.attrs["initial"]),
        }
    )


def _curves(run: xr.Dataset) -> xr.DataArray:
    """Return the four curves of a run, (norm, component, tau), without their descriptions."""
    return run[list(NORMS)].to_dataarray("norm").drop_attrs(deep=False)


def half_lines(run: xr.Dataset) -> xr.DataArray:
    """Return half of the width of the lines in the panel of each norm, in units of the norm."""
    top = _curves(run).max(("component", "tau"))
    return top.copy(data=[half_line(float(value)) for value in top])


def distance(run: xr.Dataset, proved: xr.Dataset) -> xr.DataArray:
    """Return how far the drawn curves can be from the true ones, (norm, component, tau).

    It is infinite where they are not of one case, and at outputs that only one of them has.
    """
    if not is_of_same_case(run, proved):
        return np.inf * _curves(run)
    known = proved[[*NORMS, "bound"]].reindex(tau=run["tau"])
    return (abs(_curves(run) - _curves(known)) + known["bound"].drop_attrs()).fillna(np.inf)
