"""The ledger as a file, and as tables to read: claims, cut-offs, controls, and their checks."""

import json
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from pendula.datasets import complete_or_absent
from pendula.datasets.checks import broken, deciding
from pendula.report.words import markdown

from .claim import controls_of, cutoff_lines
from .rows import tally


def write_json(path: str, content: Any) -> None:
    """Write rows of the ledger, or a part of it."""
    text = json.dumps(content, indent=1, ensure_ascii=False, allow_nan=False)
    with complete_or_absent(path) as partial:
        Path(partial).write_text(f"{text}\n", encoding="utf-8")


def tables(rows: list[dict], checks: Iterable[list]) -> list[str]:
    """Return the parts of a page on these rows of the ledger and these lines of checks."""
    return [
        *claims_section(rows),
        *cutoffs_section(rows),
        *controls_section(controls_of(rows)),
        *checks_section(checks),
    ]


def in_short(rows: list[dict]) -> str:
    """Return how many rows have each verdict, and how many controls came out as they must."""
    asked = [one["passes"] for one in controls_of(rows) if one["passes"] is not None]
    controls = f"{sum(asked)} of {len(asked)} controls came out as they must"
    return "\n".join([*counted(rows), controls])


def counted(rows: list[dict]) -> list[str]:
    """Return a line for each origin of claims: how many there are, and with which verdicts."""
    return [
        f"{sum(verdicts.values())} claims {origin}: "
        + ", ".join(f"{count} {verdict}" for verdict, count in verdicts.items())
        for origin, verdicts in tally(rows).items()
    ]


def claims_section(rows: list[dict]) -> list[str]:
    """Return the claims with their verdicts and what these rest on."""
    counts = "\n".join(f"- {line}" for line in counted(rows))
    head = ("where", "claim", "verdict", "measured", "criterion", "because", "data")
    cells = [
        (
            *(row[key] for key in ("place", "says", "verdict")),
            ", ".join(f"{key} = {shown(value)}" for key, value in row["measured"].items()),
            *(row[key] for key in ("criterion", "because")),
            ", ".join(row["decided_by"]),
        )
        for row in rows
    ]
    return ["# What the paper says, and what the numbers say", counts, markdown(head, cells)]


def shown(value: float | str) -> str:
    """Return a measured number with four digits."""
    return value if isinstance(value, str) else f"{value:.4g}"


def cutoffs_section(rows: list[dict]) -> list[str]:
    """Return every cut-off with its origin, the claims that read it, and those that rest on it."""
    head = ("cut-off", "where it comes from", "decides", "rest on it")
    return ["# The cut-offs, each moved by a third either way", markdown(head, cutoff_lines(rows))]


def controls_section(controls: list[dict]) -> list[str]:
    """Return what every deciding function said of the wrong cases that it was fed."""
    keys = ("claim", "fed", "must", "verdict", "because")
    words = {True: "yes", False: "NO", None: "not asked"}
    lines = [(*(one[key] for key in keys), words[one["passes"]]) for one in controls]
    head = ("claim", "its function was fed", "must", "verdict", "because", "as it must")
    return ["# The controls", markdown(head, lines)]


def check_lines(checks: Mapping[str, dict]) -> dict[str, list[list[str]]]:
    """Return by check a line for every number that it is held to, with its tolerance."""
    lines: dict[str, list[list[str]]] = {}
    for name, check in checks.items():
        faults, own = broken(check), name.removeprefix("checks/")
        lines[name] = []
        for variable, (worst, limit) in deciding(check).items():
            title = f"{variable}: {check['data_vars'][variable]['attrs']['long_name']}"
            holds = "NO" if variable in faults else "yes"
            lines[name].append([own, title, f"{worst:.3g}", f"{limit:.10g}", holds])
    return lines


def checks_section(lines: Iterable[list]) -> list[str]:
    """Return every number that a check is held to, beside its tolerance."""
    head = ("check", "quantity", "largest", "tolerance", "holds")
    return ["# The checks", markdown(head, lines)]
