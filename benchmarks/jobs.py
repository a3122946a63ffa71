"""What the jobs of `snakemake speed` call: each measures, tabulates or draws."""

import os
from collections.abc import Mapping
from functools import partial

import xarray as xr
from latticode.datasets.netcdf import read, write
from latticode.datasets.trajectories import Contents
from latticode.drawing.style import save
from latticode.kernels.sources import describe_machine
from pendula.problem import Problem, by_name
from pendula.report.words import number, write_markdown

from benchmarks import cost, figures, pendula
from benchmarks.contestants import PEERS, Contestant, find_peers
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
    return variables, {"title": "Speed against error", "absent": absent, **_machine()}


def measure_pendula(problems: Mapping[str, Mapping], data: str, table: str) -> None:
    """Measure the pendula of the cases `problems`, and write a dataset and a page of Markdown."""
    peers, absent = installed(OF_PENDULA)
    variables = pendula.measure(by_name(problems), peers, say)
    title = {"title": "Speed against error on the pendula", "absent": absent}
    title["compared_at"] = number(pendula.TARGET)
    write(data, variables, {**title, **_machine()})
    write_markdown(table, *tabulate_pendula(read(data)))


def measure_cost(data: str, table: str) -> None:
    """Measure how the cost grows with the chain, and write a dataset and a page of Markdown."""
    write(data, cost.measure(), {"title": "How the cost of a run grows", **_machine()})
    write_markdown(table, *tabulate_cost(read(data)))


def show_speed(
    work_precision: str, work_precision_table: str, regimes: list[str], files: list[str]
) -> None:
    """Write a page of Markdown, and draw a figure for each regime.

    `files` has the PNG, PDF, data and description of each figure in this order.
    """
    measured = read(work_precision)
    write_markdown(work_precision_table, *tabulate_work_precision(measured))
    for first, regime in zip(range(0, len(files), 4), regimes, strict=True):
        data = figures.gather_work_precision(measured, regime)
        save(figures.draw_work_precision(data), data, *files[first : first + 4])


def _machine() -> dict[str, str]:
    """Return the machine, and the processor that the code is made for where it is another one."""
    played = os.environ.get("NUMBA_CPU_NAME")
    return describe_machine() | ({"code_for": played} if played else {})
