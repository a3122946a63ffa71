"""What a run says that is false of it: its ledger, report and figures.

Users edit the paper's cases, and then a sentence that is true of the paper's may be false. What was
run is read from the attributes of the datasets, which the sentences do not pass through. Each check
is of a kind of false sentence that somebody found, or could find, and yields what is false.
"""

import json
import re
from functools import cached_property
from html import unescape
from pathlib import Path

import numpy as np
import xarray as xr
from pendula.configuration.paper import paper
from pendula.jobs.decide import all_claims
from replication.ledger.criterion import REFUTED, Verdict

CASES, SWEEPS = paper()["cases"], paper()["sweeps"]
DATA = {"omega", "gamma", "epsilon", "initial"}
RUN_BY = {
    "trajectories": DATA | {"boundary", "half_width", "end_time", "output_step", "solver"},
    "sweeps": DATA | {"boundary", "output_step"},
    "unbounded": DATA,
}
"""By folder, the keys of a case that decide its datasets; elsewhere DATA and the chain do."""
DECIDED = set(map(str, (Verdict.CONFIRMED, Verdict.CAVEAT, *REFUTED)))


class Run:
    """What a run was of, and what it says, from the folder `results` of its --directory."""

    def __init__(self, folder: Path):
        self.results = Path(folder) / "results"
        self.runs = {case: self.data(f"trajectories/{case}").attrs for case in CASES}

    def data(self, name: str) -> xr.Dataset:
        with xr.open_dataset(self.results / f"{name}.nc") as opened:
            return opened.load()

    def rows(self, name: str) -> list[dict]:
        return json.loads((self.results / name).read_text("utf-8"))["rows"]

    @cached_property
    def edited(self) -> dict[str, set[str]]:
        """By case the keys in which its run is not the paper's."""
        return {
            case: {key for key in RUN_BY["trajectories"] if not _same(key, of_run, CASES[case])}
            for case, of_run in self.runs.items()
        }

    @cached_property
    def page(self) -> str:
        """The words of the report, without what a reader has to open."""
        html = (self.results / "report.html").read_text("utf-8")
        html = re.sub(r"<(script|style|svg)\b.*?</\1>", " ", html, flags=re.DOTALL)
        return " ".join(unescape(re.sub(r"<[^>]*>", "", html)).split())

    @cached_property
    def claims(self) -> dict[str, dict]:
        """The rows of the ledger by the names of their claims."""
        return {row["name"]: row for row in self.rows("claims.json")}

    def edited_cases(self, keys: set[str], cases=CASES) -> list[str]:
        return [case for case in cases if self.edited[case] & keys]


def _same(key: str, of_run: dict, of_paper: dict) -> bool:
    if key == "solver":
        solver = {f"solver_{name}": value for name, value in of_paper[key].items()}
        solver["solver"] = solver.pop("solver_name")
        return {name: text for name, text in of_run.items() if name.startswith("solver")} == solver
    if key != "initial":
        return of_run[key] == of_paper[key]
    read = {site: [complex(z) for z in pair] for site, pair in json.loads(of_run[key]).items()}
    return read == {site: [complex(z) for z in pair] for site, pair in of_paper[key].items()}


def false_sentences(folder_of_run: Path | str) -> list[str]:
    """Return what is false of all that a run says; `folder_of_run` holds its `results`."""
    run = Run(Path(folder_of_run))
    return [sentence for check in (ledger, notice, figures) for sentence in check(run)]


# --- The ledger -----------------------------------------------------------------------------------


def cases_of(run: Run, name: str, on: tuple[str, ...]) -> set[str]:
    """Return the paper's cases that a dataset is of; `on` leaves some cases and sweeps of many."""
    if not (run.results / f"{name}.nc").exists():
        return set()
    data = run.data(name)
    names = {
        str(label)
        for along in ("case", "sweep")
        if along in data.coords
        for label in np.atleast_1d(data[along].values)
    }
    if on:
        names &= set(on)
    names |= {str(data.attrs.get("case"))} | {name.partition("/")[2].partition(".")[0]}
    names = {SWEEPS[label]["case"] if label in SWEEPS else label for label in names}
    return names & set(CASES)


def ledger(run: Run):
    """A claim that rests on an edited case has no verdict, and one whose control fails neither."""
    for claim in all_claims():
        row = run.claims[claim.name]
        if row["verdict"] not in DECIDED:
            continue
        for control in row["controls"]:
            if control["passes"] is False:
                yield f"{claim.name} is {row['verdict']}, and its control {control['fed']} is wrong"
        for name in claim.needs:
            folder = name.partition("/")[0]
            keys = RUN_BY.get(folder, DATA | {"boundary", "half_width"})
            if "." in name or folder != "trajectories":
                keys = keys - {"solver"}
            for case in run.edited_cases(keys, cases_of(run, name, claim.on)):
                yield f"the claim {claim.name} is {row['verdict']}, and {case} is edited"


# --- The report -----------------------------------------------------------------------------------


def notice(run: Run):
    """The page begins with all that differs in the cases, with both values."""
    head = run.page.partition("The results on this page are of the cases as they were run.")[0]
    for case, keys in run.edited.items():
        for key in keys:
            if not re.search(rf"\b{case}\.{key}\b", head):
                yield f"the report does not begin with {case}.{key}, which is edited"
    yield from _wrong_values(run, head, "the report")
    if any(run.edited.values()) and "the paper, replicated" in run.page:
        yield "the title of the report is that of the paper's cases"


def _wrong_values(run: Run, text: str, where: str):
    pattern = rf"(?<![\w.])({'|'.join(CASES)})\.(\w+) \((\S+) in place of (\S+)\)"
    for case, key, now, was in re.findall(pattern, text):
        of_run = run.runs[case]
        if key in of_run and key not in ("initial", "solver"):
            values = [of_run[key], CASES[case][key]]
            if [now, was] != [item if isinstance(item, str) else f"{item:g}" for item in values]:
                yield f"{where} says {case}.{key} ({now} in place of {was}), which was not run"


# --- Figures ---------------------------------------------------------------------------


def figures(run: Run):
    """A figure of an edited case says so, in its picture and in its data; its titles are true."""
    for path in sorted((run.results / "figures").glob("*.json")):
        name, text = path.stem, path.read_text("utf-8")
        data = run.data(f"figures/{name}")
        comment = data.attrs.get("comment", "")
        number = re.match(r"fig([2-6])", name)
        if number and int(number[1]) <= 4:
            cases = [f"fig{number[1]}_{size}" for size in ("small", "large")]
            keys = RUN_BY["trajectories"]
            titles = {float(omega) for omega in re.findall(r"\\\\Omega = ([-\d.]+)", text)}
            if titles != {float(run.runs[case]["omega"]) for case in cases}:
                yield f"{name} has titles at Omega = {sorted(titles)}, which were not run"
        elif number:
            cases = [SWEEPS[f"{number[0]}_{side}"]["case"] for side in ("left", "right")]
            keys = RUN_BY["sweeps"]
        else:
            along = data.coords["case"].values if "case" in data.coords else ()
            cases, keys = [case for case in map(str, along) if case in CASES], DATA
        for case in cases:
            for key in run.edited[case] & keys:
                if f"{case}.{key}" not in comment:
                    yield f"the data of {name} do not say that {case}.{key} is edited"
        if bool(comment) != ("Not the paper's: " in text):
            yield f"{name} and its data do not both say what is edited"
        yield from _wrong_values(run, comment, name)
        if "the paper's initial conditions" in text and run.edited_cases(DATA):
            yield f"{name} names data as the paper's, and {run.edited_cases(DATA)[0]} is edited"
