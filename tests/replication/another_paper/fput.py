"""A small replication of Fermi, Pasta, Ulam and Tsingou (1955): energy returns to the first mode.

It uses the rooms of `replication` for another paper, as docs/another_paper.md describes.
"""

from functools import cache
from pathlib import Path

import numpy as np
import xarray as xr
from latticode.datasets.netcdf import save
from latticode.drawing import style
from matplotlib.figure import Figure
from replication.figure_diff import ComparisonResult as ComparisonResult
from replication.figure_diff import acceptance, baseline
from replication.ledger.changes import scale
from replication.ledger.claim import Claim, ClaimControl, claim
from replication.ledger.criterion import AllOf, AtLeast, AtMost, Finding, judge
from replication.ledger.cutoff import Cutoff
from replication.ledger.decide import decide_claims, join_claims
from replication.report.document import ReportedPaper, write_report
from replication.variables import REGULAR

PAPER = ReportedPaper("Studies of nonlinear problems", figures=("fig1",))
SECTION = 1
"""The section of the paper that the claims of this module are on."""
MASSES, ALPHA, STEP, PERIODS, MODES = 32, 0.25, 0.25, 170, 5
MOST = Cutoff(0.8, '"most": four fifths', ideal=1.0)
RUN, LINEAR = "runs/nonlinear", "runs/linear"


def forces(position: np.ndarray, alpha: float) -> np.ndarray:
    """Return the forces on the inner masses, between springs with d + alpha d^2."""
    stretch = np.diff(position)
    return np.diff(stretch + alpha * stretch * stretch)


@cache
def simulate(alpha: float) -> xr.Dataset:
    """Return the energies (mode, time) of a chain that starts in its first mode.

    Time is in periods of the first mode, and the steps are those of Verlet.
    """
    numbers = np.arange(1, MODES + 1)
    waves = np.sin(np.pi * np.outer(numbers, np.arange(MASSES + 2)) / (MASSES + 1))
    frequencies = 2.0 * np.sin(0.5 * np.pi * numbers / (MASSES + 1))
    position, velocity, energies = waves[0].copy(), np.zeros(MASSES + 2), []
    for _ in range(PERIODS + 1):
        amplitude, rate = np.sqrt(2.0 / (MASSES + 1)) * np.array(
            [waves @ position, waves @ velocity]
        )
        energies.append(0.5 * ((frequencies * amplitude) ** 2 + rate**2))
        velocity[1:-1] += 0.5 * STEP * forces(position, alpha)
        for _ in range(round(2.0 * np.pi / frequencies[0] / STEP)):
            position += STEP * velocity
            velocity[1:-1] += STEP * forces(position, alpha)
        velocity[1:-1] -= 0.5 * STEP * forces(position, alpha)
    return xr.Dataset(
        {"energy": (("mode", "time"), np.transpose(energies), {"long_name": "energy of a mode"})},
        {
            "mode": ("mode", numbers, {"long_name": "number of the mode"}),
            "time": ("time", np.arange(PERIODS + 1.0), {"long_name": "periods of the first mode"}),
        },
        {"title": "Energies of the modes of a chain", "alpha": alpha, **REGULAR},
    )


def shares(run: xr.Dataset) -> xr.DataArray:
    """Return the energies of modes as fractions of the energy at the start."""
    return run["energy"] / run["energy"].sel(time=0.0).sum()


@claim(
    "Fig 1",
    "The energy leaves the first mode, and most of it comes back.",
    (RUN,),
    (ClaimControl("a linear chain, whose energy stays in the first mode", LINEAR),),
)
def energy_returns(run: xr.Dataset) -> Finding:
    """Decide by the smallest fraction in the first mode and the largest one after that."""
    first = shares(run).sel(mode=1)
    least = int(np.argmin(first.values))
    measured = {"least": first[least], "returned": first[least:].max()}
    return judge(measured, AllOf(AtMost(0.5, "least"), AtLeast(MOST, "returned")))


@claim(
    "Fig 1",
    "The energy is not shared by all modes: the first five keep most of it.",
    (RUN,),
    (
        ClaimControl(
            "a tenth of the energy after period 50", scale("energy", 0.1, time=slice(50.0, None))
        ),
    ),
)
def low_modes_hold_the_energy(run: xr.Dataset) -> Finding:
    """Decide by the smallest fraction that these modes hold together."""
    return judge({"least_sum": shares(run).sum("mode").min()}, AtLeast(MOST, "least_sum"))


CLAIMS: tuple[Claim, ...] = (energy_returns.claim, low_modes_hold_the_energy.claim)


@style.styled
def draw_fig1(data: xr.Dataset) -> Figure:
    """Draw the energy of each mode against time."""
    figure = style.new_figure(style.WIDTH, 2.5)
    axes = figure.subplots()
    for mode in data["mode"].values:
        axes.plot(data["time"], data["energy"].sel(mode=mode), label=f"mode {mode}")
    axes.set(xlabel="periods of the first mode", ylabel="energy")
    style.name_legend(figure, axes)
    return figure


def make_run(folder: Path, alpha: float = ALPHA) -> list[str]:
    """Make datasets, the figure, the ledger and the report of a run; return the files' names."""
    runs = {RUN: simulate(alpha), LINEAR: simulate(0.0)}
    for name, run in runs.items():
        save(folder / f"{name}.nc", run)
    energies = runs[RUN].assign_attrs(caption="Energies of the first five modes against time.")
    figure = [str(folder / f"figures/fig1.{kind}") for kind in ("png", "pdf", "nc", "json")]
    (folder / "figures").mkdir()
    style.save(draw_fig1(energies), energies, *figure)
    datasets, rows = [str(folder / f"{name}.nc") for name in runs], str(folder / "claims/all.json")
    decide_claims(CLAIMS, datasets, list(runs), rows)
    ledger = str(folder / "claims.json")
    join_claims([rows], ledger, str(folder / "tables/claims.md"))
    write_report(PAPER, datasets, [figure[2]], ledger, {}, str(folder / "report.html"))
    return sorted(path.relative_to(folder).as_posix() for path in folder.rglob("*.*"))


def accept(names: list[str], results: Path, folder: Path) -> None:
    """Take a run as the accepted one."""
    acceptance.accept(names, results, folder, {})


def compare(names: list[str], results: Path, folder: Path) -> ComparisonResult:
    """Compare a run with the accepted one."""
    return baseline.compare(names, results, folder, {})
