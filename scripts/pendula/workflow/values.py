"""The configuration as plain values, for the parameters of rules."""

from collections.abc import Callable, Mapping
from typing import Any

from latticode.configuration.values import Section, Steps


def values_of(section: Section, *names: str) -> dict[str, Any]:
    """Return the named settings as plain values. Without names, return all except `long`."""
    values_by_name = section.model_dump()
    chosen = names or [name for name in values_by_name if name != "long"]
    settings = {name: getattr(section, name) for name in chosen}
    return {
        name: setting.values if isinstance(setting, Steps) else values_by_name[name]
        for name, setting in settings.items()
    }


def section_of_size(section: Section, wildcards: Any) -> Section:
    """Return the settings of the longer study if the wildcard `size` is set, or the usual ones."""
    return section.long if wildcards.size else getattr(section, "short", section)


def by_size(section: Section, *names: str) -> dict[str, Callable]:
    """Return a function of the wildcards for each setting, which may differ in a longer study."""

    def of_size(name: str) -> Callable:
        return lambda wildcards: values_of(section_of_size(section, wildcards), name)[name]

    return {name: of_size(name) for name in names}


def without_solver(problem: Mapping) -> dict[str, Any]:
    """Return the plain values of a problem without its solver."""
    return {key: value for key, value in problem.items() if key != "solver"}
