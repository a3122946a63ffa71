"""Configuration files: read strictly, then merged.

YAML readers silently accept duplicate keys, and read 010 as 8 and 1:30 as 90. Here each of these is
an error, reported with its line. All other text is read as YAML 1.1 or JSON, as in Snakemake.
"""

import json
import os
import re
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any

import yaml

MOST_VALUES, DEEPEST = 100_000, 30
"""Limits on the number of values and the nesting of a file; beyond them, it is rejected."""
TOO_MANY = f"more than {MOST_VALUES} values, with aliases expanded"
SURPRISES = {
    "int": (
        (re.compile(r"[-+]?0[0-9_]+"), "is read as a number in base 8"),
        (re.compile(r"[-+]?[0-9][0-9_]*(:[0-5]?[0-9])+"), "is read as a number in base 60"),
        (re.compile(r"[-+]?[0-9_]*_[0-9_]*"), "contains _"),
    ),
    "float": (
        (re.compile(r"[-+]?[0-9][0-9_]*(:[0-5]?[0-9])+\.[0-9_]*"), "is read in base 60"),
        (re.compile(r".*_.*"), "contains _"),
    ),
}
"""Numbers that YAML does not read as users expect."""
OF_MODELS = ".py"
"""The suffix of files that define equations."""
PATHS = {"model": (OF_MODELS,), "initial": (".nc", ".npy", ".py")}
"""Keys of a case whose value may be the path of a file, with the allowed suffixes."""
PATHS_BY_SECTION = {"cases": PATHS, "sections": {"when": (OF_MODELS,)}}
PLAIN_TAGS = ("str", "int", "float", "bool", "null", "seq", "map", "merge", "timestamp", "value")
"""The YAML tags that a configuration may contain; others would create Python objects."""
SINGLE_VALUES = ("initial",)
"""Keys with mappings that a later file replaces, instead of merging them."""


class ConfigurationError(ValueError):
    """The configuration has errors; the message lists all of them."""


def list_faults(lines: list[str], subject: str) -> ConfigurationError:
    """Return the exception that lists all errors of `subject`, one per line."""
    many = f"{subject} has {len(lines)} error{'s' * (len(lines) > 1)}:"
    return ConfigurationError("\n  ".join([many, *lines]))


def read(path: Path | str) -> dict:
    """Return the content of a file; raises ConfigurationError with all errors and their lines."""
    path = Path(os.path.normpath(path))
    try:
        text = path.read_bytes().decode("utf-8-sig")
    except FileNotFoundError:
        raise ConfigurationError(f"there is no file {path}") from None
    except UnicodeDecodeError:
        raise ConfigurationError(f"{path} is not text in UTF-8: save it in this encoding") from None
    except OSError as error:
        raise ConfigurationError(f"{path} cannot be read: {error.strerror}") from None
    configuration, faults = parse(text)
    if not faults and not isinstance(configuration, dict):
        fault = "is empty" if configuration is None else "has no keys"
        faults = [f"{fault}; give cases: {{mine: {{model: mine.py, initial: ...}}}}"]
    if faults:
        raise list_faults(faults, str(path))
    return configuration


def read_entries(entries: Iterable[str]) -> dict:
    """Return the entries "name=value" of a command line as a mapping; values are YAML or JSON."""
    values: dict = {}
    faults = []
    for entry in entries:
        name, _, text = entry.partition("=")
        value, wrong = parse(text.strip("'\""))  # quotes that the shell has not removed
        faults += [_of_entry(name, text) for text in wrong]
        faults += [f"{name}: is given twice"] if name in values else []
        values[name] = value
    if faults:
        raise list_faults(faults, "--config")
    return values


def _of_entry(name: str, text: str) -> str:
    """Return the message of an error in the value of an entry, after the path of the key."""
    place, _, fault = text.removeprefix("line 1: ").rpartition(": ")
    return f"{name}.{place}: {fault}" if place else f"{name}: {fault}"


def parse(text: str) -> tuple[Any, list[str]]:
    """Return the content of a text in JSON or YAML, and a list of error messages."""
    if text.lstrip().startswith("{"):
        faults: list[str] = []
        try:
            if text.count(",") > MOST_VALUES:  # commas separate the values of objects and arrays
                return None, [TOO_MANY]
            return json.loads(text, object_pairs_hook=lambda pairs: _pairs(pairs, faults)), faults
        except (ValueError, RecursionError):
            pass  # the text is not JSON; YAML may start with a brace too
    try:
        too_large = _size_fault(text)
        if too_large:
            return None, [too_large]
        loader = yaml.CSafeLoader(text)
        node = loader.get_single_node()
        faults = list(_faults(node, (), set(), loader)) if node else []
        return (None, faults) if faults else (loader.construct_document(node) if node else None, [])
    except yaml.YAMLError as error:
        return None, [_describe_yaml_error(error, text)]


def _pairs(pairs: list, faults: list[str]) -> dict:
    counts = Counter(key for key, _ in pairs)
    faults += [f"the key {key!r} is given twice" for key, count in counts.items() if count > 1]
    return dict(pairs)


def _size_fault(text: str) -> str | None:
    """Return the error of a text with too many values or too deep nesting, if it has one."""
    depth = scalars = 0
    for event in yaml.parse(text, yaml.CSafeLoader):
        scalars += isinstance(event, yaml.ScalarEvent)
        if scalars > 2 * MOST_VALUES:  # keys are counted too; repeated values are counted once
            return f"line {event.start_mark.line + 1}: {TOO_MANY}"
        if isinstance(event, yaml.CollectionStartEvent):
            depth += 1
        elif isinstance(event, yaml.CollectionEndEvent):
            depth -= 1
        if depth > DEEPEST:
            return f"line {event.start_mark.line + 1}: is nested more than {DEEPEST} deep"
    return None


def _faults(
    node: yaml.Node, place: tuple, above: set[int], loader: yaml.CSafeLoader
) -> Iterator[str]:
    """Yield the errors that YAML readers would ignore, each with line and dotted path."""
    position = f"line {node.start_mark.line + 1}: {'.'.join(place)}".rstrip(": ") + ":"
    if id(node) in above:
        yield f"{position} contains itself"
        return
    loader.seen = getattr(loader, "seen", 0) + 1
    if loader.seen > MOST_VALUES:
        if loader.seen == MOST_VALUES + 1:
            yield f"{position} {TOO_MANY}"
        return
    tag = node.tag.removeprefix("tag:yaml.org,2002:")
    if tag not in PLAIN_TAGS:
        yield f"{position} the tag {node.tag} is not allowed: a configuration has plain values only"
    elif isinstance(node, yaml.ScalarNode):
        yield from (f"{position} {text}" for text in _surprises(node, tag, loader))
    elif isinstance(node, yaml.SequenceNode):
        for i, item in enumerate(node.value):
            yield from _faults(item, (*place, str(i)), above | {id(node)}, loader)
    else:
        yield from _faults_of_mapping(node, place, above | {id(node)}, loader)


def _faults_of_mapping(
    node: yaml.MappingNode, place: tuple, above: set[int], loader: yaml.CSafeLoader
) -> Iterator[str]:
    seen = set()
    for key, value in node.value:
        line, name = f"line {key.start_mark.line + 1}:", str(key.value)
        tag = key.tag.removeprefix("tag:yaml.org,2002:")
        path = ".".join((*place, name))
        if not isinstance(key, yaml.ScalarNode):
            yield f"{line} {'.'.join(place)}: a key must be a name or a number"
            continue
        read_as = _read_as(key, tag, loader)
        if tag in ("bool", "null", "timestamp"):
            yield f"{line} {path}: the key is read as {tag}; put it into quotes"
        elif read_as in seen:
            yield f"{line} {path}: the key is given twice"
        yield from (f"{line} {path}: the key {text}" for text in _surprises(key, tag, loader))
        seen.add(read_as)
        yield from _faults(value, place if tag == "merge" else (*place, name), above, loader)


def _read_as(key: yaml.ScalarNode, tag: str, loader: yaml.CSafeLoader) -> Any:
    """Return a key as YAML reads it: 1, +1 and 0x1 are equal, but 1 and "1" differ."""
    try:
        return loader.construct_object(key) if tag in ("int", "float") else (tag, key.value)
    except ValueError:  # reported by `_surprises`
        return tag, key.value


def _surprises(node: yaml.ScalarNode, tag: str, loader: yaml.CSafeLoader) -> Iterator[str]:
    text = node.value
    for pattern, reason in SURPRISES.get(tag, ()):
        if not node.style and pattern.fullmatch(text) and text.strip("+-0"):
            yield f"{text} {reason}; write a decimal number, or use quotes if it is a word"
            return
    try:
        if tag not in ("merge", "value"):
            loader.construct_object(node)
    except ValueError:
        yield f"{text[:60]} is not a {'date' if tag == 'timestamp' else 'number'} that can be read"


def _describe_yaml_error(error: yaml.YAMLError, text: str) -> str:
    mark = getattr(error, "problem_mark", None) or getattr(error, "context_mark", None)
    problem = getattr(error, "problem", None) or getattr(error, "reason", None) or str(error)
    if mark is None:
        return f"is not YAML: {problem}"
    line = [*text.split("\n"), ""][min(mark.line, text.count("\n") + 1)]
    if "start any token" in problem and line[mark.column : mark.column + 1] == "\t":
        problem = "a tab in the indentation: YAML allows only spaces there"
    if "single document" in str(getattr(error, "context", "")):
        problem = "a second YAML document starts; a configuration is a single document"
    return f"line {mark.line + 1}: {problem}"


def merge(below: Mapping, above: Mapping) -> dict:
    """Return the configuration `below`, updated by `above`.

    Mappings are merged key by key. Mappings under the keys SINGLE_VALUES are replaced. The
    controls of a solver are replaced if the two solvers differ.
    """
    merged = dict(below)
    for key, value in above.items():
        old = merged.get(key)
        if isinstance(value, Mapping) and isinstance(old, Mapping) and key not in SINGLE_VALUES:
            is_second_solver = key == "solver" and value.get("name", old.get("name")) != old.get(
                "name"
            )
            merged[key] = dict(value) if is_second_solver else merge(old, value)
        else:
            merged[key] = value
    return merged


def with_paths(configuration: dict, folder: Path) -> dict:
    """Return a configuration in which `folder` is prepended to the paths of files."""
    located = dict(configuration)
    for section, paths in PATHS_BY_SECTION.items():
        entries = configuration.get(section)
        if isinstance(entries, dict):
            located[section] = {n: _located(entry, paths, folder) for n, entry in entries.items()}
    return located


def _located(entry: Any, paths: Mapping[str, tuple[str, ...]], folder: Path) -> Any:
    """Return a case or a section with `folder` prepended to its paths, such as mine.py:plane."""
    for key, endings in paths.items():
        path = entry.get(key) if isinstance(entry, dict) else None
        if isinstance(path, str) and path.partition(":")[0].endswith(endings):
            entry = {**entry, key: str(folder / path)}
    return entry


def gather(files: list[Path], entries: Mapping) -> dict:
    """Return `files` and then `entries`, merged: later values override earlier values."""
    merged: dict = {}
    for path in files:
        merged = merge(merged, with_paths(read(path), Path(path).parent))
    return merge(merged, with_paths(dict(entries), Path()))
