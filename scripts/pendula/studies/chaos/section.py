"""What can be trusted, until when: growth of small changes, evenness, ensembles."""

from typing import Any

import numpy as np

from pendula.measures.difference import VISIBLE, difference, divergence_time
from pendula.measures.growth import MANY
from pendula.report.numbers import number, percent, span
from pendula.report.results import Results
from pendula.report.words import SOLVERS, case_of

LYAPUNOV, TRUST = "checks/lyapunov", "figures/trust_horizons"
ENSEMBLES = "figures/ensembles"
TENTH, DOUBLE = "truth/fig4_small", "truth/fig4_small.double"
DIGITS = 1e-12
"""Where the doubles next to two solutions begin to tell them apart."""


def gather(results: Results) -> dict[str, Any]:
    """Return a row for each case, what each solver loses, and the ensembles in words."""
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
        "head": ["case", "growth, even", "growth, odd", *map(_title, solvers), "uneven from"],
        "rows": [_row(results, str(case), solvers) for case in growth["case"].values],
        "lost": {name: lost_by(results, name) for name in solvers},
        "ensembles": [
            ensemble_of(results, str(case)) for case in results[ENSEMBLES]["case"].values
        ],
        "decimal": not_a_tenth(results),
        "members": results.quote("checks/ensembles", results["checks/ensembles"].attrs["members"]),
        "size": results.quote(
            "checks/ensembles", results["checks/ensembles"].attrs["perturbation"]
        ),
    }


def _title(solver: str) -> str:
    return f"{SOLVERS[solver]} lost"


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
    """Return how many cases a solver loses sight of, and when."""
    horizons = results[TRUST]["horizon"].sel(solver=solver, level="visible").values
    known = horizons[np.isfinite(horizons)]
    return {
        "solver": SOLVERS[solver],
        "any": len(known) > 0,
        "count": results.quote(TRUST, len(known)),
        "kept": results.quote(TRUST, len(horizons) - len(known)),
        "times": results.say(TRUST, span(known, 4) if len(known) else "never"),
    }


def not_a_tenth(results: Results) -> dict[str, Any]:
    """Return when the true run from the double next to 0.1 leaves the one from a tenth."""
    apart = difference(results[TENTH], results[DOUBLE])
    first, seen = (float(divergence_time(apart, level)) for level in (DIGITS, VISIBLE))
    return {
        "omega": number(float(results[DOUBLE].attrs["omega"])),
        "digits": number(DIGITS),
        "first": results.quote_time(DOUBLE, first),
        "seen": results.quote_time(DOUBLE, seen),
    }


def ensemble_of(results: Results, name: str) -> dict[str, Any]:
    case = results[ENSEMBLES].sel(case=name)
    late = case["l2"].sel(tau=slice(float(case["tau"].max()) / 2, None))
    low, middle, high = late.isel(quantile=0), late.median("quantile"), late.isel(quantile=-1)
    share = float(high["quantile"] - low["quantile"])
    width = float(((high - low) / middle).mean())
    return {
        "case": case_of(case),
        "share": results.say(ENSEMBLES, percent(share)),
        "width": results.say(ENSEMBLES, percent(width)),
        "middle": results.quote(ENSEMBLES, float(middle.mean())),
        "inside": results.say(ENSEMBLES, percent(float(case["run_inside"]))),
    }
