"""Jobs of the ledger: decide some claims from datasets, join the parts, and write their table."""

from collections.abc import Sequence

from latticode.datasets.json_files import load_json, write_json
from latticode.datasets.netcdf import read

from replication.differences import NO_DIFFERENCES, Differences
from replication.words import markdown, write_markdown

from .claim import Claim
from .rows import counted
from .verdicts import evaluate, needed


def decide_claims(
    claims: Sequence[Claim],
    datasets: Sequence[str],
    names: Sequence[str],
    part: str,
    differences: Differences = NO_DIFFERENCES,
) -> None:
    """Decide `claims`, and write their rows of the ledger into the file `part`.

    `datasets` are files, `names` their names in the claims, in the same order. `differences` are
    the differences of the configuration from the paper's.
    """
    if absent := set(needed(claims)) - set(names):
        raise ValueError(f"the claims need {', '.join(sorted(absent))}: add it to the job's inputs")
    sources = {name: read(path) for name, path in zip(names, datasets, strict=True)}
    rows = evaluate(claims, sources, differences)
    write_json(part, {"rows": rows})
    print(*counted(rows), sep="\n")


def join_claims(parts: list[str], ledger: str, table: str) -> None:
    """Write the ledger as JSON, and as a table, from files that `decide_claims` wrote."""
    write_json(ledger, {"rows": tabulate_claims(parts, table)})


def tabulate_claims(parts: list[str], table: str) -> list[dict]:
    """Return the rows of all parts in the order of the paper's sections; write them as Markdown."""
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
