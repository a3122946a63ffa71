"""Keep what the README and docs/ quote of long studies, which no full run makes.

Run as `python docs/keep.py results` after `snakemake unbounded`, `over_the_top`, or
`fates sensitivity`, if a long study was made anew. It reduces the studies of the infinite
chain, of pendula over the top and of breathers to what is quoted, in tests/baseline/quoted.

Run as `python docs/keep.py config` after the paper is read in another way and config/*.yaml say so:
it keeps what they say as the configuration that the claims are about.
"""

import json
import sys
from pathlib import Path

import xarray as xr
import yaml

ROOT = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(ROOT / "scripts")]

from latticode.datasets.netcdf import Variable, read, write  # noqa: E402
from latticode.measures.spreading import fit_exponent  # noqa: E402
from pendula import __version__  # noqa: E402
from pendula.configuration import paper  # noqa: E402
from pendula.configuration.messages import STUDIES, load  # noqa: E402
from pendula.studies.breathers.figures import SAME_RUNS  # noqa: E402
from pendula.studies.unbounded.measured import speeds  # noqa: E402

GIVEN = yaml.safe_load((ROOT / "config/unbounded.yaml").read_text())["unbounded"]
QUOTED = ROOT / "tests/baseline/quoted"


def keep_unbounded(results: Path, folder: Path) -> None:
    """Keep exponents, fronts and powers of the long study of the infinite chain."""
    long = results / "long/unbounded"
    rows = [_case(read(long / f"{name}.nc")) for name in GIVEN["cases"]]
    kept = {
        "case": Variable(("case",), GIVEN["cases"], "case of the paper, on the infinite chain"),
        **{
            name: Variable(("case",), [row[name][0] for row in rows], title)
            for name, (_, title) in rows[0].items()
        },
        **_omegas(read(long / "omegas.nc"), read(long / "fronts.nc")),
    }
    title = "The long study of the infinite chain, reduced to what the documents quote"
    _write(folder / "unbounded.nc", title, kept, epsilon=1.0, gamma=1.0, **GIVEN["long"]["solver"])


def _write(path: Path, title: str, variables: dict[str, Variable], **attributes) -> None:
    write(path, variables, {"title": title, **attributes, "version": __version__})


PASSAGES = ("passage_rate", "passed")
"""What is kept of first passages over the top, with confidence intervals; of `passed` the last."""


def keep_passages(results: Path, folder: Path) -> None:
    """Keep shares and rates of the long study of pendula that go over the top."""
    long = read(results / "long/pendula/over_the_top.nc")
    last, tau = long.isel(tau=-1), long["tau"].values
    names = [name for name in last if str(name).startswith(PASSAGES)]
    kept = {str(name): _as_it_is(last[name]) for name in ["mu", *names]}
    about = {"members": long.sizes["member"], "end_time": tau[-1], "settled": long.attrs["settled"]}
    title = "The long study of pendula that go over the top, reduced to what the documents quote"
    _write(folder / "pendula.nc", title, kept, **about)


HALF = "half of its 95 % confidence interval"
OCTAVES = 2
"""The exponents hold for so many of the last octaves of time."""


def _exponent(run: xr.Dataset, variant: int = 0):
    """Return the exponent of tau in l2 with its confidence interval."""
    values = run["l2"].isel(variant=variant).transpose("member", "tau").values
    tau = run["tau"].values
    return fit_exponent(tau, values, tau[-1] * 0.5**OCTAVES)


def _case(run: xr.Dataset) -> dict[str, tuple[float, str]]:
    """Return the numbers of a case, each with what it is."""
    speed, error = speeds(run)
    sites = 2 * int(run["front"].isel(piece_tau=-1).max()) + 1
    predicted, tau = float(run["predicted_speed"][0]), float(run["tau"][-1])
    exponent = _exponent(run)
    return {
        "end": (tau, "slow time at the end"),
        "sites": (sites, "sites that the front has passed at the end"),
        "speed": (speed[0], "speed of the front, sites per unit of tau"),
        "speed_error": (error[0], f"{HALF}, or its resolution"),
        "predicted_speed": (predicted, "speed of linear spreading, sites per unit of tau"),
        "exponent": (exponent.value, "exponent of tau in the l2 norm over the last octaves"),
        "exponent_error": (exponent.half, HALF),
    }


OF_FRONTS = (
    *("omega", "second_front_speed", "second_front_speed_error"),
    *("power_behind", "power_behind_error", "power_between", "power_between_error"),
    *("thermal_power", "thermal_antisymmetric_power"),
)


def _omegas(run: xr.Dataset, fronts: xr.Dataset) -> dict[str, Variable]:
    """Return the exponent at each Omega, and what was measured of the fronts."""
    exponents = [_exponent(run, variant).value for variant in range(run.sizes["variant"])]
    return {
        **{name: _as_it_is(fronts[name]) for name in OF_FRONTS},
        "omega_end": Variable((), float(run["tau"][-1]), "slow time at the end of these runs"),
        "omega_exponent": Variable(
            ("omega",), exponents, "exponent of tau in the l2 norm over the last two octaves"
        ),
    }


def keep_breathers(results: Path, folder: Path) -> None:
    """Keep the map of the long study of fates, and the shares of that of sensitivity."""
    fates, spread = (
        read(results / f"long/breathers/{name}.nc") for name in ("fates", "sensitivity")
    )
    whole = ("omega", "a0", "b0", "fate")
    shares = ("size", "share", "share_low", "share_high")
    kept = {
        **{name: _as_it_is(fates[name]) for name in whole},
        **{name: _as_it_is(spread[name]) for name in shares},
    }
    about = {name: fates.attrs[name] for name in (*SAME_RUNS, "solver")}
    about |= {"points": fates.sizes["a0"], "members": spread.attrs["members"]}
    title = "The long study of breathers, reduced to what the documents quote and a figure shows"
    _write(folder / "breathers.nc", title, kept, **about)


def _as_it_is(values: xr.DataArray) -> Variable:
    others = {name: one for name, one in values.attrs.items() if name.startswith("flag_")}
    about = (values.attrs["long_name"], values.attrs.get("units", "1"), others)
    return Variable(values.dims, values.values, *about)


SECTIONS = ("cases", "sweeps", "solvers")
SECTIONS += ("chaos", "breathers", "pendula", "unbounded", "certified")
"""The sections of the configuration that claims rest on."""


def configuration() -> dict:
    """Return what config/*.yaml say of SECTIONS, but for long studies, which no claim reads."""
    files = [ROOT / f"config/{name}.yaml" for name in ("config", *STUDIES)]
    raw = {key: value for file in files for key, value in yaml.safe_load(file.read_text()).items()}
    whole = json.loads(load(raw).model_dump_json())
    kept = {name: whole[name] for name in SECTIONS}
    breathers = (kept["breathers"][name] for name in ("sensitivity", "fates"))
    for long in (kept["unbounded"], *breathers, kept["pendula"]["over_the_top"]):
        del long["long"]
    return kept


def keep_configuration() -> None:
    """Write it beside the module that compares other configurations with it, an entry a line."""
    sections = [
        ",\n".join(f'  "{name}": {json.dumps(value)}' for name, value in section.items())
        for section in configuration().values()
    ]
    pairs = zip(SECTIONS, sections, strict=True)
    text = ",\n".join(f' "{name}": {{\n{entries}\n }}' for name, entries in pairs)
    paper.FILE.write_text(f"{{\n{text}\n}}\n", encoding="utf-8")


def main(results: Path, folder: Path = QUOTED) -> None:
    """Keep whatever of the long studies the folder of results holds."""
    folder.mkdir(exist_ok=True)
    for needed, keep in {
        "unbounded/omegas.nc": keep_unbounded,
        "pendula/over_the_top.nc": keep_passages,
        "breathers/fates.nc": keep_breathers,
    }.items():
        if (results / "long" / needed).exists():
            keep(results, folder)


if __name__ == "__main__":
    keep_configuration() if sys.argv[1] == "config" else main(Path(sys.argv[1]))
