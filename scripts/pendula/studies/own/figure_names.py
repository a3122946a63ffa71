"""What the figures of one's own cases are labelled with: every parameter of the case."""

from collections.abc import Mapping

from pendula.drawing import style

ENDS = {"dirichlet": "ends at rest", "free": "free ends", "periodic": "ring"}
LONGEST = 46
"""Characters of a formula that leave room for the rest of a title."""


def name_parameters(attributes: Mapping) -> str:
    """Return the constants of the equations, and the half-width where there is but one."""
    symbols = {"omega": r"\Omega", "gamma": r"\gamma", "epsilon": r"\epsilon", "half_width": "M"}
    known = {symbol: attributes[key] for key, symbol in symbols.items() if key in attributes}
    return ",  ".join(f"${symbol} = {float(value):.4g}$" for symbol, value in known.items())


def name_data(attributes: Mapping) -> str:
    """Return the initial data, where they fit into the title of a panel."""
    named = style.name_initial(attributes["initial"])
    return named if len(named) <= LONGEST else "data on 1 site"


def name_data_and_ends(attributes: Mapping) -> str:
    """Return the initial data and the kind of ends."""
    return f"{name_data(attributes)},  {ENDS[attributes['boundary']]}"
