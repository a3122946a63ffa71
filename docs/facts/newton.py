"""Facts on Newton's equations of the pendula, and on how far the amplitude equations hold."""

import numpy as np
import xarray as xr
from pendula.report.words import measured, number, percent
from pendula.studies.pendula.claims_phases import pendula_norms
from pendula.studies.pendula.claims_remainder import STABLE, UNSTABLE, common_end

from .baseline import Baseline
from .words import with_limits


def pendula(baseline: Baseline) -> dict:
    """Return what Lemma 1 is for the pendula themselves, at the paper's detunings."""
    data = baseline["pendula/threshold"]
    largest = float(data["mu"].max())
    norms = pendula_norms(baseline["pendula/phases"]).measured
    return {
        **_passages(baseline["quoted/pendula"]),
        "norms_mu": number(norms["at_mu"]),
        "orders": f"{number(norms['least_order'])} to {number(norms['largest_order'])}",
        "largest_mu": number(largest),
        "second_low": number(data["resonance_low"].sel(mu=largest)),
        "second_high": number(data["resonance_high"].sel(mu=largest)),
        "rows": [
            {"mu": number(mu), **{side: measured(data["gamma_0"].sel(omega=omega, mu=mu), 12)
                                  for side, omega in (("below", -4.0), ("above", 8.0))}}
            for mu in data["mu"].values
        ],
        **_expansion(baseline["pendula/remainder"]),
        **_parting(baseline["pendula/remainder"], baseline["checks/lyapunov"]),
    }  # fmt: skip


def _passages(long: xr.Dataset) -> dict:
    """Return who goes over the top in the long study, and how the angles grow then."""
    return {
        "end": number(long.attrs["end_time"]),
        "passing_members": number(long.attrs["members"]),
        "passages": [
            {
                "mu": number(mu, 4),
                "share": with_limits(long.sel(mu=mu), "passed", percent),
                "median": _median(float(long["passage_median"].sel(mu=mu))),
                "rate": with_limits(long.sel(mu=mu), "passage_rate", lambda one: number(one, 2)),
                "turns": number(long["turns"].sel(mu=mu)),
            }
            for mu in long["mu"].values
        ],
    }


def _median(tau: float) -> str:
    return number(tau) if np.isfinite(tau) else "later"


def _expansion(data: xr.Dataset) -> dict[str, str]:
    """Return orders in mu of the error of the expansion, and from when on it is visible."""
    end = common_end(data)
    there = data.sel(case=list(STABLE), end=end)
    constant = there["error_constant"].sel(expansion="leading")
    visible = data["visible_from"].sel(expansion="leading", case=UNSTABLE)
    times = visible.where(np.isfinite(visible), drop=True)
    early, late = times.sel(mu=EARLY_MU), times[-1]
    return {
        **{name: number(there["order"].sel(expansion=name).mean())
           for name in ("leading", "corrected")},
        "common_end": number(end),
        "least_constant": number(constant.min()),
        "largest_constant": number(constant.max()),
        "early_mu": number(early["mu"]),
        "visible_early": number(early),
        "late_mu": number(late["mu"]),
        "visible_late": number(late),
    }  # fmt: skip


def _parting(data: xr.Dataset, lyapunov: xr.Dataset) -> dict[str, str]:
    """Return how the expansion of large data parts from the pendula: by its phase, or by chaos."""
    end, mu = common_end(data), float(data["mu"].min())
    large = data.sel(case="fig2_large", mu=mu, end=end)
    phase = large["error"].sel(expansion="leading") / large["largest_angle"]
    drift = float(phase) / (mu * mu * end)
    return {
        "drift": number(drift, 2),
        "paper_end": number(PAPER_END),
        "drift_mu": number((drift * PAPER_END) ** -0.5, 2),
        "chaotic_exponent": number(lyapunov["exponent"].sel(case="fig3_large").max(), 2),
    }


PAPER_END = 50.0
"""End of the runs of the paper's figures, and of `snakemake remainder`."""
EARLY_MU = 0.1
"""The mu from which on the horizon at Omega = 0 is told."""
