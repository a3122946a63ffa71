"""Decide every claim of the paper by the datasets at hand: the ledger, and a table to read."""

import json
from collections import Counter
from itertools import chain
from pathlib import Path

from pendula.datasets import complete_or_absent
from pendula.datasets.checks import broken, deciding, describe
from pendula.datasets.netcdf import read
from pendula.ledger.claim import controls_of, cutoff_lines, evaluate, needed
from pendula.ledger.criterion import named
from pendula.report.words import markdown, write_markdown
from pendula.studies.theory.settings import WRONG_FOLDER


def decide_claims(
    datasets: list[str],
    names: list[str],
    makers: dict[str, str],
    differs: dict[str, str],
    ledger: str,
    controls: str,
    table: str,
) -> None:
    """Write the ledger and its controls as JSON, and both as Markdown, in the order of the paper.

    `names` are those of `datasets` as the claims know them, `makers` the rule that makes each.
    `differs` says where the configuration is not the paper's, as `configuration.paper` finds it.
    """
    absent = set(needed()) - set(names)
    if absent:
        raise ValueError(f"the claims rest on {', '.join(sorted(absent))}: not inputs of this job")
    sources = {name: read(path) for name, path in zip(names, datasets, strict=True)}
    rows = [row | {"rules": rules_of(row, makers)} for row in evaluate(sources, differs)]
    asked = [name for name in sources if name.startswith("checks/") and WRONG_FOLDER not in name]
    checks = {name: sources[name].to_dict() for name in asked}
    fed = controls_of(rows)
    write(ledger, rows)
    write(controls, fed)
    sections = claims_section(rows), cutoffs_section(rows), controls_section(fed)
    write_markdown(table, *chain(*sections), *checks_section(checks))
    print(", ".join(f"{count} {verdict}" for verdict, count in tally(rows).items()))
    asked = [one["passes"] for one in fed if one["passes"] is not None]
    print(f"{sum(asked)} of {len(asked)} controls came out as they must")
    for name, check in checks.items():
        if broken(check):
            print(describe(name.removeprefix("checks/"), check))


def write(path: str, rows: list[dict]) -> None:
    text = json.dumps(rows, indent=1, ensure_ascii=False, allow_nan=False)
    with complete_or_absent(path) as partial:
        Path(partial).write_text(f"{text}\n", encoding="utf-8")


def rules_of(row: dict, makers: dict[str, str]) -> list[str]:
    """Return the rules whose datasets decide a row."""
    return list(dict.fromkeys(makers[name] for name in row["decided_by"]))


def tally(rows: list[dict]) -> dict[str, int]:
    """Return how many rows have each verdict."""
    counts = Counter(row["verdict"] for row in rows)
    return {str(verdict): counts[verdict] for verdict in named(counts)}


def claims_section(rows: list[dict]) -> list[str]:
    """Return the claims with their verdicts and what these rest on."""
    counts = "\n".join(f"- {verdict}: {count}" for verdict, count in tally(rows).items())
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


def checks_section(checks: dict[str, dict]) -> list[str]:
    """Return every number that a check is held to, beside its tolerance."""
    rows = []
    for name, check in checks.items():
        faults = broken(check)
        for variable, (worst, limit) in deciding(check).items():
            title = f"{variable}: {check['data_vars'][variable]['attrs']['long_name']}"
            holds = "NO" if variable in faults else "yes"
            rows.append(
                (name.removeprefix("checks/"), title, f"{worst:.3g}", f"{limit:.10g}", holds)
            )
    head = ("check", "quantity", "largest", "tolerance", "holds")
    return ["# The checks", markdown(head, rows)]


if __name__ == "__main__":
    from job import run

    run(decide_claims, snakemake)  # noqa: F821
