"""How far right reproductions differ where the motion is chaotic: what the figure diff allows.

    python -m benchmarks.spreads run 16 FOLDER        makes FOLDER/1/results ... FOLDER/16/results
    python -m benchmarks.spreads measure . FOLDER/*   writes tests/baseline/spreads.nc

Each whole run is made in a copy of the project in which one line moves epsilon by k * 1e-15 of
itself, which is less than any measurement and more than rounding. Chaos makes of it a run that is
as right as the accepted one and shares no point with it beyond the horizon. `measure` takes folders
that hold `results`, first the one of the accepted run; it prints which curves moved although no
rule of the table names them, and which statistics would have accused one of the runs by the spreads
of all others: those are widened until they do not.

Only the kernels see the moved epsilon. Checks that compare them with a formula in Python therefore
see a residual that grows with k; they belong to the rounding errors, or stay exact.
"""

import itertools
import shutil
import subprocess
import sys
from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence
from hashlib import sha256
from pathlib import Path
from typing import NamedTuple

import numpy as np
from pendula.datasets.netcdf import Variable, as_xarray, save
from pendula.figure_diff import hashes, tolerances
from pendula.figure_diff.compare_curves import MOST_OVER, Curve, curves, lines, trusted
from pendula.figure_diff.structure import COUNTS, DISTANCES, STATISTICS, describe, distances
from pendula.figure_diff.tolerances import REGULAR, REGULAR_LIMIT, SPREADS, Rule, Spread, Spreads
from scipy.optimize import brentq
from scipy.special import digamma, polygamma

from .reproduction import LEFT_OUT, ROOT

BASELINE = ROOT / "tests" / "baseline"
MOVED_LINE = ("scripts/pendula/simulation/models.py", "float(constants.epsilon)")
SMALLEST_MOVE = 0.1 * REGULAR_LIMIT
"""A curve has moved, and its horizon has passed, where two runs differ by this fraction."""
MOST_FREEDOM = 200.0
"""Curves of one run are correlated, so pooling them never gives more degrees of freedom."""
LEAST_GROUP = 4
"""Where fewer curves of a variable vary, all curves of their rule say what is usual."""
LEAST_OF_TYPICAL = 0.5
"""A spread is at least so much of the typical one of its group. The largest value of a tail, say,
may be reached before the runs part in all runs but the one that is compared."""
LEAST_COUNT = 0.3
"""Where gaps and infinities come and go at all, one more or less is no fault."""
LEAST_COPIED = 8
"""Fewer values are the same by chance, as times of output are."""
LEAST_SPREAD = 1e-7
"""The single precision of the baseline: no spread is smaller."""


def run(k: int, folder: Path) -> None:
    """Make everything in a copy of the project with epsilon moved by k * 1e-15 of itself."""
    project = folder / str(k)
    shutil.copytree(ROOT, project, ignore=LEFT_OUT)
    name, old = MOVED_LINE
    text = (project / name).read_text()
    if text.count(old) != 1:
        sys.exit(f"{name} holds `{old}` {text.count(old)} times: say anew where epsilon is moved")
    (project / name).write_text(text.replace(old, f"{old} * (1 + {k}e-15)"))
    subprocess.run([sys.executable, "-m", "snakemake"], cwd=project, check=True)


def kept(path: Path):
    """Return a dataset as the baseline keeps it."""
    return hashes.as_dataset(hashes.as_kept(hashes.read(path)))


class Measured(NamedTuple):
    """One curve in all runs."""

    label: str
    group: tuple[str, str]
    """The name of its rule, and the variable: curves of one group have similar spreads."""
    scale: float
    horizon: float
    told: np.ndarray
    """(run, statistic)"""
    apart: np.ndarray
    """(run, run, distance), NaN on the diagonal"""
    widest: bool = False
    """Whether each curve of its group is given the largest spread of them."""
    content: str = ""
    """A hash of the values in all runs: curves with one hash are copies of each other."""


def names_in(results: Path) -> list[str]:
    """Return the datasets of a run that are made anew; references are given to it."""
    names = (path.relative_to(results).as_posix() for path in results.rglob("*.nc"))
    return sorted(name for name in names if not name.startswith(("truth/", "reference/")))


def measure(members: Sequence[Path], names: Iterable[str], rules: list[Rule]) -> list[Measured]:
    """Return what the runs in the folders `members` say about the datasets `names` below them."""
    return [each for name in names for each in measure_file(name, members, rules)]


def measure_file(name: str, members: Sequence[Path], rules: list[Rule]) -> Iterator[Measured]:
    """Yield every curve of one dataset that differs between the runs, and prints the nameless."""
    runs = [kept(member / name) for member in members]
    by_label = [{c.label: c for c in curves(data, name.removesuffix(".nc"))} for data in runs]
    of_variable: dict[str, list[Measured]] = {}
    for label, first in by_label[0].items():
        same = [each[label] for each in by_label]
        rule = tolerances.rule_for(rules, label, first.largest)
        if first.values.dtype.kind not in "fiub" or not _moved(same, rule):
            continue
        if rule is REGULAR:
            if first.values.dtype.kind != "f" or _moved(same, rule, REGULAR_LIMIT):
                print(f"moves without a rule: {label}")
            continue
        found = measure_curve(label, same, rule)
        of_variable.setdefault(label.partition(" ")[0], []).append(found)
        yield found
    for variable, several in of_variable.items():
        if len(several) > 1:
            yield _together(variable, several)


def _moved(same: list[Curve], rule: Rule, least: float = SMALLEST_MOVE) -> bool:
    values = np.array([c.values for c in same], float)
    finite = np.isfinite(values)
    if (finite != finite[0]).any():
        return True
    range_of = np.ptp(np.where(finite, values, 0), axis=0)
    if rule.method == "size" or same[0].values.dtype.kind != "f":
        return bool(range_of.any())
    return bool((range_of > least * max(c.largest for c in same)).any())


def measure_curve(label: str, same: list[Curve], rule: Rule) -> Measured:
    """Return what the runs say about one curve."""
    values = np.array([lines(curve, rule) for curve in same])
    scale = 1.0
    if not rule.logs:
        scale = float(np.sqrt(np.mean(values[np.isfinite(values)] ** 2))) or 1.0
    horizon = -1.0 if rule.method == "size" else _horizon(same)
    start = trusted(same[0], horizon)
    apart = np.full((len(same), len(same), len(DISTANCES)), np.nan)
    for i, j in itertools.combinations(range(len(same)), 2):
        apart[i, j] = apart[j, i] = distances(values[i] / scale, values[j] / scale, start)
    told = np.array([describe(one / scale, start) for one in values])
    if rule.logs:  # the smallest of many errors says how near one of them came to zero
        told[:, list(STATISTICS).index("bottom")] = np.nan
    variable = label.partition(" ")[0].partition(":")[2]
    content = ""
    if same[0].values.size >= LEAST_COPIED:
        content = sha256(np.array([c.values for c in same]).tobytes()).hexdigest()
    return Measured(label, (rule.name, variable), scale, horizon, told, apart, rule.widest, content)


def _horizon(same: list[Curve]) -> float:
    """Return the last time before two runs differ anywhere; -1 where they differ at once."""
    if same[0].tau is None:
        return -1.0
    values = np.array([c.values for c in same], float)
    values = np.where(np.isfinite(values), values, 0).reshape(len(same), -1, values.shape[-1])
    apart = np.ptp(values, axis=0).max(0) > SMALLEST_MOVE * min(c.largest for c in same)
    first = int(apart.argmax()) if apart.any() else apart.size
    return float(same[0].tau[first - 1]) if first else -1.0


def _together(variable: str, several: list[Measured]) -> Measured:
    told = np.mean([each.told for each in several], axis=0)
    rule, name = several[0].group
    apart = np.full_like(several[0].apart, np.nan)
    label = f"{variable} {tolerances.TOGETHER}"
    group, widest = (rule, f"{name}, {tolerances.TOGETHER}"), several[0].widest
    return Measured(label, group, 1.0, -1.0, told, apart, widest)


def pooled(
    measured: Sequence[Measured], spread: np.ndarray, freedom: int
) -> tuple[np.ndarray, np.ndarray]:
    """Return spreads (curve, statistic) drawn towards those of their group, and their freedom.

    A spread from few runs is itself uncertain. Where the curves of a group scatter no more than
    that uncertainty explains, they are taken to have one spread, and otherwise each keeps its own:
    the law of the variances is a scaled inverse chi-square, fitted by moments of their logarithms.

    Source: G. K. Smyth, Stat. Appl. Genet. Mol. Biol. 3 (2004), article 3, section 6.2.
    """
    spread = np.maximum(spread, LEAST_SPREAD)
    found, degrees = spread.copy(), np.where(np.isfinite(spread), float(freedom), np.nan)
    counts = [name in COUNTS for name in STATISTICS]
    varies = np.isfinite(spread) & (spread > LEAST_SPREAD)
    groups = [each.group for each in measured]
    widest = {each.group for each in measured if each.widest}
    for group in sorted(set(groups)):
        mine = np.array([each == group for each in groups])
        rule = np.array([each[0] == group[0] for each in groups])
        for column in range(spread.shape[1]):
            own = mine & varies[:, column]
            like = own if own.sum() >= LEAST_GROUP else rule & varies[:, column]
            if counts[column] and like.any():
                found[mine, column] = np.maximum(found[mine, column], LEAST_COUNT)
            if like.sum() < LEAST_GROUP or not own.any():
                continue
            typical, prior = _prior(np.log(spread[like, column] ** 2), freedom)
            drawn = prior * typical + freedom * found[mine, column] ** 2
            found[mine, column] = np.sqrt(drawn / (prior + freedom))
            degrees[mine, column] = min(prior + freedom, MOST_FREEDOM)
            least = LEAST_OF_TYPICAL * np.median(spread[own, column])
            if group in widest:
                least = spread[own, column].max()
            found[mine, column] = np.maximum(found[mine, column], least)
    return found, degrees


def _prior(logs: np.ndarray, freedom: int) -> tuple[float, float]:
    """Return the typical variance of a group, and the degrees of freedom that it is worth."""
    scatter = float(logs.var(ddof=1)) - float(polygamma(1, freedom / 2))
    mean = float(logs.mean()) - float(digamma(freedom / 2)) + np.log(freedom / 2)
    most = 2.0 * MOST_FREEDOM
    if scatter <= polygamma(1, most / 2):
        return float(np.exp(mean)), most
    prior = 2 * brentq(lambda half: polygamma(1, half) - scatter, 1e-3, most / 2)
    return float(np.exp(mean + digamma(prior / 2) - np.log(prior / 2))), prior


def copies(measured: Sequence[Measured]) -> list[str]:
    """Return for each curve the label of another that is the same in all runs, or nothing."""
    alike = defaultdict(list)
    for each in measured:
        if each.content:
            alike[each.content].append(each.label)
    following = {}
    for labels in alike.values():
        if len(labels) > 1:
            following |= dict(zip(labels, [*labels[1:], labels[0]], strict=True))
    return [following.get(each.label, "") for each in measured]


def tabulate(measured: Sequence[Measured], runs: np.ndarray) -> dict[str, Variable]:
    """Return the variables of the file, from the runs with these numbers."""
    groups = [each.group for each in measured]
    told = np.array([each.told[runs] for each in measured])
    apart = np.array([each.apart[np.ix_(runs, runs)] for each in measured])
    above = apart[:, *np.triu_indices(len(runs), 1)]
    spread, freedom = pooled(measured, told.std(1, ddof=1), len(runs) - 1)
    far, far_freedom = pooled(measured, above.std(1, ddof=1), len(runs) - 1)
    grid, pairs = ("curve", "of"), ("curve", "distance")
    text = {
        "curve": Variable(("curve",), np.array([each.label for each in measured]), "curve"),
        "of": Variable(("of",), np.array(list(STATISTICS)), "statistic of the tail"),
        "distance": Variable(("distance",), np.array(list(DISTANCES)), "distance of two runs"),
        "rule": Variable(("curve",), np.array([each[0] for each in groups]), "rule of the table"),
        "copy_of": Variable(("curve",), np.array(copies(measured)), "curve that is the same"),
    }
    numbers = {
        "scale": (("curve",), [each.scale for each in measured], "scale of the curve"),
        "horizon": (("curve",), [each.horizon for each in measured], "horizon of trust, slow time"),
        "spread": (grid, spread, "standard deviation between runs, divided by the scale"),
        "freedom": (grid, freedom, "degrees of freedom of the spread"),
        "apart_mean": (pairs, above.mean(1), "mean log distance of two runs"),
        "apart_spread": (pairs, far, "standard deviation of that log"),
        "apart_freedom": (pairs, far_freedom, "degrees of freedom of that spread"),
    }
    made = {
        name: Variable(dims, np.array(values), about)
        for name, (dims, values, about) in numbers.items()
    }
    return text | made


def accusations(measured: Sequence[Measured]) -> np.ndarray:
    """Return by how much each run is off from the next, in units of what all others allow.

    The shape is (run, curve, statistic), with the distances after the statistics; more than 1 would
    accuse a right run.
    """
    runs = range(measured[0].told.shape[0])
    found = []
    for one in runs:
        other = (one + 1) % len(runs)
        others = np.array([k for k in runs if k not in (one, other)])
        data = as_xarray(tabulate(measured, others), {"members": len(others)})
        spreads = Spreads.of_dataset(data)
        found.append([_excess(each, spreads.get(each.label), one, other) for each in measured])
    return np.nan_to_num(np.array(found))


def _excess(each: Measured, spread: Spread, one: int, other: int) -> np.ndarray:
    off = abs(each.told[one] - each.told[other]) / spread.allowed
    over = np.minimum(each.apart[one, other] - spread.farthest, MOST_OVER)
    return np.concatenate([off, np.exp(over)])


def in_words(measured: Sequence[Measured], excess: np.ndarray) -> Iterator[str]:
    """Yield one line for each statistic that would accuse a right run, and their number."""
    names = [*STATISTICS, *DISTANCES]
    for run_, curve, column in np.argwhere(excess > 1):
        by = f"{names[column]}, {excess[run_, curve, column]:.2f} times what is allowed"
        yield f"run {run_} and the next: {measured[curve].label}: {by}"
    accused = (excess > 1).any((1, 2)).sum()
    yield f"{accused} of {len(excess)} pairs of right runs would be accused without the widening"


def widening(measured: Sequence[Measured], excess: np.ndarray) -> np.ndarray:
    """Return factors (curve, statistic) of at least 1 with which no run accuses the next.

    Some laws have heavier tails than Student's. Where a right run was accused, the same statistic
    of all curves of the group is allowed as much more.
    """
    worst, factors = np.maximum(excess.max(0), 1.0), np.ones(excess.shape[1:])
    groups = [each.group for each in measured]
    for group in set(groups):
        mine = np.array([each == group for each in groups])
        factors[mine] = worst[mine].max(0)
    return factors


def write(path: Path, measured: Sequence[Measured], excess: np.ndarray) -> None:
    """Write the file that the figure diff reads, compressed and in single precision."""
    members = measured[0].told.shape[0]
    factors = widening(measured, excess)
    made = tabulate(measured, np.arange(members))
    wider = {
        "spread": made["spread"].values * factors[:, : len(STATISTICS)],
        "apart_mean": made["apart_mean"].values + np.log(factors[:, len(STATISTICS) :]),
    }
    made |= {name: made[name]._replace(values=values) for name, values in wider.items()}
    data = as_xarray(made, {"title": "spreads of results of right runs", "members": members})
    for variable in data.variables.values():
        if variable.dtype.kind == "f":
            variable.encoding = {"dtype": "float32", "zlib": True, "complevel": 9}
    save(path, data)


def main() -> None:
    """Run or measure, as the head of this module says."""
    match sys.argv[1:]:
        case ["run", count, folder]:
            for k in range(1, int(count) + 1):
                run(k, Path(folder))
        case ["measure", *folders] if len(folders) > 3:
            members = [Path(folder) / "results" for folder in folders]
            measured = measure(members, names_in(members[0]), tolerances.read_rules(BASELINE))
            excess = accusations(measured)
            write(BASELINE / SPREADS, measured, excess)
            print("\n".join(in_words(measured, excess)))
        case _:
            sys.exit(__doc__)


if __name__ == "__main__":
    main()
