"""The methods of the library, one in each file. To add a method, import it here."""

from latticode.equations.model import Model

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
    if isinstance(kind, type) and issubclass(kind, Method) and kind not in (Method, Ode45Real)
]
METHODS: dict[str, Method] = {
    method.name: method for method in sorted((kind() for kind in _CLASSES), key=_rank)
}
"""All methods by name: those with error control first, in each group the highest order first."""


def methods_taking(model: Model) -> list[str]:
    """Return the names of the methods that integrate the equations of a traced model."""
    return [name for name, method in METHODS.items() if method.integrates(model)]


NAMED = METHODS | {Ode45Real.name: Ode45Real()}
"""METHODS and `ode45_real`, which only programs can choose: all methods that figures may show."""
