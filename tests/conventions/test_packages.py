"""What the library's wheel holds, by the checkers that other people maintain."""

import shutil
import subprocess
import sys
from importlib.util import find_spec
from zipfile import ZipFile

import pytest
from helpers import ROOT, skip


@pytest.fixture(scope="module")
def wheel(tmp_path_factory):
    """Return the wheel of a copy of the library, so that no build stays beside the code."""
    folder = tmp_path_factory.mktemp("wheel")
    leave_out = shutil.ignore_patterns("build", "*.egg-info", "__pycache__")
    shutil.copytree(ROOT / "packages/latticode", folder / "latticode", ignore=leave_out)
    command = [sys.executable, "-m", "pip", "wheel", "--quiet", "--no-deps", "-w", folder]
    done = subprocess.run([*command, folder / "latticode"], capture_output=True, text=True)
    if done.returncode:
        skip(f"pip cannot build here: {done.stderr[-200:]}", "connect to a package index")
    return next(folder.glob("*.whl"))


@pytest.mark.parametrize("checker", ["twine check --strict", "check_wheel_contents"])
def test_checkers_find_no_fault(wheel, checker):
    module, *options = checker.split()
    if find_spec(module) is None:
        skip(f"{module} is not installed", "pip install -r tests/conventions/requirements.txt")
    command = [sys.executable, "-m", module, *options, wheel]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr


def test_the_wheel_has_the_licence_the_citation_and_the_types(wheel):
    names = ZipFile(wheel).namelist()
    home = f"latticode-{wheel.name.split('-')[1]}.dist-info"
    assert {f"{home}/licenses/LICENSE", f"{home}/licenses/CITATION.cff"} <= set(names)
    assert {"latticode/py.typed", "latticode/kernels/webassembly.js"} <= set(names)
    metadata = ZipFile(wheel).read(f"{home}/METADATA").decode()
    assert "License-Expression: BSD-3-Clause" in metadata and "Classifier: Typing" in metadata
    assert all(name.startswith(("latticode/", home)) for name in names)
