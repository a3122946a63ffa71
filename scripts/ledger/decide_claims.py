"""Decide the claims of some modules by the datasets at hand, for a part of the ledger."""

from itertools import chain

from pendula.datasets.checks import broken, describe
from pendula.datasets.json_files import write_json
from pendula.datasets.netcdf import read
from pendula.ledger.claim import all_claims, evaluate, needed, sections
from pendula.ledger.criterion import Verdict
from pendula.ledger.distortions import distorted, in_words
from pendula.ledger.tables import by_sentence, check_lines, in_short, tables
from pendula.report.words import write_markdown
from pendula.studies.theory.settings import WRONG_FOLDER


def decide_claims(
    datasets: list[str],
    makers: dict[str, str],
    modules: list[str],
    differs: dict[str, str],
    part: str,
    table: str,
) -> None:
    """Write the rows of the ledger on the claims in `modules`, and a table to read.

    Beside the rows stands what the functions of the claims said of distorted datasets.

    `makers` has the rule that makes each of `datasets`, in their order, by its name in the claims.
    `differs` says where the configuration is not the paper's, as `configuration.paper` finds it.
    """
    absent = set(needed(*modules)) - set(makers)
    if absent:
        raise ValueError(f"the claims rest on {', '.join(sorted(absent))}: not inputs of this job")
    sources = {name: read(path) for name, path in zip(makers, datasets, strict=True)}
    rows = [row | {"rules": rules_of(row, makers)} for row in evaluate(sources, differs, modules)]
    shown = [name for name in sources if name.startswith("checks/") and WRONG_FOLDER not in name]
    checks = {name: sources[name].to_dict() for name in shown}
    lines = check_lines(checks)
    left_out = {row["name"] for row in rows if row["verdict"] == Verdict.NOT_APPLICABLE}
    asked = [claim for claim in all_claims(*modules) if claim.name not in left_out]
    told = {
        "sections": sections(*modules),
        "read": list(makers),
        "rows": rows,
        "checks": lines,
        "distortions": in_words(distorted(asked, sources)),
    }
    write_json(part, told)
    write_markdown(table, *tables(by_sentence(rows), chain(*lines.values())))
    print(in_short(by_sentence(rows)))
    for name, check in checks.items():
        if broken(check):
            print(describe(name.removeprefix("checks/"), check))


def rules_of(row: dict, makers: dict[str, str]) -> list[str]:
    """Return the rules whose datasets decide a row."""
    return list(dict.fromkeys(makers[name] for name in row["decided_by"]))


if __name__ == "__main__":
    from job import run

    run(decide_claims, snakemake)  # noqa: F821
