"""The report's part on chaos: growth of small changes, evenness, ensembles, until when to trust."""

from typing import Any

import numpy as np

from pendula.datasets.registry import SOLVER_NAMES
from pendula.ledger.section import Ledger
from pendula.measures.growth import MANY
from pendula.report.page import Picture
from pendula.report.results import Results, Section
from pendula.report.words import case_of, number, percent, span, with_error

LYAPUNOV, TRUST = "checks/lyapunov", "checks/trust"
ENSEMBLES = "checks/ensemble_runs"


def gather(results: Results, ledger: Ledger) -> dict[str, Any]:
    """Return a row for each case, what each solver leaves, and the ensembles in words."""
    growth, trust = results[LYAPUNOV], results[TRUST]
    rates = growth["exponent"].max("parity")
    chaotic = [str(case) for case in growth["case"].values[growth["chaotic"].values == 1]]
    solvers = [str(solver) for solver in trust["solver"].values]
    return {
        "cases": results.quote(LYAPUNOV, growth.sizes["case"]),
        "chaotic": [case_of(growth.sel(case=case)) for case in chaotic],
        "count": results.quote(LYAPUNOV, len(chaotic)),
        "rates": results.say(LYAPUNOV, span(rates.sel(case=chaotic), 2) if chaotic else "none"),
        "limit": number(float(np.exp(MANY))),
        "visible": percent(float(trust["size"].sel(level="visible"))),
        "end": results.quote(TRUST, float(trust["tau"].max())),
        "head": ["case", "growth, even", "growth, odd",
                 *(f"{SOLVER_NAMES[name]} leaves" for name in solvers), "uneven from"],
        "rows": [_row(results, str(case), solvers) for case in growth["case"].values],
        "lost": {name: lost_by(results, name) for name in solvers},
        "ensembles": [ensemble_of(results, case) for case in results[ENSEMBLES]["case"].values],
        "decimal": not_a_tenth(results),
        "pictures": _pictures(results),
        "members": results.quote(ENSEMBLES, results[ENSEMBLES].attrs["members"]),
        "size": results.quote(ENSEMBLES, results[ENSEMBLES].attrs["perturbation"]),
    }  # fmt: skip


def _row(results: Results, case: str, solvers: list[str]) -> list:
    growth = results[LYAPUNOV].sel(case=case)
    trust = results[TRUST].sel(case=case, level="visible")
    even, odd = (
        results.quote_error(LYAPUNOV, float(growth["exponent"].sel(parity=parity)),
                            float(growth["exponent_error"].sel(parity=parity)))
        for parity in ("even", "odd")
    )  # fmt: skip
    lost = [results.quote_time(TRUST, float(trust["horizon"].sel(solver=s))) for s in solvers]
    uneven = float(results["checks/symmetry"]["rounded_time"].sel(case=case))
    return [case_of(growth), even, odd, *lost, results.quote_time("checks/symmetry", uneven)]


def lost_by(results: Results, solver: str) -> dict[str, Any]:
    """Return in how many cases a solver leaves the reference, and when."""
    horizons = results[TRUST]["horizon"].sel(solver=solver, level="visible").values
    known = horizons[np.isfinite(horizons)]
    return {
        "solver": SOLVER_NAMES[solver],
        "any": len(known) > 0,
        "count": results.quote(TRUST, len(known)),
        "kept": results.quote(TRUST, int(np.isinf(horizons).sum())),
        "times": results.say(TRUST, span(known, 4) if len(known) else "never"),
    }


def not_a_tenth(results: Results) -> dict[str, Any]:
    """Return when the reference from the double next to 0.1 leaves the one from a tenth."""
    digits, seen = results[TRUST]["decimal_horizon"].values
    return {
        "omega": number(float(results["trajectories/fig4_small"].attrs["omega"])),
        "digits": number(float(results[TRUST]["decimal_size"][0])),
        "first": results.quote_time(TRUST, float(digits)),
        "seen": results.quote_time(TRUST, float(seen)),
    }


def ensemble_of(results: Results, name: str) -> dict[str, Any]:
    """Return how wide the band of an ensemble is, and how long the paper's run is inside it."""
    case = results[ENSEMBLES].sel(case=name)
    return {
        "case": case_of(case),
        "share": results.say(ENSEMBLES, percent(float(case["band_share"]))),
        "width": results.say(ENSEMBLES, percent(float(case["band_width"]))),
        "middle": results.quote(ENSEMBLES, float(case["band_middle"])),
        "inside": results.say(ENSEMBLES, percent(float(case["run_inside"]))),
    }


def _pictures(results: Results) -> dict[str, Picture]:
    """Return the four pictures by name."""
    growth, trust = results[LYAPUNOV].sel(parity="even"), results[TRUST]
    lost = [lost_by(results, str(name)) for name in trust["solver"].values]
    rates = [
        f"{case_of(case)}: {with_error(float(case['exponent']), float(case['exponent_error']))}"
        for case in (growth.sel(case=name) for name in growth["case"].values)
    ]
    uneven = results["checks/symmetry"]["rounded_time"].values
    bands = [ensemble_of(results, name) for name in results[ENSEMBLES]["case"].values]
    described = {
        "trust_horizons": "Errors of the norms against τ. "
        + "; ".join(f"{one['solver']} leaves {one['count']} cases, at τ = {one['times']}"
                    for one in lost),
        "lyapunov": f"Growth of small changes. Rates: {'; '.join(rates)}",
        "symmetry": "The odd part of even solutions against τ. By rounding alone it becomes "
        f"visible in {np.isfinite(uneven).sum()} of {len(uneven)} cases",
        "ensembles": "Bands of runs from almost equal data. "
        + "; ".join(f"{band['case']}: {band['share']} within {band['width']}" for band in bands),
    }  # fmt: skip
    return {name: results.picture(name, f"{alt}.") for name, alt in described.items()}


SECTIONS = (Section("chaos", "What can be trusted", gather),)
