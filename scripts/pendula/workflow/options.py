"""The configuration of a call of Snakemake, and the options that are only for this call."""

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any, NamedTuple

from latticode.configuration.files import ConfigurationError, gather, read_entries

from pendula.configuration.messages import STUDIES

NAMES = ("baseline", "bits", "accept")
"""Options of one call. They are read only from --config, never from a file."""


class Options(NamedTuple):
    """The baseline to compare with, whether equal numbers suffice, and which results to accept."""

    baseline: str | None
    any_bits: bool
    accept: list[str]


def take_options(config: dict[str, Any], values: Mapping[str, Any]) -> Options:
    """Return the options in `values`, the values of --config, and remove them from `config`.

    Raises ConfigurationError for an invalid value.
    """
    for name in NAMES:
        config.pop(name, None)
    baseline, bits, accept = (values.get(name) for name in NAMES)
    if not isinstance(baseline, str | None):
        text = "give the path of a folder, as in baseline=./7"
        raise ConfigurationError(f"--config baseline={baseline}: {text}")
    if bits not in (None, "any"):
        raise ConfigurationError(
            f"--config bits={bits}: the only allowed value is any, to compare numbers where bits "
            "differ. By default such files fail in the accepted environment"
        )
    if "chunks" in values:
        text = "is no longer an option; give the number of chunks by --set-scatter runs=8"
        raise ConfigurationError(f"--config chunks={values['chunks']}: {text}")
    return Options(baseline, bits == "any", str(accept or "").split())


def project_files(project: Path) -> list[str]:
    """Return the paths of the project's configuration, the file of each study last."""
    return [f"{project}/config/{name}.yaml" for name in ("config", *STUDIES)]


def read_configuration(project: Path, files: Iterable[str], entries: Iterable[str]) -> dict:
    """Return the project's files, then --configfile, then --config, each overriding those before.

    `entries` are the values of --config. They are not read by `configfile:`, because Snakemake
    gives no line number for invalid YAML, silently takes the last of two duplicate keys, reads 010
    as ten, and merges initial data.
    """
    from_command_line = read_entries(
        entry for entry in entries if entry.partition("=")[0] not in NAMES
    )
    return gather([*project_files(project), *files], from_command_line)
