"""The ledger in the report: claims that are not confirmed in full, and all others folded."""

import re
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

from markupsafe import Markup

from pendula.datasets.json_files import load_json
from pendula.report.results import Results, Table
from pendula.report.words import Quote, number, plainly, symbols, told

from .claim import Origin
from .criterion import Verdict
from .tables import as_sentence, files_of, tally
from .verdicts import controls_of, cutoff_lines

LEDGER = "claims.json"
CONFIRMED = (Verdict.CONFIRMED, Verdict.CAVEAT)
FOLDED = (Verdict.NOT_APPLICABLE, Verdict.CAVEAT, Verdict.CONFIRMED)


class Claims(NamedTuple):
    """Rows of the ledger as a list."""

    title: str
    claims: Sequence[Mapping[str, Any]]
    folded: bool = True


def load(results: Results) -> list[dict]:
    """Return the rows of the ledger."""
    return load_json(results.path(LEDGER))["rows"]


def summary(results: Results) -> Markup:
    """Return in a sentence how many claims of the paper have each verdict."""
    counts = tally(load(results)).get(Origin.PAPER, {})
    total = results.say(LEDGER, str(sum(counts.values())))
    parts = [told("{n} {verdict}", n=results.say(LEDGER, str(n)), verdict=as_sentence(one, n))
             for one, n in counts.items()]  # fmt: skip
    return told("Of {total} claims of the paper, {parts}.", total=total,
                parts=Markup(", ").join(parts))  # fmt: skip


def gather(results: Results, ledger: "Ledger") -> dict[str, Any]:
    """Return the claims by verdict, the cut-offs and the controls."""
    rows = load(results)
    others = [row for row in rows if row["verdict"] not in FOLDED]
    fed = controls_of(rows)
    asked = [one["passes"] for one in fed if one["passes"] is not None]
    wrong = results.say(LEDGER, str(asked.count(False)))
    cutoffs, head = cutoff_lines(rows), ("cut-off", "origin", "claims decided by it",
                                         "claims whose verdict changes")  # fmt: skip
    verdicts = [one for one in Verdict if any(row["verdict"] == one for row in rows)]
    counts = [[origin, *(results.say(LEDGER, str(own.get(one, 0))) for one in verdicts)]
              for origin, own in tally(rows).items()]  # fmt: skip
    title = "Claims that are not reproduced, do not carry over, or cannot be decided"
    found = {
        "counts": Table("Verdicts, computed from the datasets", ("claims", *verdicts), counts),
        "others": _claims(title, others, results, folded=False),
    }
    for verdict in FOLDED:
        own = [row for row in rows if row["verdict"] == verdict]
        found[verdict] = _claims(f"{len(own)} claims {verdict}", own, results)
    return found | {
        "cutoffs": Table(
            f"{len(cutoffs)} cut-offs where the paper gives a word and no number, each moved by a "
            "third either way", head, [list(map(_cell, line)) for line in cutoffs], folded=True,
        ),
        "fed": Table(
            f"{len(asked)} controls: wrong cases that a function must not confirm, and its verdict",
            ("claim", "case", "required", "verdict", "reason"),
            [[_cell(one[key]) for key in FED] for one in fed], folded=True,
        ),
        "failing": told("{n} of these controls came out wrong", n=wrong) + (
            " (the functions that fail them decide nothing)." if False in asked else "."),
    }  # fmt: skip


FED = ("claim", "fed", "must", "verdict", "because")


def _cell(value: float | str, digits: int = 3) -> str:
    return symbols(value) if isinstance(value, str) else number(value, digits)


def _claims(title: str, rows: list[dict], results: Results, folded: bool = True) -> Claims:
    measured = [", ".join(f"{plainly(key)} = {_cell(value, 4)}"
                          for key, value in row["measured"].items()) for row in rows]  # fmt: skip
    return Claims(title, [
        {**{key: row[key] for key in ("name", "place", "verdict")},
         **{key: symbols(row[key]) for key in ("says", "criterion")},
         "because": symbols(row["because"][:1].upper() + row["because"][1:]), "measured": values,
         "badge": badge(row["verdict"]),
         "data": [results.say(name, one) for name, one in files_of(row).items()]}
        for row, values in zip(rows, measured, strict=True)
    ], folded)  # fmt: skip


def badge(verdict: str, text: str = "") -> Markup:
    """Return a verdict in its colour, or a text in the colour of this verdict."""
    return told('<span class="badge {name}">{text}</span>', name=verdict.replace(" ", "_"),
                text=text or verdict)  # fmt: skip


class Ledger:
    """The numbers of the ledger by claim, each linked to a dataset that decides the claim."""

    def __init__(self, results: Results):
        self._results = results
        self._all = load(results)
        self._rows = {name: row for row in self._all for name in row["names"]}

    def value(self, claim: str, key: str) -> float:
        """Return a measured number, NaN if the claim was not decided or is not applicable."""
        return float(str(self._rows[claim]["measured"].get(key, "nan")).replace("none", "nan"))

    def quote(self, claim: str, key: str, digits: int = 3) -> Quote:
        """Return a measured number as the page shows it."""
        source = self._rows[claim]["decided_by"][0]
        return self._results.quote(source, self.value(claim, key), digits)

    def on(self, figure: int) -> list[dict]:
        """Return the rows of the paper's claims on a figure, whose place may be "Figs 2 and 6"."""
        named = re.compile(rf"Figs? [\d, and]*{figure}")
        rows = (row for row in self._all if named.search(row["place"]))
        return [row for row in rows if row["origin"] == Origin.PAPER]
