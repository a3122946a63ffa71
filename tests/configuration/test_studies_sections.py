"""The studies' sections of the configuration: all valid, and their faults in words."""

import os
import re
import subprocess
import sys
from typing import Annotated, Literal, get_args, get_origin

import pytest
import yaml
from helpers import ROOT, python_path
from pendula.configuration.messages import STUDIES, Sections, load
from pydantic import BaseModel, TypeAdapter, ValidationError


@pytest.fixture(scope="module")
def whole():
    """Return the project's configuration, as it stands in its files."""
    files = [ROOT / f"config/{name}.yaml" for name in ("config", *STUDIES)]
    return {key: value for file in files for key, value in yaml.safe_load(file.read_text()).items()}


def test_each_study_has_a_section_of_its_own(whole):
    files = {study: (ROOT / f"config/{study}.yaml").read_text() for study in STUDIES}
    keys = {study: re.findall(r"^\w+", text, re.MULTILINE) for study, text in files.items()}
    assert keys == {study: [study] for study in STUDIES}
    settings = load(whole)
    assert [study for study in STUDIES if getattr(settings, study) is None] == []


def leaves(kind, place=""):
    """Yield each type of a single value inside a type, and its place: a model's keys below it."""
    bare = get_args(kind)[0] if get_origin(kind) is Annotated else kind
    if isinstance(bare, type) and issubclass(bare, BaseModel):
        for key, field in bare.model_fields.items():
            yield from leaves(field.rebuild_annotation(), f"{place}.{key}")
        return
    parts = [] if get_origin(bare) is Literal else get_args(bare)
    for part in parts:
        yield from leaves(part, place)
    if not parts:
        yield place.removeprefix("."), kind, bare


def accepts(kind, value):
    try:
        TypeAdapter(kind).validate_python(value)
    except ValidationError:
        return False
    return True


def test_no_number_of_the_configuration_is_read_from_what_is_none():
    """Hard cases alone have numbers that are not finite: solvers must refuse them."""
    numbers = [leaf for leaf in leaves(Sections) if leaf[2] in (int, float, complex)]
    assert {place.split(".")[0] for place, *_ in numbers} > {*STUDIES, "cases", "sweeps", "limits"}
    read = [
        (place, value)
        for place, kind, _ in numbers
        for value in (True, "1_0", "one", "", None, [1], "0x1", float("nan"))
        if accepts(kind, value) and not (value != value and place.startswith("hard_cases."))
    ]
    assert read == []


def test_the_configuration_is_read_without_what_computes_or_draws():
    """Each call of Snakemake reads it, and compilers and plots take longer to import than that."""
    heavy = ("flint", "matplotlib", "netCDF4", "numba", "scipy", "xarray")
    code = f"import sys, pendula.configuration.messages; print(sys.modules.keys() & {set(heavy)})"
    command, paths = [sys.executable, "-c", code], {**os.environ, "PYTHONPATH": python_path()}
    found = subprocess.run(command, env=paths, capture_output=True, text=True, check=True)
    assert found.stdout == "set()\n"
