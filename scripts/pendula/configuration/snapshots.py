"""How often a run keeps the whole chain, where a case leaves that to the picture."""

FEWEST = 200
"""Snapshots that make a smooth picture; fewer than twice as many are kept."""
MOST_NUMBERS = 20_000_000
"""Moduli in memory at once: very long chains have fewer snapshots."""


def choose_every(outputs: int, sites: int) -> int:
    """Return how many output steps lie between snapshots, for a run of `outputs` steps."""
    wanted = max(1, min(FEWEST, MOST_NUMBERS // (2 * sites)))
    return max(1, outputs // wanted)
