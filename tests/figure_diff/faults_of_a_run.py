"""Plant errors into a finished run, one by one, and count those that the figure diff finds.

    export PYTHONPATH=scripts:tests:tests/figure_diff
    python tests/figure_diff/faults_of_a_run.py RESULTS [BASELINE]

A run with the accepted bits is judged as in the accepted environment, and as with other versions. A
run with other last bits, as `.ci/elsewhere moved` makes them, must be right as it is. FAULTS is the
table of errors: those that code, a library or a person may make.
"""

import shutil
import sys
from collections.abc import Callable
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import NamedTuple

import numpy as np
import xarray as xr
from accepted_figures import FIGURES as DRAWN
from conftest import Run
from latticode.datasets.json_files import load_json
from latticode.datasets.netcdf import read
from latticode.drawing import style
from pendula.figure_diff import baseline
from pendula.ledger.changes import put, scale, shift
from PIL import Image
from PIL.PngImagePlugin import PngInfo

ROOT = Path(__file__).resolve().parents[2]
TAIL = slice(40, None)
"""Times at which each chaotic case has long left every reference."""


class Fault(NamedTuple):
    """What is wrong, in which file, and what plants it into a run."""

    name: str
    file: str
    plant: Callable[[Run], None]


def data(file: str, name: str, change: Callable[[xr.Dataset], xr.Dataset]) -> Fault:
    """Return the fault of a dataset."""
    return Fault(name, f"{file}.nc", lambda run: run.change(f"{file}.nc", change))


def text(file: str, name: str, old: str, new: str) -> Fault:
    """Return the fault of a text, or of a ledger with a new checksum."""

    def plant(run: Run):
        run.edit(file, old, new)

    return Fault(name, file, plant)


def row(claim: str, name: str, change: Callable[[dict], None]) -> Fault:
    """Return the fault of one claim of the ledger, with a new checksum."""

    def plant(run: Run):
        ledger = load_json(run.made / "claims.json")
        change(next(row for row in ledger["rows"] if row["name"] == claim))
        run.write("claims.json", {"rows": ledger["rows"]})

    return Fault(name, "claims.json", plant)


def drawn(stem: str, name: str, change=None, drawn_from=None, gathered=None) -> Fault:
    """Return the fault of a figure that is changed, drawn from other data, or gathered wrongly."""

    def plant(run: Run):
        shown = read(run.made / f"figures/{stem}.nc")
        shown = gathered(shown) if gathered else shown
        figure = DRAWN[stem][0](drawn_from(shown) if drawn_from else shown)
        if change:
            change(figure)
        paths = [run.made / f"figures/{stem}.{kind}" for kind in ("png", "pdf", "nc", "json")]
        style.save(figure, shown, *paths)

    return Fault(name, f"figures/{stem}.{'nc' if gathered else 'json'}", plant)


def content(file: str, name: str, change: Callable[[bytes], bytes]) -> Fault:
    """Return the fault of a file whose bytes are changed."""

    def plant(run: Run):
        (run.made / file).write_bytes(change((run.made / file).read_bytes()))

    return Fault(name, file, plant)


def pixels(stem: str, name: str, other: str) -> Fault:
    """Return the fault of a picture with the pixels of another, and all that it says of itself."""

    def plant(run: Run):
        path, about = run.made / f"figures/{stem}.png", PngInfo()
        with Image.open(path) as image:
            for key, said in image.text.items():
                about.add_text(key, said)
        Image.open(run.made / f"figures/{other}.png").save(path, pnginfo=about)

    return Fault(name, f"figures/{stem}.png", plant)


def reverse(*names: str, along: str = "tau") -> Callable:
    """Return a change that runs backwards along a dimension, whose labels stay."""
    return lambda d: d.assign(
        {n: d[n].isel({along: slice(None, None, -1)}).variable for n in names}
    )


def line(panel: int, number: int, change: Callable) -> Callable:
    """Return a change of one curve of a figure."""
    return lambda figure: change(figure.axes[panel].lines[number])


def entry(*path, to) -> Callable:
    """Return a change of one entry of a claim, by a value or a function of it."""

    def change(row: dict):
        for part in path[:-1]:
            row = row[part]
        row[path[-1]] = to(row[path[-1]]) if callable(to) else to

    return change


FAULTS = [
    # Trajectories of chaotic cases
    data("trajectories/fig4_large", "time reversed", reverse("l2", "linf")),
    data("trajectories/fig4_small", "linf above l2", scale("linf", 6.0, tau=TAIL)),
    data("trajectories/fig4_small", "huge value", put("l2", 1e300, tau=45.0)),
    data("trajectories/fig3_large", "negative norms", scale("l2", -1.0, tau=TAIL)),
    data("trajectories/fig3_large", "energy jumps", scale("energy", 1.01, tau=TAIL)),
    data("trajectories/fig4_large", "tail of l2 thrice as large", scale("l2", 3.0, tau=TAIL)),
    data("trajectories/fig3_large", "NaN in the tail", put("l2", np.nan, tau=48.0)),
    data("trajectories/fig4_large", "another gamma", lambda d: d.assign_attrs(gamma=1.1)),
    data(
        "trajectories/fig3_large",
        "tau shifted",
        lambda d: d.assign_coords(tau=d["tau"] + 0.025),
    ),
    # Sweeps and ensembles
    data("sweeps/fig5_right", "twice as large", scale("l2", 2.0)),
    data("sweeps/fig6_right", "a huge point", put("l2", 1e300, half_width=25)),
    data(
        "sweeps/fig6_right",
        "a half-width more",
        lambda d: d.assign_coords(half_width=d["half_width"] + 1),
    ),
    data("checks/members", "bands twice as large", scale("l2", 2.0)),
    data("checks/ensembles", "errors tenfold", scale("l2_error", 10.0)),
    data("checks/ensembles", "members", shift("swept_members", 1)),
    data("checks/members", "start", scale("l2_start", 1.01)),
    # Proved and predicted
    data("certified/breathers", "proven radius times 0.01", scale("radius", 0.01)),
    data("checks/cases", "bound of Theorem 1", scale("theorem_1", 1.01)),
    data("checks/solvers", "drift of a regular case", scale("drift", 10.0, case="fig2_small")),
    data("unbounded/fronts", "linear speed", scale("linear_speed", 1.05)),
    data("unbounded/fronts", "speed of the second front doubled", scale("second_front_speed", 2.0)),
    # Exponents, lives, fates
    data("checks/lyapunov", "exponent doubled", scale("exponent", 2.0)),
    data("checks/lyapunov", "a chaotic case called regular", put("chaotic", 0)),
    data("checks/lifetimes", "negative lives", scale("life", -1.0)),
    # Figures drawn otherwise than their data
    drawn("fig3", "curve reversed in time", line(2, 0, lambda c: c.set_ydata(c.get_ydata()[::-1]))),
    drawn("fig4", "A and B exchanged", drawn_from=reverse("l2", along="component")),
    drawn("fig4", "curve hidden", line(1, 1, lambda c: c.set_visible(False))),
    drawn("fig4", "y limits too wide", lambda figure: figure.axes[1].set(ylim=(0, 300))),
    drawn("fig3", "x limits", lambda figure: figure.axes[3].set(xlim=(0, 40))),
    drawn("fig4", "logarithmic", lambda figure: figure.axes[0].set(yscale="log")),
    drawn("fig4", "colours exchanged", line(0, 0, lambda c: c.set_color(style.BLUE))),
    drawn(
        "fig4",
        "curve ends early",
        line(0, 0, lambda c: c.set_data(c.get_xdata()[:1500], c.get_ydata()[:1500])),
    ),
    drawn("fig3", "another label", lambda figure: figure.axes[2].set(ylabel="norm")),
    # Figures of wrong data
    drawn("fig4", "l2 thrice that of the run", gathered=scale("l2", 3.0)),
    drawn("fig4", "reversed in time", gathered=reverse("l2", "linf")),
    drawn("fig6", "negative", gathered=scale("l2", -1.0)),
    # Pictures
    pixels("fig4_spacetime", "pixels of another figure", "fig3_spacetime"),
    content("figures/fig4.png", "half a file", lambda found: found[: len(found) // 2]),
    # Ledger and tables
    row("ensemble_fig4_settles", "verdict", entry("verdict", to="not reproduced")),
    row(
        "ensemble_fig4_many",
        "criterion",
        entry("criterion", to=lambda said: said.replace("> 0.25", "> 0.05")),
    ),
    row("ensemble_fig4_many", "cut-off", entry("cutoffs", 0, "value", to=0.05)),
    row("ensemble_fig4_alike", "what decides", entry("decided_by", to=["checks/cases"])),
    row("ensemble_fig4_settles", "huge value", entry("measured", "growth_low", to=1e300)),
    row("fig2_exchange", "value of a regular case", entry("measured", "correlation", to=-0.9)),
    row("ensemble_fig4_settles", "control that fails", entry("controls", 0, "passes", to=False)),
    text("tables/claims.md", "verdict in a table", "| confirmed |", "| not reproduced |"),
    text("claims/unbounded.json", "verdict in a part", '"confirmed"', '"not reproduced"'),
    # Pages
    text("report.html", "verdict in the report", "not reproduced", "confirmed"),
    text("article.html", "word of the article", "unstable", "stable"),
    text("live.html", "code of the live page", "function", "funktion"),
    content("article.pdf", "half an article", lambda found: found[: len(found) // 2]),
    content("report.html", "emptied report", lambda found: b""),
]


def found(run: Run, known: dict, fault: Fault, strict: bool, comparison) -> bool:
    """Return whether a planted fault fails the comparison of the file, or of one beside it."""
    stem = fault.file.rpartition(".")[0]
    files = [name for name in known if name.rpartition(".")[0] == stem]
    kept = {name: (run.made / name).read_bytes() for name in files}
    try:
        fault.plant(run)
        comparison.found = {name: each for name, each in known.items() if name not in files}
        findings = [comparison.look_at(name) for name in sorted(files, key=baseline.place)]
        return any(comparison.strictly(each, not strict).status.is_fault for each in findings)
    finally:
        for name, before in kept.items():
            (run.made / name).write_bytes(before)


def main(results: str, accepted: str = str(ROOT / "tests/baseline")) -> int:
    """Print what is missed in each way of judging; return 1 if the run itself is found faulty."""
    record = baseline.recorded(Path(accepted))
    with TemporaryDirectory() as folder:
        run = Run(Path(shutil.copytree(results, Path(folder) / "results")), Path(accepted))
        comparison = baseline.Comparison(record, *run)
        known = {each.name: each for each in comparison.look_at_all(set(record["files"]))}
        for each in known.values():
            if each.status.is_fault:
                print(f"the run itself: {each.status}: {each.name}: {each.says}")
        same = all(each.status == "identical" for each in known.values())
        for strict in (True, False) if same else (False,):
            missed = [each for each in FAULTS if not found(run, known, each, strict, comparison)]
            way = "accepted environment" if strict else "other versions" if same else "other bits"
            print(f"{way}: {len(FAULTS) - len(missed)} of {len(FAULTS)} are found")
            print(*(f"  missed: {each.file}: {each.name}" for each in missed), sep="\n")
    return int(any(each.status.is_fault for each in known.values()))


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
