"""Wrong equations make checks fail: each mutant changes one place of the library's text."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from helpers import HANGS

LIBRARY = Path(__file__).parents[3] / "scripts" / "pendula"
MUTANTS = Path(__file__).parent / "mutants.py"
MODEL = "models/amplitudes.py"

MUTATIONS = {
    "sign of the cubic term": (MODEL, "+ 0.5 * squared_modulus * u", "- 0.5 * squared_modulus * u"),
    "factor of the cubic term": (MODEL, "+ 0.5 * squared_modulus * u", "+ squared_modulus * u"),
    "sign of the coupling": (MODEL, "return coupling +", "return -coupling +"),
    "sign of Omega": (MODEL, "+ chain.omega * u", "- chain.omega * u"),
    "sign of the drive": (MODEL, "+ drive * (partner - u)", "- drive * (partner - u)"),
    "twice gamma": (MODEL, "gamma = chain.gamma", "gamma = 2.0 * chain.gamma"),
    "drive without the own part": (MODEL, "drive * (partner - u)", "drive * partner"),
    "drive not conjugated": (MODEL, "chain, -gamma, y[im, j - 1]", "chain, gamma, y[im, j - 1]"),
    "free ends for Dirichlet": (MODEL, "chain.left == FREE", "chain.left <= FREE"),
    "Dirichlet ends for free": (MODEL, "chain.right == FREE", "chain.right == MIRROR"),
    "ring joined wrongly": (MODEL, "y[row, 0] = y[row, n]", "y[row, 0] = y[row, n - 1]"),
    "lost end bonds": (MODEL, "n < reach or chain.left != PERIODIC", "n < reach"),
    "twice the bonds": (MODEL, "chain.epsilon * on_bonds", "2 * chain.epsilon * on_bonds"),
    "sign of the drive's energy": (MODEL, "drive = chain.gamma", "drive = -chain.gamma"),
    "quartic term": (MODEL, "out[j] = square * (0.25", "out[j] = square * (0.5"),
}  # fmt: skip

CONSISTENT = {
    "twice gamma in both": [
        (MODEL, "gamma = chain.gamma", "gamma = 2.0 * chain.gamma"),
        (MODEL, "drive = chain.gamma", "drive = 2.0 * chain.gamma"),
    ],
    "sign of gamma in both": [
        (MODEL, "+ drive * (partner - u)", "- drive * (partner - u)"),
        (MODEL, "drive = chain.gamma", "drive = -chain.gamma"),
    ],
    "free ends in both": [
        (MODEL, "chain.left == FREE", "chain.left <= FREE"),
        (MODEL, "chain.right == FREE", "chain.right <= FREE"),
    ],
}


def failing_check(folder, edits) -> str:
    """Return the first check that fails on a library with these edits, run as plain Python."""
    scripts = folder / "scripts"
    skip = shutil.ignore_patterns("__pycache__", "drawing")
    shutil.copytree(LIBRARY, scripts / "pendula", ignore=skip)
    for name, old, new in edits:
        path = scripts / "pendula" / name
        text = path.read_text(encoding="utf-8")
        assert text.count(old) == 1, f"{old!r} stands {text.count(old)} times in {name}"
        path.write_text(text.replace(old, new), encoding="utf-8")
    environment = os.environ | {"PYTHONPATH": str(scripts), "NUMBA_DISABLE_JIT": "1"}
    command = [sys.executable, "-W", "ignore", str(MUTANTS)]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=HANGS)
    assert done.returncode == 0, done.stderr
    return done.stdout.strip()


def test_the_library_itself_passes(tmp_path):
    assert failing_check(tmp_path, []) == "none"


@pytest.mark.parametrize("name", MUTATIONS)
def test_mutant_is_caught(name, tmp_path):
    assert failing_check(tmp_path, [MUTATIONS[name]]) != "none"


@pytest.mark.parametrize("name", CONSISTENT)
def test_mutant_of_equations_and_energy_alike_is_caught(name, tmp_path):
    assert failing_check(tmp_path, CONSISTENT[name]) != "none"
