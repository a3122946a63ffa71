"""What the report says of the threshold of the pendula."""

from typing import Any

from pendula.report.results import Results
from pendula.report.words import measured, number, percent

DATA = "pendula/threshold"
DIGITS = 12


def threshold(results: Results) -> dict[str, Any]:
    """Return thresholds as a table, and the picture."""
    data = results[DATA]
    mus = [float(mu) for mu in data["mu"].values]
    above, mu = float(data["omega"].max()), max(mus)
    share = data["gamma_0"].sel(omega=above, mu=mu) / data["gamma_0_lemma"].sel(omega=above)
    return {
        "above": results.quote(DATA, above),
        "largest_mu": results.quote(DATA, mu),
        "sites": results.quote(DATA, float(data.attrs["sites"])),
        "more": results.quote(DATA, float(_more_of_the_finite(data))),
        "share": results.say(DATA, percent(float(share))),
        "head": ["Ω", "γ₀ of Lemma 1", *(f"μ = {number(mu)}" for mu in mus)],
        "rows": [_row(results, float(omega)) for omega in _outside(data)],
        "picture": results.picture("pendula_threshold", _alt(data)),
    }


def _more_of_the_finite(data):
    """Return by how much the threshold of the finite chain is larger, at the most."""
    return (data["gamma_0_finite"] - data["gamma_0"]).sel(omega=_outside(data)).max()


def _outside(data) -> list[float]:
    return [float(one) for one in data["omega"].values[(data["gamma_0_lemma"] > 0).values]]


def _row(results: Results, omega: float) -> list:
    one = results[DATA].sel(omega=omega)
    exact = [results.say(DATA, measured(value, DIGITS)) for value in one["gamma_0"].values]
    return [number(omega), results.quote(DATA, float(one["gamma_0_lemma"])), *exact]


def _alt(data) -> str:
    """Describe the picture in words."""
    return (
        f"The threshold of the drive against the detuning for {data.sizes['mu']} values of mu "
        "beside Lemma 1; its distance from Lemma 1; and rates of growth against the drive."
    )
