"""A small run of made-up curves, one regular, one chaotic after its horizon; pictures and words."""

import json
from pathlib import Path

import numpy as np
import xarray as xr
from matplotlib.figure import Figure
from pendula.datasets.netcdf import save
from pendula.drawing import style

TAU = np.linspace(0, 50, 2001)
REGULAR, CHAOTIC = "trajectories/fig2_small.nc", "trajectories/fig4_small.nc"
PICTURE, CHAOTIC_PICTURE = "figures/fig2.png", "figures/fig4.png"
LEDGER, TABLE, REFERENCE = "claims.json", "tables/claims.md", "truth/fig2_small.nc"
CHAOTIC_DATASETS = [CHAOTIC, "figures/fig4.nc", "figures/fig4_spacetime.nc"]
NAMES = [
    *(REGULAR, CHAOTIC, PICTURE, CHAOTIC_PICTURE, LEDGER, TABLE, REFERENCE),
    *(f"figures/{stem}.{kind}" for stem in ("fig2", "fig4") for kind in ("nc", "pdf", "json")),
]
CONFIGURATION = {"cases": {"fig2_small": {"end_time": 50, "omega": 8}}}


def regular() -> xr.Dataset:
    """Return the norms of two components that oscillate."""
    return _dataset([2 + np.cos(0.7 * TAU), 1 + 0.5 * np.sin(1.1 * TAU)])


def chaotic(seed: int = 0, scale: float = 1.0, horizon: float = 9.0) -> xr.Dataset:
    """Return norms that depend on `seed` after the horizon, and there wobble by `scale`."""
    return _dataset([_wander(seed, scale, horizon, 5.0), _wander(seed + 50, scale, horizon, 3.5)])


def _wander(seed: int, scale: float, horizon: float, level: float) -> np.ndarray:
    noise = np.random.default_rng(seed).normal(size=TAU.size + 40)
    smooth = np.convolve(noise, np.hanning(41) / np.linalg.norm(np.hanning(41)), "valid")
    known = level + 0.6 * np.sin(3 * TAU)
    beyond = level + 0.6 * scale * smooth
    return np.where(horizon >= TAU, known, beyond)


def _dataset(norms: list) -> xr.Dataset:
    about = {"long_name": "l2 norm", "units": "1"}
    bound = {"long_name": "bound of the l2 norm", "units": "1"}
    variables = {
        "l2": (("component", "tau"), np.array(norms), about),
        "bound": ("component", [np.inf, 9.5], bound),
    }
    attributes = {"omega": 8.0, "end_time": 50.0, "solver": "ode45"}
    attributes |= {"steps": 1500, "right_hand_sides": 9000}
    return xr.Dataset(variables, {"component": ["A", "B"], "tau": TAU}, attributes)


def change_a(data: xr.Dataset, factor: float) -> xr.Dataset:
    """Return the dataset with the curve of A multiplied."""
    return data.assign(l2=data["l2"] * xr.DataArray([factor, 1.0], dims="component"))


@style.styled
def draw(data: xr.Dataset, colours=("A", "B"), panels=2, label=r"$\ell^2$ norm") -> Figure:
    """Draw both components in each panel, side by side, with a legend above."""
    figure = style.new_figure(4.0, 1.8)
    for axes in figure.subplots(1, panels, squeeze=False)[0]:
        for component, colour in zip("AB", colours, strict=True):
            curve = data["l2"].sel(component=component)
            axes.plot(TAU, curve, color=style.COLOURS[colour], label=f"${component}$")
        axes.set(xlabel=r"$\tau$", ylabel=label, xlim=(0, 50), ylim=(0, 8))
        axes.set_title("some case", loc="left")
    style.name_legend(figure, figure.axes[0])
    return figure


def put(folder: Path, stem: str, data: xr.Dataset, **drawn) -> None:
    """Write the figure `stem` of the run, drawn with these changes, and its data."""
    (folder / "figures").mkdir(parents=True, exist_ok=True)
    paths = [folder / f"figures/{stem}.{kind}" for kind in ("png", "pdf", "nc", "json")]
    style.save(draw(data, **drawn), data, *paths)


def ledger() -> list[dict]:
    """Return two claims, each decided by one of the datasets."""

    def row(name: str, dataset: str, measured: float) -> dict:
        return {
            "name": name,
            "says": "The norm stays below 9.5.",
            "decided_by": [dataset.removesuffix(".nc")],
            "measured": {"largest": measured},
            "verdict": "confirmed",
            "because": f"the largest norm is {measured:.3g}",
        }

    return [row("regular_bounded", REGULAR, 2.99871), row("chaotic_bounded", CHAOTIC, 6.60403)]


def table() -> str:
    """Return a table of the claims."""
    rows = [f"| {row['name']} | {row['measured']['largest']} |" for row in ledger()]
    return "\n".join(["# Claims", "", "| claim | largest |", "|-------|---------|", *rows, ""])


def put_words(folder: Path, rows: list[dict], text: str) -> None:
    """Write the ledger and the table of a run."""
    (folder / TABLE).parent.mkdir(parents=True, exist_ok=True)
    (folder / LEDGER).write_text(json.dumps(rows, indent=1) + "\n")
    (folder / TABLE).write_text(text)


def make_chaos(folder: Path, seed: int = 0, **changes) -> Path:
    """Write the chaotic datasets of a run, each of another seed, since no test wants copies."""
    for place, name in enumerate(CHAOTIC_DATASETS):
        save(folder / name, chaotic(seed + 100 * place, **changes))
    return folder


def make_run(folder: Path) -> Path:
    """Write the datasets, figures and words of a run, and a reference that it was given."""
    put_words(folder, ledger(), table())
    save(folder / REFERENCE, regular())
    for name, data in ((REGULAR, regular()), (CHAOTIC, chaotic())):
        save(folder / name, data)
        put(folder, Path(name).stem.partition("_")[0], data)
    return folder
