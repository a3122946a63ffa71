"""Decide the claims of the studies."""

from replication.ledger import decide
from replication.ledger.claim import Claim, claims_of

from pendula.configuration.paper import from_paper
from pendula.studies import modules_with_prefix


def all_claims(*prefixes: str) -> tuple[Claim, ...]:
    """Return the claims of all studies, in the order of the paper's sections.

    `prefixes`, such as "theory/claims" and "paper/claims_norms", restrict them to modules whose
    names begin with one of these. Raises ValueError if no module begins with a prefix.
    """
    modules = []
    for prefix in prefixes or ("claims",):
        named = list(modules_with_prefix(prefix))
        if not named:
            raise ValueError(f"no study has a module that begins with {prefix}")
        modules += named
    return claims_of(modules)


def decide_claims(
    datasets: list[str], names: list[str], modules: list[str], differs: dict[str, str], part: str
) -> None:
    """Write the rows of the ledger on the claims in `modules` of studies into the file `part`.

    `names` are the claims' names for `datasets`, in the same order. `differs` holds the differences
    of the configuration from the paper's.
    """
    decide.decide_claims(all_claims(*modules), datasets, names, part, from_paper(differs))
