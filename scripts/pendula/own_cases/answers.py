"""The checks of a user's case as questions and answers."""

import numpy as np
import xarray as xr
from latticode.checks import LOCALISED, UNSTABLE_REST
from latticode.datasets.registry import SOLVER_NAMES
from latticode.measures.difference import VISIBLE
from replication.words import number, percent

from pendula.problem import PENDULA

# ASSUME: a bound is violated if the norms exceed it by more than their error and more than SLACK.
SLACK = 1e-6
TOO_LARGE = "violated: the errors of the run are too large"
Answers = list[tuple[str, str]]


def answer_questions(checks: xr.Dataset, moves: bool) -> Answers:
    """Return questions on a case, with answers; `moves` is False if all sites stay at rest."""
    if checks.attrs.get("model") == PENDULA:
        specific, at_rest = _answer_for_pendula, []
    elif "model_text" in checks.attrs:
        specific, at_rest = _answer_for_model, []
    else:
        specific, at_rest = _answer_for_amplitudes, _answer_lemma_1(checks)
    if UNSTABLE_REST in checks.attrs:
        at_rest.append(("sites at rest", checks.attrs[UNSTABLE_REST]))
    if not moves:
        return [("motion", "the chain is at rest and stays so"), *at_rest]
    return [_answer_agreement(checks), *at_rest, *specific(checks)]


def _answer_agreement(checks: xr.Dataset) -> tuple[str, str]:
    """Return until when the run agrees with one by another method."""
    question = f"agrees with {SOLVER_NAMES[str(checks.attrs['second_name'])]}"
    if reason := checks.attrs.get("second_refusal"):
        return question, f"unknown: that run was rejected, {reason}"
    level, parted = percent(VISIBLE), float(checks["divergence_time"])
    if not np.isfinite(parted):
        return question, f"to the end, to {number(checks['largest_difference'])} of full scale"
    if checks.attrs.get("model") == PENDULA:
        then = "afterwards each run may show another motion of the same kind"
    elif checks.get("chaotic", 0):
        then = "afterwards the run is one random sample: use its statistics only"
    else:
        then = "the motion is not chaotic, so a smaller tolerance or step gives a later time"
    return question, f"until τ = {number(parted, 4)}, within {level} of full scale; {then}"


def _answer_for_pendula(checks: xr.Dataset) -> Answers:
    over, followed = (
        bool(np.isfinite(checks[name])) for name in ("over_the_top", "expansion_error")
    )
    top = "yes: afterwards the expansion (3) and the amplitude equations (4) do not apply"
    return [
        ("a pendulum has gone over the top", top if over else "no"),
        ("the expansion (3) could be followed", "yes" if followed else "no"),
    ]


def _answer_for_model(checks: xr.Dataset) -> Answers:
    drifts = checks.get("conserved_drift", [])
    return [
        _answer_chaos(checks),
        ("a localised state", describe_localised_state(checks)),
        *(
            (f"largest relative change of {drift['conserved_quantity'].item()}", number(drift))
            for drift in drifts
        ),
    ]


def describe_localised_state(checks: xr.Dataset) -> str:
    """Return a description of the localised state of a model, or the reason why there is none."""
    if reason := checks.attrs.get("breather_refusal"):
        return f"none: {reason}"
    frequency, growth = (float(checks[f"breather_{name}"]) for name in ("frequency", "growth"))
    state = f"turns at the frequency {number(frequency)}" if frequency else "is steady"
    if checks["breather_end"] > LOCALISED:
        return f"{state}, but reaches the ends of the chain"
    grows = f"a perturbation grows at the rate {number(growth)}"
    return f"{state}; {grows if growth else 'no perturbation grows'}"


def _answer_chaos(checks: xr.Dataset) -> tuple[str, str]:
    lost = checks.attrs.get("sensitivity_refusal", "")
    return "chaotic", f"unknown: {lost}" if lost else "yes" if checks["chaotic"] else "no"


def _answer_lemma_1(checks: xr.Dataset) -> Answers:
    """Return whether the chain at rest is stable. If epsilon < 0, name the chain that is meant."""
    stable = {True: "unstable", False: "no growing mode"}
    rows = [
        ("Lemma 1, infinite chain at rest", stable[bool(checks["infinite_rate"] > 0)]),
        ("Lemma 1, this chain at rest", stable[bool(checks["finite_rate"] > 0)]),
    ]
    if checks.attrs["epsilon"] < 0:
        rows.append(
            (
                "ε < 0",
                "the statements are about the equivalent chain with −ε and Ω − 4ε, "
                "where every second site has the opposite sign",
            )
        )
    return rows


def _answer_for_amplitudes(checks: xr.Dataset) -> Answers:
    error = np.nan_to_num(float(checks["largest_difference"]))
    limit = 1.0 + max(SLACK, 4.0 * error)  # P is a square, and both of its values have errors
    growth, bound = (
        "holds" if checks[name] <= limit else TOO_LARGE for name in ("from_start", "ratio")
    )
    region = str(checks["region"].values)
    covered = "only Theorem 3 covers" if region == "none" else f"{region.capitalize()} covers"
    return [
        _answer_chaos(checks),
        ("Lemma 2, growth of P", growth),
        ("Theorems 1 to 3, these initial conditions", f"{covered} them"),
        ("the smallest bound of these theorems", bound),
    ]
