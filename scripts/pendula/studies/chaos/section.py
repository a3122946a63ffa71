"""The report's part on chaos: exponents, until when to trust a run, how long a motion stays."""

from typing import Any

from pendula.ledger.section import Ledger
from pendula.report.results import Results, Section, Table
from pendula.report.words import case_of, number, percent, told

LYAPUNOV, TRUST, LIVES = "checks/lyapunov", "checks/trust", "checks/lifetimes"
PRINTED = "truth/fig4_small"
"""The reference from the data as the paper prints them: it is of this case, whatever is run."""


def gather(results: Results, ledger: Ledger) -> dict[str, Any]:
    """Return exponents by case, horizons, and lives of the localised motion."""
    return {
        "rates": _rates(results),
        "trust_horizons": _trust_horizons(results),
        "lifetimes": results.figure("lifetimes", str(
            results["figures/lifetimes"].attrs["caption"]
        )),
    }  # fmt: skip


def _rates(results: Results) -> Table:
    """Return the largest exponent of each case on each span of time."""
    growth, rows = results[LYAPUNOV], []
    for name in map(str, growth["case"].values):
        case = growth.sel(case=name)
        rows.append([
            case_of(case), results.say(LYAPUNOV, "yes" if case["chaotic"] == 1 else "no"),
            *(results.quote(LYAPUNOV, float(rate)) for rate in case["exponent"]),
        ])  # fmt: skip
    spans = (f"exponent on {span}" for span in growth["span"].values)
    return Table(
        "Largest Lyapunov exponents per unit of τ, means over an ensemble",
        ["case", "chaotic", *spans], rows,
    )  # fmt: skip


def _trust_horizons(results: Results):
    """Return the figure of errors, and when the double next to a tenth becomes visible."""
    trust = results[TRUST]
    digits, seen = trust["decimal_horizon"].values
    return results.figure("trust_horizons", told(
        "Errors of the norms of each solver against τ. A mark on the dashed line shows when a "
        "solver leaves its reference; otherwise it stands at the end of the curve, and a case "
        "without a reference has an empty panel. The proven bound is how far a curve of "
        "polynomials can be from the true solution. At Ω = {omega} the solution that starts from "
        "the double next to the printed tenth is off by {size} of full scale at τ = {first} and by "
        "{visible} at τ = {seen}.",
        omega=number(float(results[PRINTED].attrs["omega"])),
        size=number(float(trust["decimal_size"][0])),
        first=results.quote_time(TRUST, float(digits)),
        visible=percent(float(trust["size"].sel(level="visible"))),
        seen=results.quote_time(TRUST, float(seen)),
    ))  # fmt: skip


SECTIONS = (Section("chaos", "Chaos, and until when a run can be trusted", gather),)
