"""The rows of the claims ledger: every sentence of the paper that numbers can decide.

Each stands above the function that decides it, in one module for each part of the paper.
"""

from pendula.studies.chaos import claims as ensembles
from pendula.studies.paper import (
    claims_energy as energy,
)
from pendula.studies.paper import (
    claims_figure_2 as figure_2,
)
from pendula.studies.paper import (
    claims_figure_3 as figure_3,
)
from pendula.studies.paper import (
    claims_figure_4 as figure_4,
)
from pendula.studies.paper import (
    claims_figure_5 as figure_5,
)
from pendula.studies.paper import (
    claims_figure_6 as figure_6,
)
from pendula.studies.paper import (
    claims_second_solver as second_solver,
)
from pendula.studies.theory import (
    claims_lemmas as lemmas,
)
from pendula.studies.theory import (
    claims_section_2 as section_2,
)
from pendula.studies.theory import (
    claims_theorems as theorems,
)
from pendula.studies.unbounded import claims as unbounded

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
