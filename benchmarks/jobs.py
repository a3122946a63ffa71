"""What the jobs of `snakemake speed` call: each measures, tabulates or draws."""

from collections.abc import Mapping
from functools import partial

import xarray as xr
from pendula.datasets.netcdf import read, write
from pendula.datasets.trajectories import Contents
from pendula.drawing.style import save
from pendula.problem import Problem, by_name
from pendula.report.words import number, write_markdown

from benchmarks import figures, machine, pendula
from benchmarks.contestants import PEERS, Contestant, find_peers
from benchmarks.cost import measure
from benchmarks.peer import Peer
from benchmarks.peers_in_python import OF_PENDULA
from benchmarks.problems import REGIME_OF, REGIMES, read_reference, until
from benchmarks.tables import tabulate_cost, tabulate_pendula, tabulate_work_precision
from benchmarks.work_precision import measure as measure_errors

say = partial(print, flush=True)


def installed(peers: Mapping[str, Peer]) -> tuple[dict[str, Contestant], str]:
    """Return the peers that are installed, and why the others are not, which is also printed."""
    present, absent = find_peers(peers)
    for reason in absent.values():
        print(f"not measured: {reason}")
    return present, "; ".join(absent.values())


def measure_work_precision(
    references: Mapping[str, xr.Dataset], problems: Mapping[str, Problem]
) -> Contents:
    """Time every solver and every installed peer on `problems`, beside the errors they make."""
    cases, exact = {}, {}
    for name, problem in problems.items():
        horizon = REGIMES[REGIME_OF[name]].horizon
        cases[name] = until(problem, horizon)
        exact[name] = read_reference(references[name], horizon)
    peers, absent = installed(PEERS)
    variables = measure_errors(cases, exact, peers, say)
    return variables, {"title": "Speed against error", "absent": absent, **machine.describe()}


def measure_pendula(problems: Mapping[str, Mapping], data: str, table: str) -> None:
    """Measure the pendula of the cases `problems`, and write a dataset and a page of Markdown."""
    peers, absent = installed(OF_PENDULA)
    variables = pendula.measure(by_name(problems), peers, say)
    title = {"title": "Speed against error on the pendula", "absent": absent}
    title["compared_at"] = number(pendula.TARGET)
    write(data, variables, {**title, **machine.describe()})
    write_markdown(table, *tabulate_pendula(read(data)))


def measure_cost(problem: Problem) -> Contents:
    """Measure how the cost grows with the chain, with time and with the active sites."""
    return measure(problem), {"title": "How the cost of a run grows", **machine.describe()}


def show_speed(
    work_precision: str,
    cost: str,
    work_precision_table: str,
    cost_table: str,
    regimes: list[str],
    files: list[str],
) -> None:
    """Write both pages of Markdown, and draw a figure for each regime and one of the cost.

    `files` has the PNG, PDF, data and description of each figure in this order.
    """
    measured, costs, drawn = read(work_precision), read(cost), []
    write_markdown(work_precision_table, *tabulate_work_precision(measured))
    write_markdown(cost_table, *tabulate_cost(costs))
    for regime in regimes:
        data = figures.gather_work_precision(measured, regime)
        drawn.append((figures.draw_work_precision(data), data))
    data = figures.gather_cost(costs)
    drawn.append((figures.draw_cost(data), data))
    for first, (figure, data) in zip(range(0, len(files), 4), drawn, strict=True):
        save(figure, data, *files[first : first + 4])
