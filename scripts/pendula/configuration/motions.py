"""The sections `spectra` and `sections` of a configuration: Lyapunov spectra and crossings."""

from collections.abc import Callable
from pathlib import Path
from typing import Annotated, Any, Literal

from latticode.configuration.cases import CaseSection
from latticode.configuration.cost import OF_TANGENTS, RunCost
from latticode.configuration.files import OF_MODELS
from latticode.configuration.values import Count, Integer, Name, Section, excerpt_of, fault
from latticode.equations.model import Model, ModelError
from latticode.equations.model_file import run_file
from pydantic import AfterValidator

Texts = list[tuple[str, str]]
"""Keys, each with the error in its value."""


def read_function(place: str) -> Callable:
    """Return the function that `place` names, such as "mine.py:plane".

    Raises ModelError if the file cannot be read or has no such function.
    """
    file, _, name = place.rpartition(":")
    path = Path(file)
    try:
        names = run_file(path, path.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError) as error:
        why = getattr(error, "strerror", None) or "it is not UTF-8 text"
        raise ModelError(f"{path} cannot be read: {why}") from None
    if not callable(names.get(name)):
        raise ModelError(f"{path.name} has no function {name}")
    return names[name]


def _as_function(place: str) -> str:
    file, _, name = place.rpartition(":")
    if not (file.endswith(OF_MODELS) and name.isidentifier()):
        raise fault(f"is {excerpt_of(place)}; give a function of a file, such as mine.py:plane")
    return place


class LargestExponentsSection(Section):
    """The `count` largest Lyapunov exponents of a case."""

    case: Name
    count: Count = 1

    def faults_of(self, case: CaseSection) -> Texts:
        """Return an error if the case has fewer than `count` exponents."""
        from latticode.localised.spectra import count_directions  # here: imports the compiler

        most = count_directions(case.kind.of(case.problem()))
        text = f"is {self.count}; give a whole number from 1 to {most}"
        return [("count", text)] if self.count > most else []

    def cost(self, case: CaseSection) -> RunCost:
        """Return the cost of the exponents."""
        run = case.cost(case.problem(solver=OF_TANGENTS))
        return RunCost((1 + self.count) * run.seconds, (1 + self.count) * run.memory)


class CrossingsSection(Section):
    """Where a function of the fields of a case crosses zero."""

    case: Name
    when: Annotated[str, AfterValidator(_as_function)]
    direction: Literal["up", "down", "both"] = "up"
    site: Integer = 0

    def faults_of(self, case: CaseSection) -> Texts:
        """Return the invalid keys of the section, with their errors."""
        ends = f"{case.chain[0]} to {case.chain[-1]}"
        text = f"is {self.site}; the sites run from {ends}"
        all_faults = [] if self.site in case.chain else [("site", text)]
        try:
            self.plain_when(case)
        except ModelError as error:
            all_faults.append(("when", str(error)))
        return all_faults

    def plain_when(self, case: CaseSection) -> dict[str, Any]:
        """Return the model, as plain values, with the function as its only conserved density."""
        traced = isinstance(case.model, Model)
        model = case.model if traced else case.kind.of(case.problem()).model
        name, density = self.when.rpartition(":")[2], model.trace(read_function(self.when))
        observed = object.__new__(Model)
        copied = ("fields", "parameters", "name", "form", "text", "rates")
        observed.__dict__.update({key: getattr(model, key) for key in copied})
        observed.conserved = {name: density}
        return observed.plain

    def cost(self, case: CaseSection) -> RunCost:
        """Return the cost of the run of the case."""
        return case.cost(case.problem())
