"""Store the parts of long studies that the README and docs/ quote, because a full run omits them.

Run `python docs/keep.py results` after a long study was computed again, with `snakemake unbounded`,
`transition`, `over_the_top`, or `fates sensitivity`. The quoted parts are stored in
tests/baseline/quoted.

Run `python docs/keep.py config` after config/*.yaml have been changed to a new reading of the
paper. This configuration is stored as the one that the claims are about.
"""

import json
import sys
from pathlib import Path

import pendula.names  # noqa: F401, so that datasets have the paper's words
import xarray as xr
import yaml
from latticode.datasets.netcdf import read, save
from pendula.configuration import paper
from pendula.configuration.messages import STUDIES, load
from pendula.studies.breathers.figures import SAME_RUNS

ROOT = Path(__file__).resolve().parents[1]

QUOTED = ROOT / "tests/baseline/quoted"


def of_unbounded(folder: Path) -> xr.Dataset:
    """Return the numbers of the infinite chain with their variations, by Omega."""
    return read(folder / "numbers.nc")


def of_numbers(path: Path, *names: str) -> xr.Dataset:
    """Return the numbers of a study with their variations, and the named attributes."""
    study = read(path)
    return _with_attributes_of(study, study, "members", "end_time", *names)


def of_breathers(folder: Path) -> xr.Dataset:
    """Return the map of fates, and the numbers of all studies of breathers with variations."""
    fates = read(folder / "fates.nc")
    studies = [read(folder / f"{name}.nc") for name in ("areas", "shares", "least_power")]
    # as objects, because the merge would cut texts to the shortest length
    studies = [
        study.assign_coords(variation=study["variation"].astype(object)) for study in studies
    ]
    maps_and_numbers = _with_attributes_of(
        xr.merge([fates[["fate"]], *studies], join="outer", compat="no_conflicts"),
        fates,
        *SAME_RUNS,
        "solver",
    )
    return maps_and_numbers.assign_attrs(
        points=fates.sizes["a0"], members=studies[1].attrs["members"]
    )


def _with_attributes_of(data: xr.Dataset, study: xr.Dataset, *names: str) -> xr.Dataset:
    """Return the data with no attributes but the named ones of a study."""
    return data.drop_attrs(deep=False).assign_attrs({name: study.attrs[name] for name in names})


SECTIONS = ("cases", "sweeps", "solvers")
SECTIONS += ("chaos", "breathers", "newton", "unbounded", "certified")
"""The sections of the configuration that determine the verdicts on claims."""


def configuration() -> dict:
    """Return SECTIONS of config/*.yaml, without long studies, which no claim reads."""
    files = [ROOT / f"config/{name}.yaml" for name in ("config", *STUDIES)]
    raw = {key: value for file in files for key, value in yaml.safe_load(file.read_text()).items()}
    settings = json.loads(load(raw).model_dump_json())
    sections = {name: settings[name] for name in SECTIONS}
    breathers = (sections["breathers"][name] for name in ("sensitivity", "fates"))
    long_sections = (sections["newton"]["over_the_top"], sections["chaos"]["lifetimes"])
    for long in (sections["unbounded"], *breathers, *long_sections):
        del long["long"]
    return sections


def keep_configuration() -> None:
    """Write the configuration that the claims are about, one entry per line."""
    sections = [
        ",\n".join(f'  "{name}": {json.dumps(value)}' for name, value in section.items())
        for section in configuration().values()
    ]
    pairs = zip(SECTIONS, sections, strict=True)
    text = ",\n".join(f' "{name}": {{\n{entries}\n }}' for name, entries in pairs)
    paper.FILE.write_text(f"{{\n{text}\n}}\n", encoding="utf-8")


def main(results: Path, folder: Path = QUOTED) -> None:
    """Store the quoted parts of each long study that is in the folder of results."""
    folder.mkdir(exist_ok=True)
    for (study, last), reduced in {
        ("unbounded", "numbers"): of_unbounded,
        ("pendula", "varied"): lambda folder: of_numbers(folder / "varied.nc", "settled"),
        ("chaos", "lifetimes"): lambda folder: of_numbers(folder / "lifetimes.nc"),
        ("breathers", "fates"): of_breathers,
    }.items():
        if (results / f"long/{study}/{last}.nc").exists():
            title = f"The long study {study}, reduced to what the documents quote"
            data = reduced(results / "long" / study).assign_attrs(title=title)
            save(folder / f"{study}.nc", data)


if __name__ == "__main__":
    keep_configuration() if sys.argv[1] == "config" else main(Path(sys.argv[1]))
