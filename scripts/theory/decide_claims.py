"""Decide every claim of the paper by the datasets at hand: the ledger, and a table to read."""

import json
from collections import Counter
from pathlib import Path

from pendula.datasets import complete_or_absent
from pendula.datasets.checks import broken, deciding, describe
from pendula.datasets.netcdf import read
from pendula.ledger.claim import evaluate, needed
from pendula.ledger.criterion import Verdict
from pendula.report.words import markdown, write_markdown


def decide_claims(
    datasets: list[str], names: list[str], makers: dict[str, str], ledger: str, table: str
) -> None:
    """Write the ledger as JSON and as Markdown, in the order of the paper.

    `names` are those of `datasets` as the claims know them, `makers` the rule that makes each.
    """
    absent = set(needed()) - set(names)
    if absent:
        raise ValueError(f"the claims rest on {', '.join(sorted(absent))}: not inputs of this job")
    sources = {name: read(path) for name, path in zip(names, datasets, strict=True)}
    rows = [row | {"rules": rules_of(row, makers)} for row in evaluate(sources)]
    checks = {name: ds.to_dict() for name, ds in sources.items() if name.startswith("checks/")}
    write(ledger, json.dumps(rows, indent=1, ensure_ascii=False, allow_nan=False))
    write_markdown(table, *claims_section(rows), *checks_section(checks))
    print(", ".join(f"{count} {verdict}" for verdict, count in tally(rows).items()))
    for name, check in checks.items():
        if broken(check):
            print(describe(name.removeprefix("checks/"), check))


def write(path: str, text: str) -> None:
    with complete_or_absent(path) as partial:
        Path(partial).write_text(f"{text}\n", encoding="utf-8")


def rules_of(row: dict, makers: dict[str, str]) -> list[str]:
    """Return the rules whose datasets decide a row."""
    return list(dict.fromkeys(makers[name] for name in row["decided_by"]))


def tally(rows: list[dict]) -> dict[str, int]:
    """Return how many rows have each verdict, every verdict named."""
    counts = Counter(row["verdict"] for row in rows)
    return {str(verdict): counts[verdict] for verdict in Verdict}


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
