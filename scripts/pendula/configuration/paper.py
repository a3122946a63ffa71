"""The configuration that the claims are about: what each dataset rests on, and what differs.

Users may edit every case. Sentences on the paper's figures are then no longer about what was run,
and must not be judged by it. The file beside this module, paper.json, holds the cases, the sweeps
and the studies' choices as this project reads the paper. It stays as it is when config/*.yaml are
edited; `python docs/keep.py config` renews it, and a test fails where the committed files differ.
"""

import json
from collections.abc import Iterable, Mapping
from functools import cache
from pathlib import Path
from typing import Any

FILE = Path(__file__).with_suffix(".json")

FREE = {
    *("seed", "draw", "snapshot_step", "long"),
    *("count", "samples", "sites", "points"),
}
"""Keys that change no statement: other draws of a case, another look at it, longer studies, and how
thoroughly the theory is tried on data of all kinds. Its controls find a test that is too weak."""
AT_LEAST = {"members", "swept_members", "nodes"}
"""Sizes of ensembles and grids: larger ones are still about the same case."""
AT_MOST = {"tolerance"}
"""Smaller values are still about the same case."""

EQUATION = ("model", "epsilon", "gamma", "omega")
DATA = (*EQUATION, "initial")
CHAIN = (*DATA, "boundary", "output_step")
FINITE = (*CHAIN, "half_width")
"""What of a case decides a solution: on an infinite chain, on swept chains, on its own chain."""

Differences = Mapping[str, str]
"""By dotted path, in words, such as {"cases.fig2_small.omega": "fig2_small.omega (1 in place of
8)"}."""


@cache
def paper() -> dict[str, Any]:
    """Return the paper's configuration as plain values."""
    return json.loads(FILE.read_text(encoding="utf-8"))


def differences(configuration: Mapping[str, Any]) -> dict[str, str]:
    """Return where a validated configuration, as plain values, differs from the paper's.

    Cases and sweeps beside the paper's are no difference.
    """
    found: dict[str, str] = {}
    for section, of_paper in paper().items():
        own = configuration.get(section)
        for name, value in of_paper.items():
            path = (section, name)
            now = own.get(name, "absent") if isinstance(own, Mapping) else "absent"
            for place, pair in _unlike(value, now, path):
                found[".".join(place)] = _in_words(place, *pair)
    return found


def _unlike(was: Any, now: Any, place: tuple) -> Iterable[tuple[tuple, tuple]]:
    """Yield the places below `place` at which two values differ, with both values."""
    key = place[-1]
    if was == now or key in FREE:
        return
    if isinstance(was, Mapping) and isinstance(now, Mapping) and key != "initial":
        if was.get("name") != now.get("name"):
            yield place, (was["name"], now["name"])
            return
        for inner in dict.fromkeys([*was, *now]):
            pair = (one.get(inner, "absent") for one in (was, now))
            yield from _unlike(*pair, (*place, inner))
    elif not (
        all(isinstance(value, int | float) for value in (was, now))
        and ((key in AT_LEAST and now >= was) or (key in AT_MOST and now <= was))
    ):
        yield place, (was, now)


def _in_words(place: tuple, was: Any, now: Any) -> str:
    shown = place[1:] if place[0] in ("cases", "sweeps") else place
    short, of_paper = _short(now), _short(was)
    told = str(now) if short == of_paper else short  # else they seem the same
    return f"{'.'.join(shown)} ({told} in place of {of_paper})"


def _short(value: Any) -> str:
    if isinstance(value, float):
        return f"{value:g}"
    if value is None:
        return "none"
    if isinstance(value, Mapping) and "name" in value:
        return str(value["name"])
    if isinstance(value, Mapping):
        sites = (f"{site}: {_short(pair)}" for site, pair in value.items())
        return f"{{{', '.join(sites)}}}"
    if isinstance(value, list):
        text = f"[{', '.join(map(_short, value))}]"
        return text if len(text) <= 50 else f"{len(value)} values from {_short(value[0])}"
    return "0" if str(value) == "0j" else str(value).removesuffix("+0j")


def reason(differs: Differences, names: Iterable[str], on: Iterable[str] = ()) -> str:
    """Return why datasets are not about the paper's cases; an empty text where they are.

    `names` are paths below results/ without their ending. `on` names cases and sweeps where a
    statement is about some alone of all that a dataset of many holds.
    """
    return in_short(list(concerning(differs, names, on).values()))


def in_short(said: list[str]) -> str:
    """Return some differences as half a sentence; an empty text where there are none."""
    if not said:
        return ""
    more = f" and {len(said) - 3} more" if len(said) > 3 else ""
    return f"the configuration differs in {', '.join(said[:3])}{more}"


def concerning(
    differs: Differences, names: Iterable[str], on: Iterable[str] = ()
) -> dict[str, str]:
    """Return the differences that the datasets called `names` rest on, as `reason` takes them."""
    paths = {path for name in names for path in rests_on(name, tuple(on))}
    return {
        place: words
        for place, words in differs.items()
        if any(f"{place}.".startswith(f"{path}.") for path in paths)
        or any(path.startswith(f"{place}.") for path in paths)
    }


# --- What datasets rest on ------------------------------------------------------------------------


@cache
def rests_on(name: str, on: tuple[str, ...] = ()) -> tuple[str, ...]:
    """Return the parts of the configuration that decide a dataset, as dotted paths.

    `on` leaves of a check of many cases and sweeps these alone.
    """
    folder, _, rest = name.partition("/")
    stem, _, solver = rest.partition(".")
    if folder == "trajectories":
        by = f"solvers.{solver}" if solver else f"cases.{stem}.solver"
        return (*_keys(stem, *FINITE, "end_time"), by)
    if folder == "sweeps":
        return _sweep(stem, solver.partition(".")[0])
    of_studies = {"breathers": _breathers, "pendula": _pendula, "certified": _certified}
    return (of_studies | {"unbounded": _unbounded}).get(folder, _check)(rest, on)


def _keys(case: str, *keys: str) -> tuple[str, ...]:
    return tuple(f"cases.{case}.{key}" for key in keys)


def _sweep(name: str, solver: str = "") -> tuple[str, ...]:
    by = f"solvers.{solver}" if solver else f"cases.{paper()['sweeps'][name]['case']}.solver"
    return (*_swept(name), by, f"sweeps.{name}.solver")


def _swept(name: str) -> tuple[str, ...]:
    own = tuple(f"sweeps.{name}.{key}" for key in ("case", "half_widths", "windows"))
    return (*own, *_keys(paper()["sweeps"][name]["case"], *CHAIN))


def _unbounded(name: str, on: tuple[str, ...] = ()) -> tuple[str, ...]:
    given = paper()["unbounded"]
    shared = ("output_step", "perturbation", "short.solver", "short.rest")
    if name == "thermal":
        own = tuple(f"unbounded.{key}" for key in ("omegas", "nodes"))
        return (*own, *_keys(given["omegas"]["case"], *EQUATION))
    if name in ("growth", "fronts"):
        runs = (*given["cases"], "omegas", "transverse", "thermal")
        return tuple(dict.fromkeys(path for run in runs for path in _unbounded(run)))
    whole = tuple(f"unbounded.{key}" for key in (*shared, f"short.runs.{name}"))
    if name in given["cases"]:
        return (*whole, *_keys(name, *DATA))
    return (*whole, "unbounded.omegas", *_keys(given["omegas"]["case"], *DATA))


MAPS = "the maps"
"""What a statement on fates is on that looks at the maps alone, and at no case of the paper."""


def _breathers(name: str, on: tuple[str, ...]) -> tuple[str, ...]:
    """Return what a part of the study of breathers rests on, but for its longer variant.

    Fates are compared with periodic breathers; those of the paper's data rest on its cases. `on`
    leaves some of these alone, and with MAPS none.
    """
    given = paper()["breathers"]
    parts = (name, "periodic") if name == "fates" else (name,)
    followed = [case for case in paper()["cases"] if name == "fates" and (not on or case in on)]
    own = tuple(f"breathers.{part}.{key}" for part in parts for key in given[part] if key != "long")
    cases = [case for case in (given[name].get("case"), *followed) if case]
    return ("breathers.epsilon", "breathers.gamma", *own, *_of_all(cases, *FINITE))


def _pendula(name: str, on: tuple[str, ...]) -> tuple[str, ...]:
    """Return what a part of the study of the pendula rests on, but for its longer variant.

    `on` leaves of a part that runs many cases these alone.
    """
    given = paper()["pendula"][name]
    own = tuple(f"pendula.{name}.{key}" for key in given if key not in ("long", "case"))
    if "case" in given:
        return (*own, *_keys(given["case"], *FINITE))
    cases = (on or paper()["cases"]) if name == "remainder" else ()
    return (*own, *(key for case in cases for key in _keys(case, *FINITE)))


def _certified(name: str, on: tuple[str, ...]) -> tuple[str, ...]:
    """Return what a proof rests on: its states or case, or what asks it about a wrong one."""
    given = paper()["certified"]
    wrong = given["curves"]["wrong"]
    if name == "breathers":
        return tuple(f"certified.breathers.{key}" for key in given["breathers"])
    if name == "wrong/curve":
        return ("certified.curves.wrong", *_keys(wrong["case"], *FINITE))
    return _keys(name, *FINITE, "end_time")


def _check(name: str, on: tuple[str, ...]) -> tuple[str, ...]:
    """Return what a check rests on; those of the theory have a key of their own each."""
    given, theory = paper()["chaos"], paper()["theory"]
    cases = [case for case in paper()["cases"] if not on or case in on]
    swept = [sweep for sweep in paper()["sweeps"] if not on or sweep in on]
    if name in theory:
        return (f"theory.{name}",)
    if name.startswith("ensemble"):
        ensemble = given["ensembles"]
        cases = [case for case in cases if case in ensemble["cases"]]
        swept = [sweep for sweep in swept if sweep in ensemble["sweeps"]]
        of_sweeps = tuple(path for sweep in swept for path in _swept(sweep))
        return ("chaos.ensembles", *of_sweeps, *_of_all(cases, *FINITE, "end_time"))
    runs = _of_all(cases, *FINITE, "end_time")
    lives = _keys(given["lifetimes"]["case"], *EQUATION, "boundary", "half_width")
    return {
        "lifetimes": ("chaos.lifetimes", *lives),
        "members": ("chaos.members", *_of_all(cases, *FINITE)),
        "lyapunov": ("chaos.lyapunov", *runs),
        **dict.fromkeys(("solvers", "trust"), ("solvers", *runs)),
        "cases": _of_all(cases, *FINITE, "end_time", "solver"),
    }.get(name, ())


def _of_all(cases: Iterable[str], *keys: str) -> tuple[str, ...]:
    return tuple(path for case in cases for path in _keys(case, *keys))
