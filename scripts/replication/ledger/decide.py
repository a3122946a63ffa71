"""Decide the claims of a part of the ledger by datasets, join the parts, and write their table."""

from latticode.datasets.json_files import load_json, write_json
from latticode.datasets.netcdf import read

from replication.report.words import markdown, write_markdown

from .rows import counted
from .verdicts import evaluate, needed


def decide_claims(
    datasets: list[str], names: list[str], modules: list[str], differs: dict[str, str], part: str
) -> None:
    """Write the rows of the ledger on the claims in `modules`.

    `names` are those that the claims have for `datasets`, in their order. `differs` says where the
    configuration is not the paper's, as `configuration.paper` finds it.
    """
    if absent := set(needed(*modules)) - set(names):
        raise ValueError(f"the claims rest on {', '.join(sorted(absent))}: not inputs of this job")
    sources = {name: read(path) for name, path in zip(names, datasets, strict=True)}
    rows = evaluate(sources, differs, modules)
    write_json(part, {"rows": rows})
    print(*counted(rows), sep="\n")


def join_claims(parts: list[str], ledger: str, table: str) -> None:
    """Write the ledger as JSON, and as a table, from files that `decide_claims` wrote."""
    write_json(ledger, {"rows": tabulate_claims(parts, table)})


def tabulate_claims(parts: list[str], table: str) -> list[dict]:
    """Write the rows in the order of the paper's sections as Markdown, and return them."""
    rows = [row for path in parts for row in load_json(path)["rows"]]
    rows.sort(key=lambda row: row["section"])
    claims = [[row[key] for key in ("name", "place", "says", "verdict")] for row in rows]
    write_markdown(
        table,
        "# What the paper says, and what the numbers say",
        "\n".join(f"- {line}" for line in counted(rows)),
        markdown(("name", "where", "claim", "verdict"), claims),
    )
    print(*counted(rows), sep="\n")
    return rows
