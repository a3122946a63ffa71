"""Made-up results for the sections of the report: datasets in memory, pictures of one pixel."""

from pathlib import Path

import xarray as xr
from pendula.datasets.json_files import sealed
from pendula.report.page import Picture
from pendula.report.results import Results

SMALL, LARGE = '{"0": [1.0, 0.1]}', '{"0": [5.0, 1.0]}'
CASES = {
    "fig2_small": (8.0, SMALL),
    "fig2_large": (8.0, LARGE),
    "fig3_small": (-4.0, SMALL),
    "fig3_large": (-4.0, LARGE),
}


class MadeUp(Results):
    """Results by name: datasets, and the text of other files."""

    def __init__(self, folder: Path, datasets: dict[str, xr.Dataset], **texts: str):
        super().__init__([], folder / "page.html")
        self._read = datasets
        for name in datasets:
            self._paths[f"{name}.nc"] = folder / f"{name}.nc"
        for name, text in texts.items():
            (folder / name).write_text(text)
            self._paths[name] = folder / name

    def picture(self, name: str, alt: str) -> Picture:
        return Picture("data:,", 1, 1, alt, f"figures/{name}.png")


def by_case(cases=CASES, **variables) -> xr.Dataset:
    """Return a dataset over cases, with their detuning and initial data."""
    omegas, initials = zip(*cases.values(), strict=True)
    data = {"omega": ("case", list(omegas)), "initial": ("case", list(initials)), **variables}
    return xr.Dataset(data, coords={"case": list(cases)})


def lyapunov(*chaotic: str, cases=CASES) -> xr.Dataset:
    """Return which of some cases are chaotic."""
    return by_case(cases, chaotic=("case", [int(case in chaotic) for case in cases]))


def claim(name: str, verdict: str = "confirmed", place: str = "Lemma 1", **changes) -> dict:
    """Return a row of the ledger."""
    return {
        "name": name,
        "names": [name],
        "origin": "of the paper",
        "place": place,
        "says": "The l2 norm is bounded for Omega > 2 gamma.",
        "decided_by": ["checks/chart"],
        "measured": {"largest_rate": 0.25},
        "criterion": "largest rate <= 0.001",
        "verdict": verdict,
        "because": "",
        "cutoffs": [{"value": 0.001, "from": "rounding"}],
        "rests_on": [],
        "controls": [
            {
                "fed": "an unstable run",
                "must": "not be confirmed",
                "verdict": "not reproduced",
                "because": "it grows",
                "measured": {"largest_rate": 0.5},
                "passes": True,
            }
        ],
        **changes,
    }


def ledger(*rows: dict) -> str:
    """Return a ledger as the file holds it."""
    return sealed({"rows": list(rows)})


def text_of(value) -> str:
    """Return all words of a section's values, its quotes as they are shown."""
    if isinstance(value, dict):
        return " ".join(text_of(one) for one in value.values())
    if isinstance(value, list | tuple) and not hasattr(value, "__html__"):
        return " ".join(text_of(one) for one in value)
    return str(value)
