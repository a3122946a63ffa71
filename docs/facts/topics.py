"""The facts of every topic that a template can name."""

import study_errors

from .baseline import Baseline
from .breathers import breathers, fates
from .certified import certified, proofs
from .chaos import chaos, ensembles, lifetimes
from .newton import pendula
from .paper import configured, hard_cases, ledger, mutation, references, second_solver, solvers
from .speed import full_run, pendula_speed, speed
from .theory import theory
from .unbounded import unbounded


def gather(baseline: Baseline, configuration: dict, chaos_study: dict) -> dict[str, dict]:
    """Return the facts of every topic; the last two are config.yaml and chaos.yaml as read."""
    topics = (
        ledger,
        solvers,
        second_solver,
        chaos,
        ensembles,
        lifetimes,
        breathers,
        fates,
        pendula,
        proofs,
        certified,
        unbounded,
        theory,
        references,
    )
    topics += (speed, pendula_speed, full_run, hard_cases, mutation)
    return {
        **{topic.__name__: topic(baseline) for topic in topics},
        **study_errors.facts(baseline),
        "configured": configured(configuration, chaos_study),
    }
