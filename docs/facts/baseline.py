"""The datasets and records in tests/baseline, which every fact is read from."""

import json
from pathlib import Path

import xarray as xr
from pendula.datasets.json_files import load_json
from pendula.datasets.netcdf import read


class Baseline:
    """The datasets below tests/baseline by their names, each read once."""

    def __init__(self, folder: Path):
        self.folder = folder
        self._read = {}

    def __getitem__(self, name: str) -> xr.Dataset:
        if name not in self._read:
            self._read[name] = read(self.folder / f"{name}.nc")
        return self._read[name]

    def has(self, name: str) -> bool:
        """Return whether there is such a dataset."""
        return (self.folder / f"{name}.nc").exists()

    def claims(self) -> list[dict]:
        """Return the rows of the ledger of the last full run that was accepted."""
        return load_json(self.folder / "quoted/claims.json")["rows"]

    def reproduction(self) -> dict | None:
        """Return the times of the whole reproduction that were measured last, if any."""
        kept = self.folder / "quoted/reproduction.json"
        return json.loads(kept.read_text(encoding="utf-8")) if kept.exists() else None

    def mutation(self) -> dict:
        """Return the score of the last trial of mutants."""
        return json.loads((self.folder / "quoted/mutation.json").read_text(encoding="utf-8"))
