"""The studies' sections of the configuration: all valid, and their faults in words."""

import os
import re
import subprocess
import sys

import pytest
import yaml
from helpers import ROOT, python_path
from pendula.configuration.messages import STUDIES, load


@pytest.fixture(scope="module")
def configuration():
    """Return the project's configuration, as it stands in its files."""
    files = [ROOT / f"config/{name}.yaml" for name in ("config", *STUDIES)]
    return {key: value for file in files for key, value in yaml.safe_load(file.read_text()).items()}


def test_each_study_has_a_section_of_its_own(configuration):
    files = {study: (ROOT / f"config/{study}.yaml").read_text() for study in STUDIES}
    keys = {study: re.findall(r"^\w+", text, re.MULTILINE) for study, text in files.items()}
    assert keys == {study: [study] for study in STUDIES}
    settings = load(configuration)
    assert [study for study in STUDIES if getattr(settings, study) is None] == []


def test_the_configuration_is_read_without_what_computes_or_draws():
    """Each call of Snakemake reads it, and compilers and plots take longer to import than that."""
    heavy = ("flint", "matplotlib", "netCDF4", "numba", "scipy", "xarray")
    code = f"import sys, pendula.configuration.messages; print(sys.modules.keys() & {set(heavy)})"
    command, paths = [sys.executable, "-c", code], {**os.environ, "PYTHONPATH": python_path()}
    actual = subprocess.run(command, env=paths, capture_output=True, text=True, check=True)
    assert actual.stdout == "set()\n"
