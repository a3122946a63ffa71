"""The pictures of the section on chaos, each described by its data."""

import numpy as np

from pendula.report.numbers import with_error
from pendula.report.pictures import Picture
from pendula.report.results import Results
from pendula.report.words import case_of

from .section import ENSEMBLES, LYAPUNOV, TRUST, ensemble_of, lost_by


def gather(results: Results) -> dict[str, Picture]:
    """Return the four pictures by name."""
    described = {
        "trust_horizons": f"Errors of the norms against τ. {_lost(results)}.",
        "lyapunov": f"Growth of small changes. Rates: {_rates(results)}.",
        "symmetry": f"The odd part of even solutions against τ. {_broken(results)}.",
        "ensembles": f"Bands of runs from almost equal data. {_bands(results)}.",
    }
    return {name: results.picture(name, alt) for name, alt in described.items()}


def _lost(results: Results) -> str:
    found = [lost_by(results, str(name)) for name in results[TRUST]["solver"].values]
    return "; ".join(
        f"{one['solver']} loses {one['count']} cases, at τ = {one['times']}" for one in found
    )


def _rates(results: Results) -> str:
    growth = results[LYAPUNOV].sel(parity="even")
    cases = [growth.sel(case=name) for name in growth["case"].values]
    return "; ".join(
        f"{case_of(case)}: {with_error(float(case['exponent']), float(case['exponent_error']))}"
        for case in cases
    )


def _broken(results: Results) -> str:
    times = results["checks/symmetry"]["rounded_time"].values
    return (
        f"By rounding alone it becomes visible in {np.isfinite(times).sum()} of {len(times)} cases"
    )


def _bands(results: Results) -> str:
    bands = [ensemble_of(results, str(name)) for name in results[ENSEMBLES]["case"].values]
    return "; ".join(f"{band['case']}: {band['share']} within {band['width']}" for band in bands)
