"""The promise of all solvers: the same bits whatever the code was compiled for."""

import json
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


def run_on(machine, cache, threads):
    """Run the cases in a process of its own on a played machine."""
    settings = {"PYTHONPATH": str(SCRIPTS), "NUMBA_CACHE_DIR": str(cache)}
    command = [sys.executable, bits.__file__, str(threads)]
    environment = machines.environment(machine) | settings
    done = subprocess.run(command, env=environment, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


@pytest.mark.parametrize("machine", machines.PLAYED)
def test_code_for_another_processor_gives_the_same_bits_cold_warm_and_threaded(machine, tmp_path):
    if why := machines.why_not(machine):
        skip(why, machines.ELSEWHERE)
    cold, warm = run_on(machine, tmp_path, 1), run_on(machine, tmp_path, 2)
    assert set(cold["cached"].values()) == {0} and min(warm["cached"].values()) > 0
    assert cold["hashes"] == warm["hashes"] == {name: [value] for name, value in HASHES.items()}


@pytest.mark.parametrize(("name", "even"), bits.RUNS)
def test_code_for_this_processor_gives_the_committed_bits(name, even):
    assert bits.run(name, even) == HASHES[name]
