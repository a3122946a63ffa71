"""Where a configuration differs from the one that the claims are about."""

from collections.abc import Mapping

Differences = Mapping[str, str]
"""By dotted path, in words, such as {"cases.fig2_small.omega": "fig2_small.omega (1 in place of
8)"}."""


def in_short(differences: list[str]) -> str:
    """Return some differences as half a sentence; an empty text where there are none."""
    if not differences:
        return ""
    more = f" and {len(differences) - 3} more" if len(differences) > 3 else ""
    return f"the configuration differs in {', '.join(differences[:3])}{more}"
