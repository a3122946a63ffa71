"""What a run says that is false of it: its report, ledger, tables and figures.

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
from pendula.ledger.claim import all_claims
from pendula.problem import is_even
from pendula.report.words import case_in_words

CASES, SWEEPS = paper()["cases"], paper()["sweeps"]
DATA = {"omega", "gamma", "epsilon", "initial"}
RUN_BY = {
    "trajectories": DATA | {"boundary", "half_width", "end_time", "output_step", "solver"},
    "sweeps": DATA | {"boundary", "output_step"},
    "unbounded": DATA,
}
"""By folder, the keys of a case that decide its datasets; elsewhere DATA and the chain do."""
DECIDED = {"confirmed", "confirmed with a caveat", "not reproduced", "does not carry over"}
CASE = r"Ω = \S+, (?:\(A[₋₀-₉]+, B[₋₀-₉]+\) = \([^)]*\)|data on \d+ sites)"
"""A case as the page names it."""


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
            case: {key for key in RUN_BY["trajectories"] if not _same(key, about, CASES[case])}
            for case, about in self.runs.items()
        }

    @cached_property
    def page(self) -> str:
        """The words of the report, without what a reader has to open."""
        html = (self.results / "report.html").read_text("utf-8")
        html = re.sub(r"<(script|style|svg)\b.*?</\1>", " ", html, flags=re.DOTALL)
        return " ".join(unescape(re.sub(r"<[^>]*>", "", html)).split())

    @cached_property
    def claims(self) -> dict[str, dict]:
        """The rows of the ledger by the name of each claim in them."""
        return {name: row for row in self.rows("claims.json") for name in row["names"]}

    @cached_property
    def chaotic(self) -> set[str]:
        growth = self.data("checks/lyapunov")
        return {str(case) for case in growth["case"].values[growth["chaotic"].values == 1]}

    def named(self, case: str) -> str:
        about = self.runs[case]
        return " ".join(case_in_words(float(about["omega"]), str(about["initial"])).split())

    def regular(self, cases) -> set[str]:
        """Return the names on the page of those of some cases that are not chaotic."""
        return {self.named(one) for one in cases} - {self.named(one) for one in self.chaotic}

    def others(self, keys: set[str], cases=CASES) -> list[str]:
        return [case for case in cases if self.edited[case] & keys]


def _same(key: str, about: dict, of_paper: dict) -> bool:
    if key == "solver":
        wanted = {f"solver_{name}": value for name, value in of_paper[key].items()}
        wanted["solver"] = wanted.pop("solver_name")
        return {name: one for name, one in about.items() if name.startswith("solver")} == wanted
    if key != "initial":
        return about[key] == of_paper[key]
    read = {site: [complex(z) for z in pair] for site, pair in json.loads(about[key]).items()}
    return read == {site: [complex(z) for z in pair] for site, pair in of_paper[key].items()}


def false_sentences(folder_of_run: Path | str) -> list[str]:
    """Return what is false of all that a run says; `folder_of_run` holds its `results`."""
    run = Run(Path(folder_of_run))
    checks = (ledger, controls, notice, sentences, not_known, labels, figures, tables)
    return [one for check in checks
            for one in check(run)]  # fmt: skip


# --- The ledger -----------------------------------------------------------------------------------


def cases_of(run: Run, name: str, on: tuple[str, ...]) -> set[str]:
    """Return the paper's cases that a dataset is of; `on` leaves some cases and sweeps of many."""
    if not (run.results / f"{name}.nc").exists():
        return set()
    data = run.data(name)
    found = {str(one) for along in ("case", "sweep") if along in data.coords
             for one in np.atleast_1d(data[along].values)}  # fmt: skip
    if on:
        found &= set(on)
    found |= {str(data.attrs.get("case"))} | {name.partition("/")[2].partition(".")[0]}
    found = {SWEEPS[one]["case"] if one in SWEEPS else one for one in found}
    return found & set(CASES)


def ledger(run: Run):
    """A claim that rests on an edited case has no verdict but "not applicable"."""
    for claim in all_claims():
        row = run.claims[claim.name]
        if row["verdict"] not in DECIDED or "," in row["reading"]:
            continue  # of several readings one may be on cases that nobody has edited
        for name in claim.needs:
            folder = name.partition("/")[0]
            keys = RUN_BY.get(folder, DATA | {"boundary", "half_width"})
            if "." in name or folder != "trajectories":
                keys = keys - {"solver"}
            for case in run.others(keys, cases_of(run, name, claim.on)):
                yield f"the claim {claim.name} is {row['verdict']}, and {case} is edited"


def controls(run: Run):
    """A control that came out wrong leaves no verdict; one that is fed an edited case, neither."""
    failing = 0
    for row in run.rows("claims.json"):
        for one in row["controls"]:
            failing += one["passes"] is False
            if one["passes"] is False and row["verdict"] in DECIDED and "," not in row["reading"]:
                yield f"{row['name']} is {row['verdict']}, and its control {one['fed']} is wrong"
            fed = re.search(r"\b(small|large) data at Omega = (-?[\d.]+)", one["fed"])
            for case in CASES if fed and one["verdict"] != "not applicable" else ():
                is_it = case.endswith(fed[1]) and float(CASES[case]["omega"]) == float(fed[2])
                if is_it and run.edited[case] & (DATA | {"boundary"}):
                    yield f"{row['name']} was fed {one['fed']}, and {case} is edited"
    kept = {(one["claim"], one["fed"]): one.get("passes") for one in run.rows("controls.json")}
    for row in run.rows("claims.json"):
        for one in row["controls"]:
            if kept.get((row["name"], one["fed"]), "none") != one["passes"]:
                yield f"controls.json says another thing of {row['name']}, {one['fed']}"
    said = re.search(r"(\d+) of these controls came out wrong", run.page)
    if not said or int(said[1]) != failing:
        yield f"the report does not say that {failing} controls came out wrong"


# --- The report -----------------------------------------------------------------------------------


def notice(run: Run):
    """The page begins with all that differs in the cases, with both values."""
    head = run.page.partition("What this page says of these cases is said of what was run.")[0]
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
        about = run.runs[case]
        if key in about and key not in ("initial", "solver"):
            values = [about[key], CASES[case][key]]
            if [now, was] != [one if isinstance(one, str) else f"{one:g}" for one in values]:
                yield f"{where} says {case}.{key} ({now} in place of {was}), which was not run"


def _paper_data(run: Run, said: re.Match) -> bool:
    sizes = {"small": "small", "large": "large", "larger": "large"}
    omega = float(said[2].replace("−", "-").rstrip(".,;:"))
    return any(
        case.endswith(sizes[said[1]]) and CASES[case]["omega"] == omega for case in run.others(DATA)
    )


def _leaves(run: Run, said: re.Match) -> bool:
    off = re.findall(CASE, said[1])
    regular = run.regular(CASES)
    return any(one in regular for one in off) if said[2] == "run" else not set(off) - regular


def _full_scale(run: Run, said: re.Match) -> bool:
    largest = run.data("checks/solvers")["largest_difference"].max("pair")
    chaotic = largest["case"].isin(list(run.chaotic))
    regular = largest.values[~chaotic.values]
    return bool((regular >= largest.values[chaotic.values].min(initial=np.inf)).any())


def _divergences(run: Run) -> dict[str, float]:
    """Return by case when its run leaves its reference, as drawn; NaN without a reference."""
    found = {}
    for figure in ("fig2", "fig3", "fig4"):
        drawn = run.data(f"figures/{figure}")
        times = zip(drawn["initial_size"].values, drawn["divergence_time"].values, strict=True)
        found |= {f"{figure}_{size}": time for size, time in times}
    return found


def _motion(run: Run, said: re.Match) -> bool:
    off = [case for case, time in _divergences(run).items() if np.isfinite(time)]
    return bool(run.regular(off) - set(re.findall(CASE, said[1])))


def _known(run: Run, said: re.Match) -> bool:
    known = {run.named(case) for case, time in _divergences(run).items() if not np.isnan(time)}
    return bool(known & set(re.findall(CASE, said[0])))


def _some_disperse(run: Run, said: re.Match) -> bool:
    fates = run.data("breathers/fates")
    if 0.0 not in fates["omega"].values:
        return True
    here = fates.sel(omega=0.0)
    unequal = here["fate"].where(here["a0"] != here["b0"])
    spreads = list(here["fate_name"].values).index("spreads")
    return bool((unequal.dropna("a0", how="all") != spreads).where(unequal.notnull()).sum() > 0)


def _uneven(run: Run, said: re.Match) -> bool:
    return not all(map(is_even, map(str, run.data("unbounded/growth")["initial"].values)))


def _tolerances(run: Run, said: re.Match) -> bool:
    about = run.data("trajectories/fig2_small.ode45").attrs
    given = paper()["solvers"]["ode45"]
    return any(about[f"solver_{key}"] != given[key] for key in ("rtol", "atol"))


def _omegas(run: Run, said: re.Match) -> bool:
    shown = {float(one.replace("−", "-")) for one in said[2].split(" and ")}
    return shown != {
        float(run.runs[f"fig{said[1]}_{size}"]["omega"]) for size in ("small", "large")
    }


def _not_held(claim: str):
    return lambda run, said: not run.claims[claim]["verdict"].startswith("confirmed")


def _edited(*cases: str):
    return lambda run, said: bool(run.others(DATA, cases or CASES))


NUMBER = r"(−?[\d.]+)"
SENTENCES = [
    (rf"One run of a chaotic case is one sample \(({CASE})\)",
     lambda run, said: said[1] in run.regular(CASES)),
    (r"visibly leave the references[^:]*?, at ([^:]*): a dashed line marks it\. After that a "
     r"(run|chaotic run) is another solution of the same kind", _leaves),
    (r"what lies behind it is one solution of many of the same kind([^.]*(?:\([^.]*\))?[^.]*)\.",
     _motion),
    (rf"No reference is known for the run of {CASE}(?:; {CASE})*", _known),
    (r"where it reaches full scale, chaos has separated the runs", _full_scale),
    (rf"[Tt]he paper's (small|large) data at Ω = {NUMBER}", _paper_data),
    (rf"The (small|large) data at Ω = {NUMBER} stand on a knife edge", _paper_data),
    (r"The larger data at the detuning of Fig 3 lie near a border", _edited("fig3_large")),
    (r"At the detuning of Fig 4 it grows exponentially", _edited("fig4_small", "fig4_large")),
    (r"fill the chain with the same sea as the amplitudes", _not_held("same_sea")),
    (r"Where the motion is regular they agree at μ", _not_held("pendula_norms")),
    (r"The bound of Theorem 3 does not hold for the pendula then", _edited("fig4_small")),
    (r"At the detuning of Fig 4 all unequal data of the maps spread", _some_disperse),
    (r"A circle marks the paper's data", _edited()),
    (r"data are all even in n|All data are even in n, which", _uneven),
    (r"The paper's solver, ode45,", _tolerances),
    (rf"Fig (\d): norms against time, Ω = ({NUMBER}(?: and {NUMBER})?)", _omegas),
    (r"the claims that they belong to are not decided", lambda run, said: True),
]  # fmt: skip
"""A sentence of the report, and what makes it false where it stands."""


def sentences(run: Run):
    for pattern, is_false in SENTENCES:
        for said in re.finditer(pattern, run.page):
            if is_false(run, said):
                yield f"the report says: {said[0]}"


def not_known(run: Run):
    """The page says what is not known of the pendula where numbers are NaN, and only there."""
    names = {"phases": "l2", "over_the_top": "angle_so_far"}
    lost = any(run.data(f"pendula/{name}")[key].isnull().any() for name, key in names.items())
    if lost != ("so that no run can follow them for long" in run.page):
        yield f"the report does not say that numbers of pendula are {'not ' * lost}known"


def labels(run: Run):
    """Each case that the page names was run; measured speed is of the paper's, whatever is run."""
    page = re.sub(r"Theorem 2 and .*?: P =", "", run.page)
    page = page.rpartition("Snakemake speed")[0] or page.partition("Least time in ms")[0]
    known = set()
    for path in self_described(run):
        data = xr.open_dataset(path)
        for about in (data.attrs, data):
            if "omega" in about and "initial" in about:
                pairs = np.broadcast_arrays(*(np.atleast_1d(about[key]) for key in DESCRIBED))
                known |= {_label(*pair) for pair in zip(*map(np.ravel, pairs), strict=True)}
        data.close()
    for one in dict.fromkeys(re.findall(CASE, page)):
        if one not in known:
            yield f"the report names {one}, which was not run"


DESCRIBED = ("omega", "initial")


def self_described(run: Run):
    folders = ("trajectories", "sweeps", "unbounded", "certified", "checks", "pendula")
    return [path for folder in folders for path in (run.results / folder).glob("*.nc")]


def _label(omega, initial) -> str:
    try:
        return " ".join(case_in_words(float(omega), str(initial)).split())
    except ValueError:  # a description in words
        return ""


# --- Figures and tables ---------------------------------------------------------------------------


def figures(run: Run):
    """A figure of an edited case says so, in its picture and in its data; its titles are true."""
    for path in sorted((run.results / "figures").glob("*.json")):
        name, text = path.stem, path.read_text("utf-8")
        data = run.data(f"figures/{name}")
        comment = data.attrs.get("comment", "")
        number = re.match(r"fig([2-6])", name)
        if number and int(number[1]) <= 4:
            shown = [f"fig{number[1]}_{size}" for size in ("small", "large")]
            keys = RUN_BY["trajectories"]
            titles = {float(one) for one in re.findall(r"\\\\Omega = ([-\d.]+)", text)}
            if titles != {float(run.runs[case]["omega"]) for case in shown}:
                yield f"{name} has titles at Omega = {sorted(titles)}, which were not run"
        elif number:
            shown = [SWEEPS[f"{number[0]}_{side}"]["case"] for side in ("left", "right")]
            keys = RUN_BY["sweeps"]
        else:
            along = data.coords["case"].values if "case" in data.coords else ()
            shown, keys = [case for case in map(str, along) if case in CASES], DATA
        for case in shown:
            for key in run.edited[case] & keys:
                if f"{case}.{key}" not in comment:
                    yield f"the data of {name} do not say that {case}.{key} is edited"
        if bool(comment) != ("Not the paper's: " in text):
            yield f"{name} and its data do not both say what is edited"
        yield from _wrong_values(run, comment, name)
        if "the paper's data" in text and run.others(DATA):
            yield f"{name} names data as the paper's, and {run.others(DATA)[0]} is edited"


def tables(run: Run):
    """The tables have the ledger's verdicts, and nothing that the paper states of edited cases."""
    for path in sorted((run.results / "tables").glob("claims*.md")):
        for row in run.rows("claims.json") if path.stem == "claims" else ():
            line = f"| {row['says']} | {row['verdict']} |".replace("|γ", "\\|γ")
            if line not in path.read_text("utf-8").replace("\\|", "|"):
                yield f"{path.name} has another verdict on {row['name']}"
    html = (run.results / "report.html").read_text("utf-8")
    for row in run.rows("claims.json"):
        if f'id="claim_{row["name"]}" data-verdict="{row["verdict"]}"' not in html:
            yield f"the report has another verdict on {row['name']}"
    drift = (run.results / "tables/solvers.md").read_text("utf-8")
    for case in run.others(RUN_BY["trajectories"] - {"solver"}):
        if not re.search(rf"\| {case} \| none: another case", drift):
            yield f"solvers.md holds {case} to what the paper states, and it is edited"
