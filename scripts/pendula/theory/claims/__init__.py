"""The rows of the claims ledger: every sentence of the paper that numbers can decide.

Each stands above the function that decides it, in one module for each part of the paper.
"""

from . import (
    energy,
    ensembles,
    figure_2,
    figure_3,
    figure_4,
    figure_5,
    figure_6,
    lemmas,
    second_solver,
    section_2,
    theorems,
    unbounded,
)

PARTS = (
    section_2,
    lemmas,
    theorems,
    energy,
    figure_2,
    figure_3,
    figure_4,
    figure_5,
    figure_6,
    ensembles,
    second_solver,
    unbounded,
)

CLAIMS = tuple(
    function.claim
    for part in PARTS
    for function in vars(part).values()
    if hasattr(function, "claim")
)
