"""Store the chances that another correct run changes a verdict, for docs/report.md and its test.

Run `python docs/right_runs.py FOLDER ...` with the results of several correct runs, which differ in
last bits or seeds. `.ci/elsewhere moved` makes such runs and calls this script. It writes
tests/baseline/quoted/right_runs.json, and fails if verdicts differ or a chance is too large.
"""

import sys
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from latticode.datasets.json_files import write_json
from latticode.datasets.netcdf import read
from pendula.jobs.decide import all_claims
from replication.ledger.chances import ALLOWED, chance_of_claim, chance_to_turn
from replication.ledger.claim import Claim
from replication.ledger.criterion import Finding, Verdict
from replication.ledger.verdicts import look, needed

ROOT = Path(__file__).resolve().parents[1]

RECORD = ROOT / "tests/baseline/quoted/right_runs.json"


def look_at(folder: Path) -> dict[str, dict[str, Finding]]:
    """Return all findings on each claim in the results of a run."""
    sources = {name: read(folder / f"{name}.nc") for name in needed(all_claims())}
    return {claim.name: look(claim, sources) for claim in all_claims()}


def verdict_of(findings: Mapping[str, Finding], moves: Sequence[str]) -> Verdict:
    """Return the verdict on a claim, with a caveat if a moved cut-off changes it."""
    verdict = findings[""].verdict
    turns = any(findings[move].verdict != verdict for move in moves)
    return Verdict.CAVEAT if turns and verdict == Verdict.CONFIRMED else verdict


def rows_of(claim: Claim, looks: Sequence[Mapping[str, Finding]]) -> Iterator[dict]:
    """Yield a row for a claim and for each of its controls, from the findings of each run."""
    controls = [control.description for control in claim.controls]
    moves = [name for name in looks[0] if name and name not in controls]
    chances = {"": chance_of_claim(looks, moves)}
    chances |= {
        control: chance_to_turn([findings[control] for findings in looks]) for control in controls
    }
    for control, chance in chances.items():
        verdicts = dict.fromkeys(
            str(findings[control].verdict if control else verdict_of(findings, moves))
            for findings in looks
        )
        yield {
            "claim": claim.name,
            "control": control,
            "verdicts": list(verdicts),
            "chance": chance.value,
            "nearest": chance.nearest,
        }


def keep_chances(folders: Sequence[Path], path: Path = RECORD) -> list[dict]:
    """Write the rows of all claims; return those whose verdict another run may change."""
    runs = [look_at(folder) for folder in folders]
    rows = [
        row for claim in all_claims() for row in rows_of(claim, [run[claim.name] for run in runs])
    ]
    write_json(path, {"runs": len(runs), "rows": rows})
    return [row for row in rows if row["chance"] >= ALLOWED or len(row["verdicts"]) > 1]


if __name__ == "__main__":
    turned = keep_chances([Path(folder) for folder in sys.argv[1:]])
    for row in turned:
        print(
            f"{row['claim']} {row['control']}: {', '.join(row['verdicts'])},"
            f" chance {row['chance']:.2g} by {row['nearest']}",
            file=sys.stderr,
        )
    sys.exit(bool(turned))
