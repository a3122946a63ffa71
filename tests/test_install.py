"""An editable install into a fresh environment: importable from anywhere, and nothing else is.

It is a printed command that fetches what builds the package: `.ci/elsewhere commands` runs it.
"""

import os
import subprocess
import sys
import sysconfig
import venv
from pathlib import Path

import pytest
from helpers import skip

ROOT = Path(__file__).resolve().parents[1]
USE = """
import pendula, sys
assert "numpy" not in sys.modules
assert pendula.__file__.startswith({root!r}), pendula.__file__
from pendula import Case, simulate
print(simulate(Case(omega=8, end_time=1))["l2"].shape)
for name in ("job", "figures", "trajectories"):
    try:
        __import__(name)
    except ImportError:
        continue
    raise SystemExit(name + " was installed too")
"""


@pytest.fixture(scope="module")
def python(tmp_path_factory):
    """Return the interpreter of a new environment that sees the packages of this one."""
    if not os.environ.get("PENDULA_AS_PRINTED"):
        skip("it fetches what builds the package", "run .ci/elsewhere commands")
    folder = tmp_path_factory.mktemp("installed")
    venv.create(folder)  # the pip of this environment can install into others
    home = folder / ("Scripts" if sys.platform == "win32" else "bin") / "python"
    paths = {"base": str(folder), "platbase": str(folder)}
    packages = Path(sysconfig.get_path("purelib", vars=paths))
    (packages / "ours.pth").write_text(sysconfig.get_path("purelib") + "\n")
    return home


def run(*command, **options):
    return subprocess.run(
        [str(word) for word in command], capture_output=True, text=True, **options
    )


def test_an_editable_install_is_found_from_anywhere(python, tmp_path):
    pip = [sys.executable, "-m", "pip", "--python", python]
    installed = run(*pip, "install", "--no-deps", "-e", ROOT)
    if "No matching distribution found for setuptools" in installed.stderr:
        skip("setuptools, which builds the package, cannot be fetched", "run it with a network")
    assert installed.returncode == 0, installed.stdout + installed.stderr
    used = run(python, "-c", USE.format(root=str(ROOT)), cwd=tmp_path)
    assert used.returncode == 0, used.stderr
    assert used.stdout == "(2, 41)\n" and not list(tmp_path.iterdir())
