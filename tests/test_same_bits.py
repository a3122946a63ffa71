"""The promise of all solvers: the same bits whatever the code was compiled for."""

import json
import os
import subprocess
import sys
from pathlib import Path

import bits
import machines
import pytest
from helpers import skip

HASHES = {
    "taylor": "f71cfb065655de7a",
    "dop853": "38b2cde420d22b67",
    "ode45": "b631c3cae2ec2289",
    "crank_nicolson": "6f9d6c6adde79234",
    "delfour_fortin_payre": "24e783140ae11f55",
    "splitting": "ff5447d6f294a8c0",
}
"""Bits that every machine must get. A change of the equations' or a solver's arithmetic changes
them: if it was meant, put here what `python tests/bits.py` prints, and say why in the commit."""

SCRIPTS = Path(__file__).resolve().parents[1] / "scripts"
COMMITTED = {name: [value] for name, value in HASHES.items()}


def run(python, environment, cache, threads):
    """Run the cases in a process of its own."""
    settings = {"PYTHONPATH": str(SCRIPTS), "PENDULA_CACHE": str(cache)}
    command = [python, bits.__file__, str(threads)]
    done = subprocess.run(command, env=environment | settings, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


@pytest.mark.parametrize("machine", machines.PLAYED)
def test_code_for_another_processor_gives_the_same_bits_cold_warm_and_threaded(machine, tmp_path):
    if why := machines.why_not(machine):
        skip(why, machines.ELSEWHERE)
    played = machines.environment(machine)
    cold, warm = (run(sys.executable, played, tmp_path, threads) for threads in (1, 2))
    assert set(cold["cached"].values()) == {0} and min(warm["cached"].values()) > 0
    assert cold["hashes"] == warm["hashes"] == COMMITTED


def test_another_family_of_processors_gives_the_same_bits(tmp_path):
    python = os.environ.get("PENDULA_PYTHON_OF_AARCH64")
    if not python:
        skip("there is no Python of another family of processors", "run .ci/elsewhere aarch64")
    found = run(python, dict(os.environ), tmp_path, 1)
    assert found["machine"] == "aarch64" and found["hashes"] == COMMITTED


@pytest.mark.parametrize(("name", "even"), bits.RUNS)
def test_code_for_this_processor_gives_the_committed_bits(name, even):
    assert bits.run(name, even) == HASHES[name]
