"""The numbers that the README and docs/ quote, as text.

They are the counts of the ledger, a proved bound rounded upward, and measured times. Each function
returns the facts of one topic, and a template prints them, for example by `{{ scale.minutes }}`.
"""

import json
import re
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr
from latticode.datasets.json_files import load_json
from latticode.datasets.netcdf import read
from latticode.datasets.registry import SOLVER_NAMES
from latticode.kernels.simd import LANES
from latticode.measures.confidence import chance_inside, chance_of_counts, share_limits
from latticode.simulation.survey_runs import MANY
from pendula.article.values import counts, largest_bound
from pendula.case_words import case_of
from pendula.configuration.paper import paper
from pendula.varied import names_of, numbers_in, single_numbers, variations_of
from replication.article.quoted import is_quoted, original_of
from replication.ledger.chances import ALLOWED, RARE
from replication.results import Results
from replication.words import markdown, number, plainly, symbols, with_error

from benchmarks import first_calls as first
from benchmarks import reproduction
from benchmarks import scale as scale_of

BASELINE = Path(__file__).resolve().parents[1] / "tests/baseline"
SMALLEST_SHOWN = 1e-9
"""Smaller chances are not listed."""
LONG_STUDIES = {
    "unbounded": "The infinite chain",
    "chaos": "The transition at Ω = 0",
    "breathers": "Fates of an excited pair at Ω = −4",
    "pendula": "Pendula over the top",
}
"""The long studies, by the names of their files in tests/baseline/quoted."""
DIGITS = 4
"""Significant digits of the numbers in tables of variations."""
WITHOUT_EFFECT = {
    "life": ("level",),
    "transition": ("multiple",),
    **dict.fromkeys(("centre_share", "l2", "linf"), ("level", "multiple")),
    **dict.fromkeys(("passed", "power_excess"), ("settled",)),
}
"""For each number, the choices of its study that do not affect it."""
MEANINGS = {
    "transition": "median time at which P of the chain first reaches a level of its final value",
    "life": "median time at which the central pair first holds at most the mean power of a pair",
    "centre_share": "mean share of P on the central pair in a window of tau",
    "l2": "mean l2 norm in a window of tau",
    "linf": "mean l-infinity norm in a window of tau",
    "growth_behind_front": "growth κ of |A + B| per site behind the first front",
    "power_excess": "relative excess of P of a site over that of the amplitudes on the same chain",
}
"""Meanings of numbers for which the datasets give only names of variables."""
CHOICES = {
    "omega": "Omega",
    "start_amplitude": "A_0",
    "kind": "motion",
    "majority": "share of P that decides the fate",
    "size": "size of the perturbation",
    "level": "level",
    "window": "window of tau",
    "multiple": "multiple of the mean power that ends the time",
    "tolerance": "tolerance of the solver",
    "end_time": "end at tau",
    "run_time": "end at tau",
    "half_width": "half-width M",
    "stride": "stride of the map in points",
    "part_of_run": "part of the run",
    "left_out_part": "part left out",
    "edge": "pairs left out behind the front",
    "settled": "settled from tau",
    "steps": "steps of a period",
}
"""Texts that are printed for choices and labels, by their names in the datasets."""


class Accepted(Results):
    """The accepted results, read in the same way as the results of a run."""

    def __init__(self):
        super().__init__((), "")

    def __contains__(self, name: str) -> bool:
        return self.path(f"{name}.nc").exists()

    def path(self, link: str) -> Path:
        """Return the path of the accepted file to which a page links."""
        return BASELINE.parents[1] / original_of(link) if is_quoted(link) else BASELINE / link


def topics(accepted: Results) -> dict[str, Any]:
    """Return the facts of every topic."""
    reproduction_times = BASELINE / "quoted/reproduction.json"
    return {
        "ledger": counts(load_json(BASELINE / "claims.json")["rows"]),
        "largest_bound": largest_bound(accepted),
        "right_runs": right_runs(load_json(BASELINE / "quoted/right_runs.json")),
        "speed": speed(accepted["speed/work_precision"]),
        "speeds": speeds(accepted),
        "scale": scale(json.loads(scale_of.WRITTEN.read_text(encoding="utf-8"))),
        "first_calls": first_calls(json.loads(first.WRITTEN.read_text(encoding="utf-8"))),
        "full_run": full_run(json.loads(reproduction_times.read_text(encoding="utf-8"))),
        "variations": variations(accepted),
    }


def right_runs(record: dict) -> dict:
    """Return the chances that a correct run changes a verdict: measured ones, and `designed`."""
    rows = sorted(record["rows"], key=lambda row: -row["chance"])
    likely_rows = [row for row in rows if row["chance"] >= SMALLEST_SHOWN]
    return {
        "runs": str(record["runs"]),
        "claims": str(sum(not row["control"] for row in rows)),
        "controls": str(sum(bool(row["control"]) for row in rows)),
        "allowed": number(ALLOWED),
        "smallest": number(SMALLEST_SHOWN),
        "rows": [
            [
                f"`{row['claim']}`",
                row["control"] or "(the claim)",
                plainly(row["nearest"]),
                number(row["chance"], 1),
            ]
            for row in likely_rows
        ],
        "designed": [
            [f"`{claim}`", event, number(chance, 1)] for claim, event, chance in designed()
        ],
    }


def designed() -> list[tuple[str, str, float]]:
    """Return claim, event and chance for events that the statistical tests themselves allow."""
    second = paper()["chaos"]["second_solver"]
    drawn, others = second["members"], second["first_members"]
    inside = len(second["half_widths"]) * chance_inside(drawn // 2, drawn, others)
    of_spread = paper()["breathers"]["sensitivity"]["members"]
    wrong = least_share_above_half(of_spread)
    spread = read(BASELINE / "quoted/breathers.nc")["share"].sel(size=[0.01, 0.1]).values
    return [
        ("second_solver", "a run of the same law is as far from the mean", RARE.number),
        ("one_integral", "a vanishing exponent is beyond its limits", RARE.number),
        ("ensemble_fig5_conjecture", "equal means seem to grow", 0.5 * RARE.number),
        ("ensemble_fig6_diverges", "equal means seem to grow", 0.5 * RARE.number),
        ("waiting_grows", "times that do not depend on μ seem to", 0.5 * RARE.number),
        ("second_solver_sweeps", "half of the runs of one law are out of range", inside),
        (
            "spreading_is_an_accident",
            "the upper limit of the share that spreads is above a half",
            sum(chance_of_counts(wrong, of_spread, float(share)) for share in spread),
        ),
    ]


def least_share_above_half(members: int) -> int:
    """Return the smallest count, out of `members`, whose share has an upper limit of a half."""
    return next(n for n in range(members) if share_limits(n, members).high >= 0.5)


def variations(accepted: Results) -> dict:
    """Return, for each long study, tables of the numbers measured again with other choices."""
    studies = []
    for name, title in LONG_STUDIES.items():
        data = accepted[f"quoted/{name}"]
        places = {name_of_number: [] for name_of_number in numbers_in(data)}
        for name_of_number, at_place in single_numbers(data):
            places[name_of_number].append(at_place)
        numbers = [number_and_variations(data, *entry) for entry in places.items()]
        studies += [{"title": title, "numbers": numbers}] * bool(numbers)
    return {"targets": "unbounded transition fates sensitivity over_the_top", "studies": studies}


def number_and_variations(data: xr.Dataset, name: str, places: list[xr.Dataset]) -> dict:
    """Return the meaning of a number, its choices, and a table of its values at `places`."""
    labels = [variations_of(at_place, name) for at_place in places]
    changed = [
        label
        for label in dict.fromkeys(
            label for values_by_choice in labels for label in values_by_choice
        )
        if label.partition(" = ")[0] not in WITHOUT_EFFECT.get(name, ())
    ]
    rows = [
        [
            place_of(data[name], at_place),
            with_error(*(float(at_place[variable]) for variable in names_of(name)[:2]), DIGITS),
            number(at_place[names_of(name)[2]], 2),
            *(
                number(values_by_choice[label], DIGITS) if label in values_by_choice else ""
                for label in changed
            ),
        ]
        for at_place, values_by_choice in zip(places, labels, strict=True)
    ]
    head = ["at", "value", "statistical error", *map(choice_in_words, changed)]
    meaning = symbols(MEANINGS.get(name) or data[name].attrs["long_name"])
    return {
        "meaning": meaning[0].upper() + meaning[1:],
        "choices": choices_of(data[name]),
        "table": markdown(head, rows),
    }


def choices_of(variable: xr.DataArray) -> str:
    """Return a text with the choices that can change a number."""
    choices = re.findall(r"(\w[\w ]*) = (\([^)]*\)|[^,]*)", variable.attrs["choices"])
    without = WITHOUT_EFFECT.get(str(variable.name), ())
    texts = [choice_in_words(f"{key} = {value}") for key, value in choices if key not in without]
    return ", ".join(texts) or "the choices of what it follows from"


def choice_in_words(label: str) -> str:
    """Return the text for a choice and its value, such as "size = 0.01"."""
    name, _, value = label.partition(" = ")
    ends = re.fullmatch(r"\((.*), (.*)\)", value)
    value = "{:g} to {:g}".format(*map(float, ends.groups())) if ends else value.replace("_", " ")
    return symbols(f"{CHOICES.get(name) or name.replace('_', ' ')} = {value}")


def place_of(variable: xr.DataArray, at_place: xr.Dataset) -> str:
    """Return the labels of a single number, such as Ω = 2."""
    values = {dim: at_place[dim].item() for dim in variable.dims}
    texts = [
        f"{CHOICES.get(dim, dim)} = {number(value) if isinstance(value, float) else value}"
        for dim, value in values.items()
    ]
    return symbols(", ".join(texts))


def speed(data: xr.Dataset) -> dict:
    """Return our solvers' shortest times in ms at the required error, and the ratios of peers."""
    best = 1e3 * data["best_seconds"].dropna("solver", how="all").dropna("case", how="all")
    winners = [str(name) for name in best.idxmin("solver").values]
    fastest = max(dict.fromkeys(winners), key=winners.count)
    wins = f"in {winners.count(fastest)} of {len(winners)} cases"
    titles = dict(zip(data["contestant"].values, data["title"].values, strict=True))
    peers = sorted(
        (data.sel(peer=peer) for peer in data["peer"].values),
        key=lambda peer: not peer["reached_cases"],
    )
    return {
        "fastest": f"{SOLVER_NAMES[fastest]} is the fastest solver here {wins}.",
        "head": ["case", "error", *(SOLVER_NAMES[str(name)] for name in best["solver"].values)],
        "least": [
            [
                case_of(data.sel(case=case)),
                number(data["target"].sel(case=case)),
                *(
                    number(time) if np.isfinite(time) else "not reached"
                    for time in best.sel(case=case).values
                ),
            ]
            for case in best["case"].values
        ],
        "peers": [
            [
                str(titles[str(peer["peer"].values)]),
                number(ratio := float(peer["mean_ratio"]))
                + (f" ({number(1 / ratio)} times faster)" if ratio < 1 else ""),
                number(peer["reached_cases"]),
            ]
            for peer in peers
        ],
    }


def speeds(accepted: Results) -> dict:
    """Return the time per site and step in ns by length, and peers on Newton's equations."""
    pendula, costs = accepted["speed/pendula"], accepted["speed/cost"]
    cost = costs["seconds"]
    titles, ratios = pendula["title"].to_series(), pendula["ratio"].transpose("peer", "case")
    return {
        "processor": accepted["speed/work_precision"].attrs["processor"],
        "cost_processor": accepted["speed/cost"].attrs["processor"],
        "target": pendula.attrs["compared_at"],
        "peers": [
            [
                titles[str(ratio["peer"].values)],
                " and ".join(map(number, ratio.dropna("case").values)),
            ]
            for ratio in ratios
            if ratio.notnull().any()
        ],
        "end_of_peers": number(costs.attrs["end_of_peers"]),
        "lengths": [f"{sites:,}" for sites in costs["length"].values],
        "peers_of_one_pair": [
            [str(title), *map(number, row)]
            for title, row in zip(costs["title"].values, costs["ratio"].values, strict=True)
        ],
        "sites": [
            [
                f"{sites:,}",
                *(
                    number(1e9 * cost.sel(sites=sites, solver=solver, start=start))
                    for solver in ("dop853", "taylor")
                    for start in ("all", "one")
                ),
            ]
            for sites in cost["sites"].values
        ],
    }


def scale(measured: dict) -> dict:
    """Return time and memory of a survey of many runs, and of a very long chain."""
    survey, solvers = measured["survey"], ("dop853", "taylor")
    chains = [measured[name] for name in solvers]
    return {
        "processor": survey["machine"]["processor"],
        "runs": f"{survey['runs']:,}",
        "half_width": str(survey["half_width"]),
        "survey_end": number(survey["end_time"]),
        "milliseconds": number(survey["milliseconds_a_run"], 2),
        "minutes": number(survey["runs"] * survey["milliseconds_a_run"] / 6e4, 2),
        "megabytes": f"{survey['megabytes']:.0f}",
        "many": f"{MANY:,}",
        "lanes": str(LANES),
        "surveys_processor": measured["surveys"]["machine"]["processor"],
        "surveys": [
            [str(sites), *(number(each, 2) for each in (alone, in_batch, in_batch / alone))]
            for sites, alone, in_batch in measured["surveys"]["rows"]
        ],
        "heyoka_processor": measured["heyoka"]["machine"]["processor"],
        "heyoka": number(measured["heyoka"]["ratio"], 2),
        "chain_processor": chains[0]["machine"]["processor"],
        "sites": f"{chains[0]['sites']:,}",
        "chain_end": number(chains[0]["end_time"]),
        "chains": [
            [
                SOLVER_NAMES[name],
                number(chain["microseconds_a_site"], 2),
                f"{chain['megabytes']:.0f}",
            ]
            for name, chain in zip(solvers, chains, strict=True)
        ],
    }


def first_calls(measured: dict) -> dict:
    """Return the parts of the processor time of first calls in s, and the least of them."""
    columns = ("import", "equations", "compiler", "LLVM", "total")
    floor = measured["seconds"]["two fields"]
    return {
        "processor": measured["machine"]["processor"],
        "import": number(floor["import"], 2),
        "llvm": number(floor["LLVM"], 2),
        "floor": number(floor["import"] + floor["LLVM"], 2),
        "total": number(floor["total"], 2),
        "rows": [
            [name, *(number(seconds.get(column, 0.0), 2) for column in columns)]
            for name, seconds in measured["seconds"].items()
        ],
    }


def full_run(measured: dict) -> dict:
    """Return wall and processor times of full runs in s, and their disk space in MB."""
    return {
        "processor": measured["machine"]["processor"],
        "cores": str(measured["machine"]["cores"]),
        "cold": f"{measured['runs']['cold']['wall']:.0f}",
        **{name: str(size) for name, size in measured["megabytes"].items()},
        "rows": [
            [reproduction.RUNS[name], f"{times['wall']:.0f}", f"{times['processor']:.0f}"]
            for name, times in measured["runs"].items()
        ],
    }
