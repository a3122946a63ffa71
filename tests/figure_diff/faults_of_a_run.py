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
from pendula.ledger.changes import exchange, put, roll, scale, shift
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


def pixels(stem: str, name: str, of: Callable[[Run], Image.Image]) -> Fault:
    """Return the fault of a picture with other pixels, and all that it says of itself."""

    def plant(run: Run):
        path, about = run.made / f"figures/{stem}.png", PngInfo()
        with Image.open(path) as image:
            for key, said in image.text.items():
                about.add_text(key, said)
        of(run).save(path, pnginfo=about)

    return Fault(name, f"figures/{stem}.png", plant)


def another(stem: str) -> Callable[[Run], Image.Image]:
    return lambda run: Image.open(run.made / f"figures/{stem}.png")


def reverse(*names: str, along: str = "tau") -> Callable:
    """Return a change that runs backwards along a dimension, whose labels stay."""
    return lambda d: d.assign(
        {n: d[n].isel({along: slice(None, None, -1)}).variable for n in names}
    )


def in_tail(name: str, change: Callable[[np.ndarray], np.ndarray]) -> Callable:
    """Return a change of the values of a variable in the tail."""

    def changed(d: xr.Dataset) -> xr.Dataset:
        late = (d["tau"] >= TAIL.start).values
        values = d[name].values.copy()
        values[..., late] = change(values[..., late])
        return d.assign({name: (d[name].dims, values, d[name].attrs)})

    return changed


def swap(one: str, other: str) -> Callable:
    """Return a change that exchanges two variables."""
    return lambda d: d.assign({one: d[other].variable, other: d[one].variable})


def line(panel: int, number: int, change: Callable) -> Callable:
    """Return a change of one curve of a figure."""
    return lambda figure: change(figure.axes[panel].lines[number])


def limits(panel: int, **ends) -> Callable:
    return lambda figure: figure.axes[panel].set(**ends)


def entry(*path, to) -> Callable:
    """Return a change of one entry of a claim, by a value or a function of it."""

    def change(row: dict):
        for part in path[:-1]:
            row = row[part]
        row[path[-1]] = to(row[path[-1]]) if callable(to) else to

    return change


FAULTS = [
    # Trajectories of chaotic cases
    *(
        data(f"trajectories/{file}", name, change)
        for file, name, change in (
            ("fig4_large", "time reversed", reverse("l2", "linf")),
            ("fig4_large", "tail of l2 reversed", in_tail("l2", lambda tail: tail[:, ::-1])),
            ("fig4_small", "linf above l2", scale("linf", 6.0, tau=TAIL)),
            ("fig4_small", "huge value", put("l2", 1e300, tau=45.0)),
            ("fig3_large", "negative norms", scale("l2", -1.0, tau=TAIL)),
            ("fig3_large", "energy jumps", scale("energy", 1.01, tau=TAIL)),
            (
                "fig4_large",
                "energy drifts",
                lambda d: d.assign(energy=d["energy"] * (1 + d["tau"] / 500)),
            ),
            ("fig4_large", "tail of l2 thrice as large", scale("l2", 3.0, tau=TAIL)),
            ("fig4_large", "tail of l2 10 % larger", scale("l2", 1.1, tau=TAIL)),
            ("fig4_small", "A and B exchanged in the tail", in_tail("l2", lambda tail: tail[::-1])),
            ("fig4_small", "tail frozen", put("linf", 4.0, tau=TAIL)),
            ("fig3_large", "NaN in the tail", put("l2", np.nan, tau=48.0)),
            ("fig4_large", "moduli of other sites", roll("modulus", {"site": 7})),
            ("fig4_large", "another gamma", lambda d: d.assign_attrs(gamma=1.1)),
            ("fig4_small", "another tolerance", lambda d: d.assign_attrs(solver_rtol=1e-6)),
            ("fig3_large", "tau shifted", lambda d: d.assign_coords(tau=d["tau"] + 0.025)),
        )
    ),
    # Sweeps and ensembles
    *(
        data(file, name, change)
        for file, name, change in (
            ("sweeps/fig5_right", "half-widths reversed", reverse("l2", along="half_width")),
            ("sweeps/fig5_right", "twice as large", scale("l2", 2.0)),
            ("sweeps/fig6_right", "a huge point", put("l2", 1e300, half_width=25)),
            ("sweeps/fig6_right", "linf above l2", swap("linf", "l2")),
            (
                "sweeps/fig6_right",
                "a half-width more",
                lambda d: d.assign_coords(half_width=d["half_width"] + 1),
            ),
            ("sweeps/fig6_right", "mean and maximum exchanged", exchange("statistic")),
            ("checks/ensembles", "quantiles exchanged", exchange("quantile")),
            ("checks/ensembles", "bands twice as large", scale("l2", 2.0)),
            ("checks/ensembles", "errors tenfold", scale("l2_error", 10.0)),
            ("checks/ensembles", "members", shift("swept_members", 1)),
            ("checks/ensembles", "detuning of the cases", shift("omega", 1.0)),
            ("checks/ensembles_uneven", "windows exchanged", exchange("window")),
            ("checks/members", "levels halved", scale(("l2_level", "linf_level"), 0.5)),
            ("checks/members", "start", scale("l2_start", 1.01)),
        )
    ),
    # Proved and predicted
    data("certified/breathers", "proven radius times 0.01", scale("radius", 0.01)),
    data("checks/trust", "proven bound times 0.01", scale("proven_bound", 0.01)),
    data("checks/cases", "bound of Theorem 1", scale("theorem_1", 1.01)),
    data("checks/cases", "bound of Theorem 3", scale("theorem_3", 0.99)),
    data("checks/cases", "P below its start", scale("observed", 0.01)),
    data("checks/threshold", "an error of a wave thousandfold", scale("wave_error", 1e3)),
    data("checks/solvers", "order that the paper states", scale("stated_drift", 10.0)),
    data("checks/solvers", "drift of a regular case", scale("drift", 10.0, case="fig2_small")),
    data("checks/trust", "solvers exchanged", exchange("solver")),
    data("unbounded/fronts", "linear speed", scale("linear_speed", 1.05)),
    data("unbounded/fronts", "speed of the second front doubled", scale("second_front_speed", 2.0)),
    data("unbounded/fronts", "thermal power", scale("thermal_power", 1.05)),
    data("unbounded/fig4_small", "front runs backwards", reverse("front", along="piece_tau")),
    data("unbounded/fig4_small", "predicted speed", scale("predicted_speed", 1.1)),
    data("unbounded/omegas", "linf above l2", swap("linf", "l2")),
    # Exponents, lives, fates, pendula
    data("checks/lyapunov", "exponent doubled", scale("exponent", 2.0)),
    data("checks/lyapunov", "limits exchanged", swap("exponent_low", "exponent_high")),
    data("checks/lyapunov", "growth reversed", reverse("log_growth")),
    data(
        "checks/lyapunov",
        "a chaotic case called regular",
        lambda d: d.assign(chaotic=d["chaotic"] * 0),
    ),
    data("checks/lifetimes", "surviving shares reversed", reverse("surviving")),
    data("checks/lifetimes", "negative lives", scale("life", -1.0)),
    data("checks/lifetimes", "limits exchanged", swap("surviving_low", "surviving_high")),
    data("breathers/fates", "amplitude of a case", shift("case_a0", 0.5)),
    data(
        "breathers/fates",
        "A_0 and B_0 exchanged",
        lambda d: d.assign(fate=(d["fate"].dims, d["fate"].values.swapaxes(1, 2))),
    ),
    data("breathers/fates", "all stay", lambda d: d.assign(fate=d["fate"] * 0 + 1)),
    data("pendula/remainder", "error of the expansion", scale("error", 1.5)),
    # Figures drawn otherwise than their data
    drawn("fig3", "curve reversed in time", line(2, 0, lambda c: c.set_ydata(c.get_ydata()[::-1]))),
    drawn("fig4", "A and B exchanged", drawn_from=reverse("l2", along="component")),
    drawn("fig4", "curve 10 % larger", line(0, 0, lambda c: c.set_ydata(1.1 * c.get_ydata()))),
    drawn("fig4", "curve hidden", line(1, 1, lambda c: c.set_visible(False))),
    drawn("fig4", "curve cut off", limits(1, ylim=(0, 8))),
    drawn("fig4", "y limits too wide", limits(1, ylim=(0, 300))),
    drawn("fig4", "y limits nearly doubled", limits(1, ylim=(0, 55))),
    drawn("fig3", "x limits", limits(3, xlim=(0, 40))),
    drawn("fig4", "logarithmic", limits(0, yscale="log")),
    drawn("fig4", "colours exchanged", line(0, 0, lambda c: c.set_color(style.BLUE))),
    drawn("fig4", "another run in the band", drawn_from=reverse("band_l2", along="initial_size")),
    drawn(
        "fig4",
        "curve ends early",
        line(0, 0, lambda c: c.set_data(c.get_xdata()[:1500], c.get_ydata()[:1500])),
    ),
    drawn(
        "fig4_spacetime",
        "moduli reversed in time",
        drawn_from=reverse("modulus", along="snapshot_tau"),
    ),
    drawn(
        "fig4_spacetime", "components exchanged", drawn_from=reverse("modulus", along="component")
    ),
    drawn("fig6", "panel of the other side", drawn_from=reverse("l2", along="panel")),
    drawn("energy_drift", "solvers exchanged", drawn_from=reverse("drift_so_far", along="solver")),
    drawn("trust_horizons", "bound times 0.01", drawn_from=scale("largest_bound", 0.01)),
    drawn(
        "lifetimes", "label of another amplitude", line(0, 0, lambda c: c.set_label("$A_0 = 6$"))
    ),
    drawn(
        "fronts",
        "two points of a line lost",
        line(2, 2, lambda c: c.set_data(c.get_xdata()[:-2], c.get_ydata()[:-2])),
    ),
    drawn("fronts", "unit of the speed", lambda figure: figure.axes[2].set(ylabel="speed")),
    # Figures of wrong data
    drawn("fig4", "l2 10 % larger than that of the run", gathered=scale("l2", 1.1)),
    drawn(
        "fig3",
        "bands of another case",
        gathered=lambda d: d.assign(band_l2=d["band_linf"].variable),
    ),
    drawn("fig4", "reversed in time", gathered=reverse("l2", "linf")),
    drawn("fig6", "linf above l2", gathered=scale("l2", -1.0)),
    drawn(
        "fig4_spacetime",
        "moduli of the other size",
        gathered=reverse("modulus", along="initial_size"),
    ),
    drawn("trust_horizons", "what only grows falls", gathered=reverse("largest_so_far")),
    drawn(
        "pendula_over_the_top",
        "shares reversed",
        gathered=reverse("passed", "passed_low", "passed_high"),
    ),
    # Pictures
    pixels("fig4_spacetime", "pixels of another figure", another("fig3_spacetime")),
    pixels("fig3", "darkened", lambda run: another("fig3")(run).point(lambda shade: shade // 2)),
    pixels(
        "fates",
        "upside down",
        lambda run: another("fates")(run).transpose(Image.Transpose.FLIP_TOP_BOTTOM),
    ),
    content("figures/fig4.png", "half a file", lambda found: found[: len(found) // 2]),
    # Ledger and tables
    row("ensemble_fig4_settles", "verdict", entry("verdict", to="not reproduced")),
    row(
        "ensemble_fig4_many",
        "criterion",
        entry("criterion", to=lambda said: said.replace("> 0.25", "> 0.05")),
    ),
    row("ensemble_fig4_many", "cut-off", entry("cutoffs", 0, "value", to=0.05)),
    row(
        "ensemble_fig6_time", "sentence", entry("says", to=lambda said: f"It is false that {said}")
    ),
    row("ensemble_fig4_alike", "what decides", entry("decided_by", to=["checks/cases"])),
    row(
        "ensemble_fig4_settles",
        "huge measured value",
        entry("measured", "even_growth_low", to=1e300),
    ),
    row(
        "fig2_exchange",
        "measured value of a regular case",
        entry("measured", "correlation", to=-0.9),
    ),
    row("ensemble_fig4_settles", "control that fails", entry("controls", 0, "passes", to=False)),
    row("one_integral", "place", entry("place", to="Section 2")),
    text("tables/claims.md", "verdict in a table", "| confirmed |", "| not reproduced |"),
    text("tables/claims.md", "cut-off in a table", '- 0.5 ("most"', '- 0.05 ("most"'),
    text("tables/claims_figures.md", "count of verdicts", "8 confirmed", "9 confirmed"),
    text("claims/unbounded.json", "verdict in a part", '"confirmed"', '"not reproduced"'),
    # Pages and files
    text("report.html", "verdict in the report", "not reproduced", "confirmed"),
    text("article.html", "word of the article", "unstable", "stable"),
    text("article.yaml", "author", "maintainers", "authors"),
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
