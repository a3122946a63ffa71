"""The pages on the paper's cases as a full run makes them, of the accepted results."""

import json
from pathlib import Path

import problems
from facts import Accepted
from helpers import ROOT
from latticode.datasets.netcdf import read, write
from oracle import CASES
from pendula.article.live_figures import gather_live_parts
from pendula.article.write import ARTICLE
from pendula.live.write import write_live
from pendula.problem import PaperProblem
from pendula.studies.paper.runs import run_case
from replication.figure_diff import hashes

BASELINE = ROOT / "tests/baseline"
LARGEST_LIVE_PAGE = 400_000
"""Bytes."""


def problem_of(case: str, **changes) -> PaperProblem:
    """Return a problem as the live page solves it."""
    solver = {"name": "ode45", "rtol": 1e-7, "atol": 1e-9}
    return problems.problem_of(case, **{"end_time": 50.0, "solver": solver, **changes})


def make_live_page(folder: Path) -> Path:
    """Write the live page of runs that have the accepted bits."""
    accepted = json.loads((BASELINE / "hashes.json").read_text())["files"]
    runs = [folder / f"{case}.nc" for case in CASES]
    for case, path in zip(CASES, runs, strict=True):
        write(path, *run_case(case, problem_of(case, snapshot_every=4)))
        variables = accepted[f"trajectories/{path.name}"]["variables"]
        assert hashes.of(read(path))["variables"] == variables
    page = folder / "live.html"
    checks = [str(BASELINE / f"checks/{name}.nc") for name in ("trust", "chart")]
    write_live([*map(str, runs)], *checks, str(page))
    assert page.stat().st_size < LARGEST_LIVE_PAGE
    return page


def make_article(live_page: Path) -> Path:
    """Write the article of the accepted results beside the live page, whose solver it runs."""
    references = [str(BASELINE / f"reference/{case}.nc") for case in CASES]
    live_parts = gather_live_parts(Accepted(), str(live_page), references)
    page = live_page.with_name("article.html")
    page.write_text(ARTICLE.page(Accepted(), live_parts), encoding="utf-8")
    return page
