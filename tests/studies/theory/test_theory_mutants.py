"""Wrong equations make checks fail: each mutant changes one place of the library's text."""

import shutil
from pathlib import Path

import pytest
from helpers import edit
from mutants import first_failing_of

LIBRARY = Path(__file__).parents[3] / "scripts" / "pendula"
MODEL, CHAIN = "models/amplitudes.py", "models/chain.py"

MUTATIONS = {
    "sign of the cubic term": (MODEL, "+ 0.5 * squared_modulus * u", "- 0.5 * squared_modulus * u"),
    "factor of the cubic term": (MODEL, "+ 0.5 * squared_modulus * u", "+ squared_modulus * u"),
    "sign of the coupling": (MODEL, "return coupling +", "return -coupling +"),
    "sign of Omega": (MODEL, "+ chain.omega * u", "- chain.omega * u"),
    "sign of the drive": (MODEL, "+ drive * (partner - u)", "- drive * (partner - u)"),
    "twice gamma": (MODEL, "gamma = chain.gamma", "gamma = 2.0 * chain.gamma"),
    "drive without the own part": (MODEL, "drive * (partner - u)", "drive * partner"),
    "drive not conjugated": (MODEL, "chain, -gamma, y[im, j - 1]", "chain, gamma, y[im, j - 1]"),
    "free ends for Dirichlet": (CHAIN, "chain.left == FREE", "chain.left <= FREE"),
    "Dirichlet ends for free": (CHAIN, "chain.right == FREE", "chain.right == MIRROR"),
    "ring joined wrongly": (CHAIN, "y[row, 0] = y[row, n]", "y[row, 0] = y[row, n - 1]"),
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
        (CHAIN, "chain.left == FREE", "chain.left <= FREE"),
        (CHAIN, "chain.right == FREE", "chain.right <= FREE"),
    ],
}


@pytest.fixture(scope="module")
def copied(tmp_path_factory):
    """Return a folder with the library, and the bytecode of what does not change."""
    folder = tmp_path_factory.mktemp("mutants")
    shutil.copytree(LIBRARY, folder / "pendula", ignore=shutil.ignore_patterns("drawing"))
    for name in (MODEL, CHAIN):
        shutil.rmtree((folder / "pendula" / name).parent / "__pycache__", ignore_errors=True)
    return folder


@pytest.fixture
def failing_check(copied):
    """Return a function: the first check that fails on a library with these edits."""

    def find(edits) -> str:
        for name in (MODEL, CHAIN):
            shutil.copy(LIBRARY / name, copied / "pendula" / name)
        for name, old, new in edits:
            edit(copied / "pendula" / name, old, new)
        found = first_failing_of(str(copied))
        assert found, "no check: it ended in an error"
        return found

    return find


def test_the_library_itself_passes(failing_check):
    assert failing_check([]) == "none"


@pytest.mark.parametrize("name", MUTATIONS)
def test_mutant_is_caught(name, failing_check):
    assert failing_check([MUTATIONS[name]]) != "none"


@pytest.mark.parametrize("name", CONSISTENT)
def test_mutant_of_equations_and_energy_alike_is_caught(name, failing_check):
    assert failing_check(CONSISTENT[name]) != "none"
