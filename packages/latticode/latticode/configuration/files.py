"""Configuration files as they stand: read strictly, and laid over each other.

YAML readers take the last of two equal keys, 010 for eight and 1:30 for ninety, and say nothing.
Here each is a fault with its place. All else is read as YAML 1.1 or JSON, as Snakemake reads it.
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
"""A file of more values, or nested deeper, is no configuration but an accident."""
TOO_MANY = f"more than {MOST_VALUES} values, counting each time that one is repeated"
SURPRISES = {
    "int": (
        (re.compile(r"[-+]?0[0-9_]+"), "is read as a number to the base 8"),
        (re.compile(r"[-+]?[0-9][0-9_]*(:[0-5]?[0-9])+"), "is read as a number to the base 60"),
        (re.compile(r"[-+]?[0-9_]*_[0-9_]*"), "has a _ in it"),
    ),
    "float": (
        (re.compile(r"[-+]?[0-9][0-9_]*(:[0-5]?[0-9])+\.[0-9_]*"), "is read to the base 60"),
        (re.compile(r".*_.*"), "has a _ in it"),
    ),
}
"""Numbers that YAML reads otherwise than people do."""
OF_MODELS = ".py"
"""How the names of files end that hold equations."""
PATHS = {"model": (OF_MODELS,), "initial": (".nc", ".npy", ".py")}
"""Keys of a case that may be the path of a file, and how its name ends."""
PLAIN_TAGS = ("str", "int", "float", "bool", "null", "seq", "map", "merge", "timestamp", "value")
"""The tags of YAML that a configuration may have; others would make objects of programs."""
SINGLE_VALUES = ("initial",)
"""Keys of mappings that are one value: a later file replaces them, and adds nothing to them."""


class ConfigurationError(ValueError):
    """The configuration has errors; the message lists them all."""


def list_faults(lines: list[str], subject: str) -> ConfigurationError:
    """Return the exception that lists all errors of `subject`, a line each."""
    many = f"{subject} has {len(lines)} error{'s' * (len(lines) > 1)}:"
    return ConfigurationError("\n  ".join([many, *lines]))


def read(path: Path | str) -> dict:
    """Return what a file holds, or raise ConfigurationError with every fault and its line."""
    path = Path(os.path.normpath(path))
    try:
        text = path.read_bytes().decode("utf-8-sig")
    except FileNotFoundError:
        raise ConfigurationError(f"there is no file {path}") from None
    except UnicodeDecodeError:
        raise ConfigurationError(f"{path} is not a text in UTF-8: save it in that code") from None
    except OSError as error:
        raise ConfigurationError(f"{path} cannot be read: {error.strerror}") from None
    configuration, faults = parse(text)
    if not faults and not isinstance(configuration, dict):
        fault = "is empty" if configuration is None else "holds no keys"
        faults = [f"{fault}; give cases: {{mine: {{model: mine.py, initial: ...}}}}"]
    if faults:
        raise list_faults(faults, str(path))
    return configuration


def read_entries(entries: Iterable[str]) -> dict:
    """Return what entries "name=value" of a command line hold, each value read as a file is."""
    values: dict = {}
    faults = []
    for entry in entries:
        name, _, text = entry.partition("=")
        value, wrong = parse(text.strip("'\""))  # quotes that a shell left
        faults += [_of_entry(name, text) for text in wrong]
        faults += [f"{name}: is given twice"] if name in values else []
        values[name] = value
    if faults:
        raise list_faults(faults, "--config")
    return values


def _of_entry(name: str, text: str) -> str:
    """Return a fault of the value of an entry behind the whole path of its key."""
    place, _, fault = text.removeprefix("line 1: ").rpartition(": ")
    return f"{name}.{place}: {fault}" if place else f"{name}: {fault}"


def parse(text: str) -> tuple[Any, list[str]]:
    """Return what a text in JSON or YAML holds, and its faults in words."""
    if text.lstrip().startswith("{"):
        faults: list[str] = []
        try:
            if text.count(",") > MOST_VALUES:  # between two values of an object or an array
                return None, [TOO_MANY]
            return json.loads(text, object_pairs_hook=lambda pairs: _pairs(pairs, faults)), faults
        except (ValueError, RecursionError):
            pass  # YAML may start with a brace too
    try:
        too_large = _size_fault(text)
        if too_large:
            return None, [too_large]
        loader = yaml.CSafeLoader(text)
        node = loader.get_single_node()
        faults = list(_faults(node, (), set(), loader)) if node else []
        return (None, faults) if faults else (loader.construct_document(node) if node else None, [])
    except yaml.YAMLError as error:
        return None, [_in_words(error, text)]


def _pairs(pairs: list, faults: list[str]) -> dict:
    counts = Counter(key for key, _ in pairs)
    faults += [f"the key {key!r} stands twice" for key, count in counts.items() if count > 1]
    return dict(pairs)


def _size_fault(text: str) -> str | None:
    """Return the fault of a text that is too long or nested too deeply to be read."""
    depth = scalars = 0
    for event in yaml.parse(text, yaml.CSafeLoader):
        scalars += isinstance(event, yaml.ScalarEvent)
        if scalars > 2 * MOST_VALUES:  # keys too, and each of what is repeated once
            return f"line {event.start_mark.line + 1}: {TOO_MANY}"
        if isinstance(event, yaml.CollectionStartEvent):
            depth += 1
        elif isinstance(event, yaml.CollectionEndEvent):
            depth -= 1
        if depth > DEEPEST:
            return f"line {event.start_mark.line + 1}: is nested more than {DEEPEST} deep"
    return None


def _faults(node: yaml.Node, place: tuple, above: set, loader) -> Iterator[str]:
    """Yield what YAML would read in silence, with its line and dotted path."""
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
        yield f"{position} the tag {node.tag} is not read: a configuration holds plain values"
    elif isinstance(node, yaml.ScalarNode):
        yield from (f"{position} {text}" for text in _surprises(node, tag, loader))
    elif isinstance(node, yaml.SequenceNode):
        for i, item in enumerate(node.value):
            yield from _faults(item, (*place, str(i)), above | {id(node)}, loader)
    else:
        yield from _faults_of_mapping(node, place, above | {id(node)}, loader)


def _faults_of_mapping(node: yaml.MappingNode, place: tuple, above: set, loader) -> Iterator[str]:
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
            yield f"{line} {path}: the key stands twice"
        yield from (f"{line} {path}: the key {text}" for text in _surprises(key, tag, loader))
        seen.add(read_as)
        yield from _faults(value, place if tag == "merge" else (*place, name), above, loader)


def _read_as(key: yaml.ScalarNode, tag: str, loader) -> Any:
    """Return what YAML makes of a key: 1, +1 and 0x1 are the same, and 1 and "1" are not."""
    try:
        return loader.construct_object(key) if tag in ("int", "float") else (tag, key.value)
    except ValueError:  # told elsewhere
        return tag, key.value


def _surprises(node: yaml.ScalarNode, tag: str, loader) -> Iterator[str]:
    text = node.value
    for pattern, reason in SURPRISES.get(tag, ()):
        if not node.style and pattern.fullmatch(text) and text.strip("+-0"):
            yield f"{text} {reason}; write it in decimals, or in quotes if it is a word"
            return
    try:
        if tag not in ("merge", "value"):
            loader.construct_object(node)
    except ValueError:
        yield f"{text[:60]} is not a {'date' if tag == 'timestamp' else 'number'} that can be read"


def _in_words(error: yaml.YAMLError, text: str) -> str:
    mark = getattr(error, "problem_mark", None) or getattr(error, "context_mark", None)
    problem = getattr(error, "problem", None) or getattr(error, "reason", None) or str(error)
    if mark is None:
        return f"is not YAML: {problem}"
    line = [*text.split("\n"), ""][min(mark.line, text.count("\n") + 1)]
    if "start any token" in problem and line[mark.column : mark.column + 1] == "\t":
        problem = "a tab stands where blanks must: YAML is indented by blanks alone"
    if "single document" in str(getattr(error, "context", "")):
        problem = "a second document starts; a configuration is one"
    return f"line {mark.line + 1}: {problem}"


def merge(below: Mapping, above: Mapping) -> dict:
    """Return one configuration laid over another: keys are added, values replaced.

    Mappings are merged key by key, but not those under the keys WHOLE, which are one value, and
    not the controls of another solver.
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
    """Return a configuration whose paths of models and of initial data start at `folder`."""
    cases = configuration.get("cases")
    if not isinstance(cases, dict):
        return configuration
    located_cases = dict(cases)
    for name, case in cases.items():
        for key, endings in PATHS.items():
            path = case.get(key) if isinstance(case, dict) else None
            if isinstance(path, str) and path.endswith(endings):
                case = {**case, key: str(folder / path)}
        located_cases[name] = case
    return {**configuration, "cases": located_cases}


def gather(files: list[Path], entries: Mapping) -> dict:
    """Return what files hold, each laid over those before it, and `entries` over all."""
    merged: dict = {}
    for path in files:
        merged = merge(merged, with_paths(read(path), Path(path).parent))
    return merge(merged, with_paths(dict(entries), Path()))
