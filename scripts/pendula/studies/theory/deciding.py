"""How the claims of this study name the checks that decide them, and the wrong statements."""

from collections.abc import Callable

from pendula.ledger.claim import Control, checks, claim
from pendula.ledger.cutoff import Cutoff

from .settings import WRONG_FOLDER

# ASSUME: an order in mu counts as a whole number if it is nearer to that than to another.
NEAR = Cutoff(0.5, "an order counts as the whole number to which it is nearest")
# ASSUME: what is said to grow with the chain, as C_N does in proportion to N, has an exponent of N
# nearer to one than to zero.
IN_PROPORTION = Cutoff(0.5, '"grows with N": nearer to proportion than to a constant')


def decides(place: str, says: str, *names: str, controls: tuple[Control, ...] = ()) -> Callable:
    """Return a decorator: the function, which takes these checks, decides the claim."""
    return claim(place, says, checks(*names), controls)


def wrong(says: str, *names: str, instead: str = "", confirms: bool = False) -> Control:
    """Return the control that feeds the wrong statement of each of these checks in its place.

    `instead` is the name of the wrong statement where it is not that of the check.
    """
    fed = {f"checks/{name}": f"checks/{WRONG_FOLDER}{instead or name}" for name in names}
    return Control(says, fed, confirms)
