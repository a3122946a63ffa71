"""A small run of made-up curves: one regular case, one that is chaotic after HORIZON."""

import base64
from pathlib import Path

import numpy as np
import xarray as xr
from latticode.datasets.json_files import write_json
from latticode.datasets.netcdf import save
from latticode.drawing import style
from matplotlib.figure import Figure
from replication.figure_diff.chaos import Trust
from replication.variables import (
    ALL_TIMES,
    PROVEN,
    SCATTERED,
    chaotic_along,
    mark,
)
from replication.variables import (
    CHAOTIC as DRAWN,
)
from replication.variables import (
    REGULAR as STEADY,
)

TAU, HORIZON, M = np.linspace(0, 50, 401), 9.0, np.arange(5.0, 45.0, 5.0)
LARGEST = 0.3
"""The error that a chaotic run has in the end, from HORIZON + 9.5 on."""
TRUSTED = Trust(
    "checks/trust.nc",
    "difference",
    {"solver": "taylor"},
    time="tau",
    steps=("tau", "snapshot", "snapshot_tau"),
)
REGULAR, CHAOTIC = "trajectories/fig2_small.nc", "trajectories/fig4_small.nc"
SWEEP = "sweeps/fig5_right.nc"
TRUST, EXPONENTS, ROUNDING = "checks/trust.nc", "checks/lyapunov.nc", "checks/balance.nc"
MAP, BOUND = "breathers/fates.nc", "certified/fig2_small.nc"
LIVES, PROOFS, HARD = "checks/lifetimes.nc", "certified/breathers.nc", "checks/hard_cases.nc"
PICTURE = "figures/fig2.png"
LEDGER, THEORY = "claims.json", "claims/theory.json"
TABLE, REPORT, LIVE = "tables/claims.md", "report.html", "live.html"
NAMES = [
    *(REGULAR, CHAOTIC, SWEEP, TRUST, EXPONENTS, ROUNDING, MAP),
    *(LIVES, PROOFS, HARD),
    *(LEDGER, THEORY, TABLE, REPORT, LIVE),
    *(
        f"figures/{stem}.{kind}"
        for stem in ("fig2", "fig4")
        for kind in ("nc", "pdf", "json", "png")
    ),
    BOUND,
]
CONFIGURATION = {
    "cases": {"fig2_small": {"end_time": 50, "omega": 8}, "fig4_small": {"omega": 0}},
    "sweeps": {"fig5_right": {"case": "fig4_small"}},
}


def dataset(coordinates: dict, variables: dict, **attributes) -> xr.Dataset:
    """Return a dataset whose variables have names for people."""
    named = {name: (*each, {"long_name": f"the {name}"}) for name, each in variables.items()}
    return xr.Dataset(named, coordinates, attributes)


def grown() -> np.ndarray:
    """Return the error of a chaotic run: it grows tenfold in a unit of time."""
    return (1e-10 * np.exp(np.log(10) * (TAU - HORIZON))).clip(0, LARGEST)


def norms(chaotic: bool, seed: int = 0) -> xr.Dataset:
    """Return norms of two components; chaotic ones depend on the seed more and more."""
    draws = np.random.default_rng(seed).normal(size=(2, TAU.size))
    l2, share = np.array([2 + np.cos(0.7 * TAU), 1 + 0.5 * np.sin(1.1 * TAU)]), grown() / LARGEST
    curves = dataset(
        {"component": ["A", "B"], "tau": TAU},
        {
            "l2": (("component", "tau"), l2 + chaotic * share * (3 + 0.5 * draws - l2)),
            "bound": ("component", [np.inf, 9.5]),
            "sites": ("component", [61, 61]),
        },
        omega=8.0,
        solver="ode45",
        steps=1500,
    )
    return mark(curves, PROVEN, "bound")


def numbers(seed: int = 0) -> dict[str, xr.Dataset]:
    """Return the datasets; those that rest on chaos depend on the seed."""
    cases, draw = ["fig2_small", "fig4_small"], np.random.default_rng(seed).normal

    def some(values: np.ndarray, scatter: float) -> np.ndarray:
        return values * (1.0 + scatter * draw(size=values.size))

    regular, errors = norms(False), np.array([1e-15 + 0 * TAU, grown()])
    return {
        REGULAR: regular,
        CHAOTIC: norms(True, seed),
        SWEEP: dataset({"half_width": M}, {"l2": ("half_width", some(9.0 * np.sqrt(M), 0.01))}),
        TRUST: mark(
            dataset(
                {"case": cases, "solver": ["taylor"], "tau": TAU},
                {"difference": (("case", "solver", "tau"), 10 * errors[:, None])},
            ),
            ALL_TIMES,
            "difference",
        ),
        EXPONENTS: dataset({"case": cases}, {"exponent": ("case", [1e-4, 1.73 + 0.01 * draw()])}),
        ROUNDING: dataset({"tau": TAU[:9]}, {"defect": ("tau", 1e-15 * draw(size=9))}, **STEADY),
        BOUND: mark(
            dataset({"tau": TAU}, {"bound": ("tau", 1e-12 * np.exp(0.1 * TAU))}), PROVEN, "bound"
        ),
        MAP: dataset(
            {"omega": [0.0, 8.0], "half_width": M},
            {"fate": (("omega", "half_width"), [some(1 + 0 * M, 0.1), 1 + 0 * M])},
            **chaotic_along("omega"),
        ),
        LIVES: dataset({"half_width": M}, {"median": ("half_width", some(M, 0.02))}, **DRAWN),
        PROOFS: mark(
            dataset({}, {"radius": ("row", [1.4e-16, 2.5e-16])}, **STEADY), PROVEN, "radius"
        ),
        HARD: mark(
            dataset(
                {},
                {
                    "case": ("row", ["stiff", "tiny", "long"]),
                    "error": ("row", [3e-13, 1e-9, 2e-12]),
                },
                **STEADY,
            ),
            SCATTERED,
            "error",
        ),
    }


@style.styled
def draw(
    data: xr.Dataset, colours="AB", panels=2, label=r"$\ell^2$ norm", limit=8, components="AB"
) -> Figure:
    """Draw both components in each panel, side by side, with a legend above."""
    figure = style.new_figure(4.0, 1.8)
    for axes in figure.subplots(1, panels, squeeze=False)[0]:
        for name, component, colour in zip("AB", components, colours, strict=True):
            curve = data["l2"].sel(component=component)
            axes.plot(TAU, curve, color=style.colour_of("AB".index(colour)), label=f"${name}$")
        axes.set(xlabel=r"$\tau$", ylabel=label, xlim=(0, 50), ylim=(0, limit))
        axes.set_title("some case", loc="left")
    style.name_legend(figure, figure.axes[0])
    return figure


def put(folder: Path, stem: str, data: xr.Dataset, **drawn) -> None:
    """Write the figure `stem` of the run, drawn with these changes, and its data."""
    (folder / "figures").mkdir(parents=True, exist_ok=True)
    paths = [folder / f"figures/{stem}.{kind}" for kind in ("png", "pdf", "nc", "json")]
    style.save(draw(data, **drawn), data.expand_dims(initial_size=["small"]), *paths)


def put_words(folder: Path, largest: float = 6.60403, verdict: str = "confirmed") -> None:
    """Write the ledger, a part of it, a table and the report of a run."""
    because = f"the largest norm is {largest:.3g}"
    row = {"name": "bounded", "says": "The norm stays below 9.5.", "verdict": verdict}
    row |= {"decided_by": [CHAOTIC.removesuffix(".nc")], "criterion": "largest norm <= 9.5"}
    row |= {"cutoffs": [{"value": 0.25, "from": "a quarter"}], "controls": []}
    rows = [row | {"measured": {"largest": largest}, "because": because}]
    for name in (TABLE, THEORY):
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
    write_json(folder / LEDGER, {"rows": rows})
    write_json(folder / THEORY, {"read": [REGULAR], "rows": rows})
    table = f"# Claims\n\n| claim | verdict |\n|-------|---------|\n| bounded | {verdict} |\n"
    (folder / TABLE).write_text(table)
    times = '<section id="run">\n<p>Wall time: 96 s</p>\n</section>'
    page = f"<html><p>The claim is {verdict}.</p><p>It is {largest}.</p>{times}</html>\n"
    (folder / REPORT).write_text(page)
    code = base64.b64encode(b"\0asm" + bytes(range(64))).decode()
    data = f'<script type="application/json">{{"code": "{code}"}}</script>'
    (folder / LIVE).write_text(f"<html>{data}<p>Run a case.</p></html>\n")


def make_run(folder: Path, seed: int = 0) -> Path:
    """Write all files of a run; another seed makes one that is as right, and moves chaos alone."""
    for name, data in numbers(seed).items():
        save(folder / name, data)
    put(folder, "fig2", norms(False))
    put(folder, "fig4", norms(True, seed))
    put_words(folder, largest=6.60403 + seed)
    return folder
