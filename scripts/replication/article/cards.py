"""A card for each number, figure and verdict of an article: its meaning, data, code and command.

The template prints texts that have sources. `Cards` records each printed source and describes it.
In the page, a card opens next to its number. In the PDF, an appendix has the cards.
"""

from collections.abc import Iterable, Iterator, Mapping
from typing import Any, NamedTuple

import numpy as np
import xarray as xr
from latticode.numerics.elementary import log

from replication.ledger.criterion import Verdict
from replication.ledger.rows import load
from replication.results import Results
from replication.variables import VARIATION
from replication.words import number, plainly, symbols

from .quoted import LongStudies, LongStudy, copy_of, is_quoted
from .sources import Code, Printed, Source, code_of

MOST_ROWS = 12
"""If a table has more rows, its card shows only the rows that the article prints."""
DIGITS = 5
"""Significant digits of a number in a card."""
ERRORS = {
    "_error": "error",
    "_statistical_error": "statistical error",
    "_low": "lower limit",
    "_high": "upper limit",
}
"""Labels of errors: variables with such a suffix contain errors of another variable."""
FEWEST_POINTS, MOST_POINTS = 4, 60
"""Limits on the number of points of a curve in a card."""
DECADES = 100.0
"""A positive curve with a larger ratio of maximum to minimum is drawn on a logarithmic scale."""
WIDE, HIGH = 160.0, 36.0
"""The size of a curve in pixels."""
SIGNS = {
    Verdict.CONFIRMED: "✓",
    Verdict.CAVEAT: "(✓)",
    Verdict.UNDECIDED: "?",
}
"""Marks of verdicts in the text; verdicts that are not listed have a cross."""
CROSS = "✗"
COUNTS = Source("claims.json", "verdicts")
"""The source of numbers that count claims."""


class Link(NamedTuple):
    """A link to a file or to an anchor in the report; plain text if `address` is empty."""

    text: str
    address: str = ""


class Table(NamedTuple):
    """A table in a card; `keys` are the labels of each row."""

    head: tuple[str, ...] = ()
    rows: tuple[tuple[str, ...], ...] = ()
    keys: tuple[dict[str, Any], ...] = ()


class Card(NamedTuple):
    """The description of a source; `command` makes it again."""

    id: str
    title: str
    command: str
    code: Code
    verdict: str = ""
    criterion: str = ""
    remark: str = ""
    table: Table = Table()
    curve: str = ""
    ends: str = ""
    variations: Table = Table()
    files: tuple[Link, ...] = ()
    claims: tuple[Link, ...] = ()
    is_long: bool = False
    texts: tuple[str, ...] = ()


def functions_of(cards: Iterable[Card]) -> list[Code]:
    """Return the functions that the cards name, each once, sorted by name."""
    functions = {card.code.name: card.code for card in cards if card.code.text}
    return [functions[name] for name in sorted(functions)]


class Cards:
    """The sources of the printed texts, in the order of the article."""

    def __init__(self, results: Results, long_studies: LongStudies) -> None:
        self.results, self.long_studies = results, long_studies
        self._printed: dict[str, list[Printed]] = {}
        self._small_tables: dict[str, Table] = {}
        self._claims = {row["name"]: row for row in load(results)}

    def note(self, text: Printed) -> str:
        """Record a printed text, and return the id of its card."""
        self._printed.setdefault(text.source.card, []).append(text)
        return text.source.card

    def clear(self) -> None:
        """Remove all records, because a notice is printed in place of the article."""
        self._printed.clear()

    def sign(self, claim: str) -> Printed:
        """Return the mark of the verdict on a claim."""
        verdict = self._claims[claim]["verdict"]
        return Printed(SIGNS.get(verdict, CROSS), Source(claim=claim))

    def is_sign(self, text: Printed) -> bool:
        """Return whether a text is the mark of a verdict."""
        return bool(text.source.claim) and text.text in (*SIGNS.values(), CROSS)

    def verdict(self, sign: Printed) -> str:
        """Return the verdict that a mark means."""
        return self._claims[sign.source.claim]["verdict"]

    def row_of(self, text: Printed) -> int | None:
        """Return the index of a printed number's row in the table of its card, or None."""
        if not text.source.variable or not text.source.labels:
            return None
        labels = dict(text.source.labels)
        keys = self._tabulate(text.source).keys
        return next((i for i, key in enumerate(keys) if key == labels), None)

    def describe(self) -> list[Card]:
        """Return a card for each printed source."""
        return [self._describe(texts) for texts in self._printed.values()]

    def _describe(self, texts: list[Printed]) -> Card:
        source = texts[0].source
        if source.claim:
            card = self._of_claim(source)
        elif source.figure:
            card = self._of_figure(source)
        elif source == COUNTS:
            card = self._of_counts()
        elif source.variable:
            card = self._of_variable(source)
        else:
            card = self._of_dataset(source, texts)
        return card._replace(texts=tuple(dict.fromkeys(text.text for text in texts if text.text)))

    def _of_claim(self, source: Source) -> Card:
        row = self._claims[source.claim]
        measured = (
            (plainly(name), symbols(value) if isinstance(value, str) else number(value, DIGITS))
            for name, value in row["measured"].items()
        )
        return Card(
            source.card,
            symbols(f"{row['says']} ({row['place']})"),
            f"snakemake {RESULTS}/claims.json",
            verdict=row["verdict"],
            criterion=symbols(row["criterion"]),
            remark=symbols(row["because"]),
            table=Table(("measured", ""), tuple(measured)),
            files=tuple(self._link(name) for name in row["decided_by"]),
            claims=(Link("in the report", f"report.html#{source.card}"),),
            code=code_of(row["function"]),
        )

    def _of_figure(self, source: Source) -> Card:
        name = f"figures/{source.figure}"
        attributes = self.results[name].attrs
        read = [path for path in attributes.get("computed_from", "").split(", ") if path]
        return Card(
            source.card,
            attributes["caption"],
            f"snakemake {source.figure}",
            files=(
                *(Link(f"{name}.{kind}", f"{name}.{kind}") for kind in ("nc", "png", "pdf")),
                *map(self._link, read),
            ),
            claims=(Link("in the report", f"report.html#{source.card}"),),
            code=code_of(attributes["computed_by"]),
        )

    def _of_counts(self) -> Card:
        rows = list(self._claims.values())
        columns = list(dict.fromkeys(row["origin"] for row in rows))
        counts = {
            verdict: [
                sum(row["verdict"] == verdict and row["origin"] == origin for row in rows)
                for origin in columns
            ]
            for verdict in map(str, Verdict)
        }
        return Card(
            COUNTS.card,
            "Claims by verdict and by origin",
            f"snakemake {RESULTS}/claims.json",
            table=Table(
                ("verdict", *columns),
                tuple((verdict, *map(str, row)) for verdict, row in counts.items() if any(row)),
            ),
            files=(Link("claims.json", "claims.json"),),
            claims=(Link("all claims in the report", "report.html#claims"),),
            code=code_of("replication.ledger.decide.join_claims"),
        )

    def _of_variable(self, source: Source) -> Card:
        study, data = self._long_study(source.dataset), self.results[source.dataset]
        function = data.attrs.get("computed_by") or study.function
        read = [path for path in data.attrs.get("computed_from", "").split(", ") if path]
        table = self._tabulate(source)
        return Card(
            source.card,
            symbols(str(data[source.variable].attrs["long_name"])),
            study.command if study else f"snakemake {RESULTS}/{source.dataset}.nc",
            table=table,
            curve=draw_curve(data, source.variable),
            ends=describe_ends(data[source.variable]),
            variations=self._variations(source, table),
            files=(self._link(source.dataset), *map(self._link, read)),
            code=code_of(function),
            is_long=study is not None,
        )

    def _of_dataset(self, source: Source, texts: list[Printed]) -> Card:
        """Return a card with attributes and coordinates of a dataset: the settings of its runs."""
        study = self._long_study(source.dataset)
        if source.dataset not in self.results:
            measured = "Wall times of whole runs in seconds, with the number of cores"
            return Card(
                source.card,
                measured,
                study.command,
                files=(self._link(source.dataset),),
                code=code_of(study.function),
                is_long=True,
            )
        data = self.results[source.dataset]
        names = dict.fromkeys(text.source.attribute for text in texts)
        function = data.attrs.get("computed_by") or study.function
        return Card(
            source.card,
            symbols(str(data.attrs["title"])),
            study.command if study else f"snakemake {RESULTS}/{source.dataset}.nc",
            table=Table(
                ("computed with", ""),
                tuple((plainly(name), chosen_value(data, name)) for name in names),
                tuple({"attribute": name} for name in names),
            ),
            files=(self._link(source.dataset),),
            code=code_of(function),
            is_long=study is not None,
        )

    def _tabulate(self, source: Source) -> Table:
        """Return a table of a variable: all numbers if they are few, else the printed ones."""
        data = self.results[source.dataset]
        if data[source.variable].size <= MOST_ROWS:
            if source.card not in self._small_tables:
                self._small_tables[source.card] = tabulate(data, source.variable, [{}])
            return self._small_tables[source.card]
        sources = [text.source for text in self._printed.get(source.card, [])] or [source]
        return tabulate(data, source.variable, [dict(each.labels) for each in sources])

    def _variations(self, source: Source, table: Table) -> Table:
        """Return the numbers of a table measured again, with a row for each changed choice."""
        varied = f"{source.variable}_varied"
        if varied not in self.results[source.dataset]:
            return Table()
        varied_values = self.results[source.dataset][varied]
        columns = [varied_values.sel(key).values.tolist() for key in table.keys]
        rows = []
        for choice, *values in zip(varied_values[VARIATION].values, *columns, strict=True):
            if np.isfinite(values).any():
                texts = ("" if np.isnan(value) else number(value, DIGITS) for value in values)
                rows.append((symbols(str(choice)), *texts))
        labels = len(table.keys[0]) if table.keys else 0
        return Table(("changed", *(", ".join(row[:labels]) for row in table.rows)), tuple(rows))

    def _long_study(self, name: str) -> LongStudy | None:
        """Return the long study of a dataset, or None if a full run makes the dataset."""
        studies = self.long_studies
        return studies.get(name) or studies.get(name.rpartition("/")[0])

    def _link(self, name: str) -> Link:
        """Return a link to a dataset of this run or of a long study, by its name."""
        copy = copy_of(name) if name.startswith("tests/") else name
        if copy in self.results:
            return Link(f"{copy}.nc", f"{copy}.nc")
        return Link(name, name if is_quoted(name) else "")


RESULTS = "results"
"""The folder of a run in commands."""


def chosen_value(data: xr.Dataset, name: str) -> str:
    """Return an attribute of a dataset, or the range of a coordinate, as text."""
    if name not in data.coords:
        return _cell_text(data.attrs[name])
    values = data[name].values
    return f"{_cell_text(values.min())} to {_cell_text(values.max())}, {values.size} values"


def tabulate(data: xr.Dataset, variable: str, selections: Iterable[Mapping[str, Any]]) -> Table:
    """Return a table of a variable; each row has the labels, value and errors of a number."""
    values = data[variable]
    if values.size <= MOST_ROWS:
        selections = [{}]
    rows = list(tabulate_rows(values, selections))
    suffixes = [
        suffix
        for suffix in ERRORS
        if f"{variable}{suffix}" in data and data[f"{variable}{suffix}"].dims == values.dims
    ]
    labels = [name for name in values.dims if name in data.coords]
    keys = tuple({name: row.coords[name].item() for name in labels} for row in rows)
    texts = tuple(
        (
            *(_cell_text(key[name]) for name in labels),
            _cell_text(row.item()),
            *(_cell_text(data[f"{variable}{suffix}"].sel(key).item()) for suffix in suffixes),
        )
        for key, row in zip(keys, rows, strict=True)
    )
    meanings = (symbols(str(data[name].attrs["long_name"])) for name in labels)
    head = (*meanings, "value", *(ERRORS[suffix] for suffix in suffixes))
    return Table(head, texts, keys)


def tabulate_rows(
    values: xr.DataArray, selections: Iterable[Mapping[str, Any]]
) -> Iterator[xr.DataArray]:
    """Yield each selected number once; selections of more than MOST_ROWS numbers are left out."""
    seen = set()
    for labels in selections:
        selected = values.sel(labels)
        if selected.size > MOST_ROWS:
            continue
        for place in np.ndindex(selected.shape):
            row = selected[place]
            key = tuple(str(row.coords[name].item()) for name in row.coords)
            if key not in seen:
                seen.add(key)
                yield row


def draw_curve(data: xr.Dataset, variable: str) -> str:
    """Return the points of a small curve in SVG; empty if a variable cannot be drawn as a curve."""
    values = data.get(variable)
    if values is None or values.ndim != 1 or values.dtype.kind not in "fi":
        return ""
    over = data[values.dims[0]] if values.dims[0] in data.coords else None
    if over is None or over.dtype.kind not in "fi":
        return ""
    known = np.isfinite(values.values)
    x, y = over.values[known].astype(float), values.values[known].astype(float)
    if len(y) < FEWEST_POINTS or y.max() == y.min():
        return ""
    stride = -(-len(y) // MOST_POINTS)
    x, y = x[::stride], y[::stride]
    if y.min() > 0 and y.max() > DECADES * y.min():
        y = log(y)
    across = WIDE * (x - x.min()) / (x.max() - x.min())
    down = HIGH * (y.max() - y) / (y.max() - y.min())
    return " ".join(f"{a:.1f},{b:.1f}" for a, b in zip(across, down, strict=True))


def describe_ends(values: xr.DataArray) -> str:
    """Return a phrase with the range of a variable; empty if its table shows all numbers."""
    if values.size <= MOST_ROWS or values.dtype.kind not in "fi":
        return ""
    ends = (number(float(end(values.values)), DIGITS) for end in (np.nanmin, np.nanmax))
    return "{} numbers, from {} to {}".format(values.size, *ends)


def _cell_text(value: Any) -> str:
    if isinstance(value, str):
        return symbols(value)
    if isinstance(value, float | np.floating):
        return number(value, DIGITS)
    return str(value)
