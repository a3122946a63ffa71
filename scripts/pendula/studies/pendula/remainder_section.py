"""What the report says of the expansion beside the pendula."""

from typing import Any

import numpy as np

from pendula.report.results import Results
from pendula.report.words import number, symbols, with_error

from .claims_remainder import UNSTABLE, common_end

DATA = "pendula/remainder"


def remainder(results: Results) -> dict[str, Any]:
    """Return orders and constants as a table, horizons at each mu, and the picture."""
    data = results[DATA]
    mus = [float(mu) for mu in data["mu"].values]
    return {
        "head": ["case", "Ω", "order", "error / μ³, rad", "order, corrected", "error / μ⁵, rad"],
        "rows": [_row(results, str(case)) for case in data["case"].values],
        "end": results.quote(DATA, common_end(data)),
        "of_paper": not results.apart(DATA, on=(UNSTABLE, "fig4_large")),
        "horizon_head": ["case", "expansion", *(f"μ = {number(mu)}" for mu in mus)],
        "horizons": [
            _horizons(results, str(case), str(expansion))
            for case in data["case"].values
            for expansion in data["expansion"].values
        ],
        "wrong_head": ["expansion", "least order", "largest order"],
        "wrong": [_wrong(results, str(name)) for name in data["wrong_expansion"].values],
        "picture": results.picture("pendula_remainder", _alt(data)),
    }


def _row(results: Results, case: str) -> list:
    data = results[DATA].sel(case=case, end=common_end(results[DATA]))
    cells = []
    for expansion in data["expansion"].values:
        one = data.sel(expansion=expansion)
        order, off = float(one["order"]), float(one["order_uncertainty"])
        told = "unknown" if np.isnan(order) else with_error(order, off)
        cells += [results.say(DATA, told), results.quote(DATA, float(one["error_constant"]))]
    return [case, number(float(data["omega"])), *cells]


def _horizons(results: Results, case: str, expansion: str) -> list:
    one = results[DATA]["visible_from"].sel(case=case, expansion=expansion).values
    times = ["beyond the run" if np.isinf(time) else number(float(time)) for time in one]
    return [case, expansion, *(results.say(DATA, time) for time in times)]


def _wrong(results: Results, name: str) -> list:
    orders = results[DATA]["wrong_order"].sel(wrong_expansion=name).values
    return [
        symbols(name),
        *(results.quote(DATA, float(pick(orders))) for pick in (np.nanmin, np.nanmax)),
    ]


def _alt(data) -> str:
    """Describe the picture in words."""
    return (
        f"The largest error of an angle against mu for {data.sizes['case']} cases and both orders "
        "of the expansion; the error over mu cubed against time; the time at which the error "
        "becomes visible, against mu."
    )
