"""The promise of most solvers: the same bits whatever the code was compiled for.

Not ode45, whose powers of 1/5 are the C library's, and not splitting, whose sines and cosines are.
"""

import json
import os
import subprocess
import sys
from pathlib import Path

import bits
import pytest
from llvmlite import binding

HASHES = {
    "taylor": "f71cfb065655de7a",
    "dop853": "38b2cde420d22b67",
    "crank_nicolson": "6f9d6c6adde79234",
    "delfour_fortin_payre": "24e783140ae11f55",
}
"""Bits that every machine must get. A change of the equations' or a solver's arithmetic changes
them: if it was meant, put here what `python tests/bits.py` prints, and say why in the commit."""

TARGETS = {
    "generic": ("generic", ""),
    "haswell": ("haswell", "+avx2,+fma"),  # fused operations allowed, but not to be used
    "skylake-avx512": ("skylake-avx512", "+avx2,+fma,+avx512f,+avx512dq,+avx512vl"),
}
SCRIPTS = Path(__file__).resolve().parents[1] / "scripts"


def run_for(target, cache, threads):
    """Run the cases in a process of its own, compiled for a target of TARGETS."""
    processor, features = TARGETS[target]
    settings = {
        "PYTHONPATH": str(SCRIPTS),
        "NUMBA_CACHE_DIR": str(cache),
        "NUMBA_CPU_NAME": processor,
        "NUMBA_CPU_FEATURES": features,
    }
    command = [sys.executable, bits.__file__, str(threads)]
    done = subprocess.run(command, env=os.environ | settings, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def unsupported(target):
    """Return the features of a target that this machine lacks."""
    here = binding.get_host_cpu_features()
    wanted = [word.removeprefix("+") for word in TARGETS[target][1].split(",") if word]
    return [feature for feature in wanted if not here.get(feature)]


@pytest.mark.parametrize("target", TARGETS)
def test_code_for_another_processor_gives_the_same_bits_cold_warm_and_threaded(target, tmp_path):
    if unsupported(target):
        pytest.skip(f"this processor has no {', '.join(unsupported(target))}")
    cold, warm = run_for(target, tmp_path, 1), run_for(target, tmp_path, 2)
    assert set(cold["cached"].values()) == {0} and min(warm["cached"].values()) > 0
    assert cold["hashes"] == warm["hashes"] == {name: [value] for name, value in HASHES.items()}


@pytest.mark.parametrize(("name", "even"), bits.RUNS)
def test_code_for_this_processor_gives_the_committed_bits(name, even):
    assert bits.run(name, even) == HASHES[name]
