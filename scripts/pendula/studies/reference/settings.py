"""The keys of config/reference.yaml."""

from typing import Annotated

from latticode.configuration.values import Integer, Name, Positives, Section
from pydantic import Field

from pendula.configuration.schema import PAPER_SWEEPS, Faults, PaperConfiguration

Bits = Annotated[Integer, Field(ge=64, le=4096)]


class Settings(Section):
    """Section `reference` of the configuration."""

    snapshots: Positives
    bits: dict[Name, tuple[Bits, Bits]]

    def problem(self, settings: PaperConfiguration, case: str) -> dict:
        """Return a case as plain values of a Problem that ends after all drawn windows."""
        sweeps = (settings.sweeps[name] for name in PAPER_SWEEPS)
        drawn = [sweep.drawn for sweep in sweeps if sweep.case == case]
        ends = [end for windows in drawn for _, end in (windows.max, windows.mean)]
        return settings.problem(case, end_time=max([settings.cases[case].end_time, *ends]))

    def faults(self, settings: PaperConfiguration) -> Faults:
        """Yield (key, message) for each key of `bits` that is no case of the configuration."""
        yield from settings.absent("cases", "bits", list(self.bits))
