"""Reads the configuration before Snakemake does, and says in words what cannot be read.

Snakemake reads the files of --configfile before any line of the Snakefile, and ends in a traceback
where one is missing, is not UTF-8, or holds a number or a date that Python refuses. It reads its
profile earlier still, and a profile may hold Python: so the profiles of this project call `look`.
The option --configfile takes every word behind it, so that a target that stands there is taken for
a file; `look` says that too.
"""

import os
import sys
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(PROJECT / "scripts"))

from pendula.configuration.files import ConfigurationError, parse, read  # noqa: E402

ENDINGS = ".yaml", ".yml", ".json"


def words_of(arguments: list[str], names: tuple[str, ...]) -> list[str]:
    """Return the words that a command line gives to the option with one of these names."""
    found, taking = [], False
    for word in arguments:
        name, _, value = word.partition("=")
        if word.startswith("-"):
            taking = name in names and not value
            found += [value] if name in names and value else []
        elif taking:
            found.append(word)
    return found


def fault_of(file: str) -> str | None:
    """Return what keeps a file from being read, in words, or None."""
    if Path(file).is_dir():
        return f"--configfile {file}: this is a folder: name a file in it, such as mine.yaml"
    if Path(file).exists() and not Path(file).is_file():
        return f"--configfile {file}: this is no regular file, and it must be read more than once"
    try:
        read(file)
    except ConfigurationError as error:
        path = Path(file)
        if path.suffix in ENDINGS or path.is_file():
            return str(error)
        return (
            f"there is no configuration file {file}. --configfile takes every word that follows "
            f"it, so targets stand before it: snakemake {file} --configfile mine.yaml"
        )
    return None


def fault_of_folder(folder: str) -> str | None:
    """Return why Snakemake can neither enter nor make the folder of --directory, or None."""
    path = Path(folder).absolute()
    there = next(place for place in (path, *path.parents) if os.path.lexists(place))
    if not there.is_dir():
        return f"--directory {folder}: {there} is no folder, and results need one: name another"
    return None


def faults_in(word: str) -> list[str]:
    """Return what Snakemake cannot take in a word of --config, and what YAML reads in silence."""
    name, _, value = word.partition("=")
    if not name.isidentifier():
        first, *inner = name.split(".")
        nested = "".join(f"{{{key}: " for key in inner) + value + "}" * len(inner)
        return [f"{name!r} is no name of a key; keys inside it are given as {first}='{nested}'"]
    return parse(value.strip())[1] if value.strip().startswith("{") else []


def look(arguments: list[str]) -> None:
    """End Snakemake with the faults of its configuration, if it has any."""
    own = str(PROJECT / "config/config.yaml")  # the Snakefile's `configfile`
    files = words_of(arguments, ("--configfile", "--configfiles"))
    faults = [fault for file in [own, *files] if (fault := fault_of(file))]
    given = words_of(arguments, ("--config", "-C"))
    faults += [
        f"--config {word}: {fault}" for word in given if "=" in word for fault in faults_in(word)
    ]
    faults += [
        f"--config takes name=value and every word that follows it, and {word!r} is none: targets "
        "stand before it, as in snakemake own --config limits='{hours: 2}'"
        for word in given
        if "=" not in word
    ]
    folders = words_of(arguments, ("--directory", "-d"))[:1]  # targets may follow it
    faults += [fault for folder in folders if (fault := fault_of_folder(folder))]
    if faults:
        print("\n".join(faults), file=sys.stderr)
        raise SystemExit(1)


def forget() -> None:
    """Unload this project's modules: the Snakefile may be that of another copy of the project.

    Snakemake takes the profile of the folder in which it is called, whatever --snakefile says. The
    Snakefile must import, and record as what its jobs depend on, the code that lies beside it.
    """
    added = {str(PROJECT / "workflow"), str(PROJECT / "scripts")}
    sys.path[:] = [folder for folder in sys.path if folder not in added]
    for name, module in list(sys.modules.items()):
        file = getattr(module, "__file__", None) or ""
        if file == __file__ or file.startswith(str(PROJECT / "scripts") + os.sep):
            del sys.modules[name]
