"""Which checks share a job: starting one costs more than most checks.

Apart from the catalogue, so that the workflow can read it without importing the checks.
"""

GROUPS = {
    "equations": (
        # Section 2
        *("gradient", "symmetries", "opposite", "pt_form", "conservation", "expansion"),
        # errors and gaps of the paper
        *("theorem_3_constant", "theorem_2_case", "negative_depth", "energy_drift", "not_shown"),
    ),
    "stability": (
        *("dispersion", "chart", "short_chart"),
        *("windows", "measured_windows", "threshold"),
    ),
    "bounds": ("balance", "growth", "inequalities", "samples", "worst"),
}
OBSERVED = ("cases", "sweeps")
"""The checks of the paper's own trajectories and sweeps, which need their datasets."""
