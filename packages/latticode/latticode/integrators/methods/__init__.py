"""The methods of the library, each in a file of its own. To add one, import it here."""

from ..method import Method
from .crank_nicolson import CrankNicolson as CrankNicolson
from .crank_nicolson import DelfourFortinPayre as DelfourFortinPayre
from .dop853 import Dop853 as Dop853
from .kahan_li import KahanLi as KahanLi
from .ode45 import Ode45 as Ode45
from .ode45 import Ode45Real
from .taylor import Taylor as Taylor


def _rank(method: Method) -> tuple[bool, int]:
    return method.tightest is None, -method.order


_CLASSES = [
    kind
    for kind in globals().values()
    if isinstance(kind, type) and kind not in (Method, Ode45Real)
]
METHODS: dict[str, Method] = {
    method.name: method for method in sorted((kind() for kind in _CLASSES), key=_rank)
}
"""All methods by name: first those that control their error, and of these the highest order."""


def methods_taking(model) -> list[str]:
    """Return the names of the methods that integrate the equations of a traced model."""
    return [name for name, method in METHODS.items() if method.integrates(model)]


NAMED = METHODS | {Ode45Real.name: Ode45Real()}
"""These, and the variant that only a program can build: all that figures may have to name."""
