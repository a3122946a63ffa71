"""Join the parts of the ledger in the order of the paper: the ledger, its controls, and a table."""

from pendula.datasets.json_files import load_json, write_json
from pendula.ledger.claim import controls_of, in_order
from pendula.ledger.tables import by_sentence, in_short, tables
from pendula.report.words import write_markdown


def join_claims(parts: list[str], names: list[str], ledger: str, controls: str, table: str) -> None:
    """Write the ledger and its controls as JSON, and both as Markdown.

    `parts` are files that decide_claims wrote. `names` gives the order of the checks in the table.
    """
    read = [load_json(path) for path in parts]
    sections = {module: at for part in read for module, at in part["sections"].items()}
    rows = by_sentence(in_order([row for part in read for row in part["rows"]], sections))
    checks = {name: lines for part in read for name, lines in part["checks"].items()}
    write_json(ledger, {"rows": rows})
    distortions = [row for part in read for row in part["distortions"]]
    write_json(controls, {"rows": [*controls_of(rows), *distortions]})
    lines = [line for name in names for line in checks.get(name, [])]
    write_markdown(table, *tables(rows, lines))
    print(in_short(rows))


if __name__ == "__main__":
    from job import run

    run(join_claims, snakemake)  # noqa: F821
