"""Differences of a configuration from the one that the claims are about."""

from collections.abc import Callable, Iterable, Mapping
from typing import Any, NamedTuple


def in_short(differences: list[str]) -> str:
    """Return a clause with up to three differences and the number of the rest; empty for none."""
    if not differences:
        return ""
    more = f" and {len(differences) - 3} more" if len(differences) > 3 else ""
    return f"the configuration differs in {', '.join(differences[:3])}{more}"


def rests_on_nothing(name: str, on: tuple[str, ...] = ()) -> tuple[str, ...]:
    """Return no path: the default for projects without a configuration."""
    return ()


class Differences(NamedTuple):
    """Differences of a configuration from the paper's, and the keys that datasets depend on.

    `words` describes each difference by dotted path, such as {"cases.fig2_small.omega":
    "fig2_small.omega (1 in place of 8)"}. `rests_on(name, on)` returns the dotted paths of the keys
    that results/<name>.nc depends on. Unless `on` is empty, only cases and sweeps in `on` count.
    """

    words: Mapping[str, str] = {}
    rests_on: Callable[[str, tuple[str, ...]], Iterable[str]] = rests_on_nothing

    def concerning(self, names: Iterable[str], on: Iterable[str] = ()) -> dict[str, str]:
        """Return the differences that affect the datasets `names`, by dotted path."""
        paths = {path for name in names for path in self.rests_on(name, tuple(on))}
        return {
            place: words
            for place, words in self.words.items()
            if any(f"{place}.".startswith(f"{path}.") for path in paths)
            or any(path.startswith(f"{place}.") for path in paths)
        }

    def reason(self, names: Iterable[str], on: Iterable[str] = ()) -> str:
        """Return why the datasets `names` are not of the paper's cases; empty if they are."""
        return in_short(list(self.concerning(names, on).values()))


NO_DIFFERENCES = Differences()


class Tolerated(NamedTuple):
    """Keys of a configuration whose values may differ: freely, or only upwards or downwards."""

    free: frozenset[str] = frozenset()
    at_least: frozenset[str] = frozenset()
    at_most: frozenset[str] = frozenset()
    single: frozenset[str] = frozenset()
    """Keys with mappings that are compared as one value."""


def find_differences(
    accepted: Mapping[str, Any], configuration: Mapping[str, Any], tolerated: Tolerated
) -> dict[tuple[str, ...], tuple[Any, Any]]:
    """Return the accepted and the new value of each entry that differs, by its path.

    Additional sections and entries of the configuration do not count as differences.
    """
    differences: dict[tuple[str, ...], tuple[Any, Any]] = {}
    for section, entries in accepted.items():
        current = configuration.get(section)
        for name, value in entries.items():
            new = current.get(name, "absent") if isinstance(current, Mapping) else "absent"
            differences |= dict(_unlike(value, new, (section, name), tolerated))
    return differences


def _unlike(
    was: Any, now: Any, place: tuple[str, ...], tolerated: Tolerated
) -> Iterable[tuple[tuple[str, ...], tuple[Any, Any]]]:
    """Yield the places below `place` at which two values differ, with both values."""
    key = place[-1]
    if was == now or key in tolerated.free:
        return
    if isinstance(was, Mapping) and isinstance(now, Mapping) and key not in tolerated.single:
        if was.get("name") != now.get("name"):
            yield place, (was["name"], now["name"])
            return
        for inner in dict.fromkeys([*was, *now]):
            pair = was.get(inner, "absent"), now.get(inner, "absent")
            yield from _unlike(*pair, (*place, inner), tolerated)
    elif not (
        all(isinstance(value, int | float) for value in (was, now))
        and (
            (key in tolerated.at_least and now >= was) or (key in tolerated.at_most and now <= was)
        )
    ):
        yield place, (was, now)
