"""The promise of all numbers: the same bits whatever the code was compiled for."""

import hashlib
import json
import os
import subprocess
import sys
import tomllib
from pathlib import Path

import bits
import machines
import numpy as np
import pytest
import some_numbers
from accepted import BASELINE
from another_numba import another_numba
from helpers import skip
from latticode.datasets.netcdf import read
from latticode.localised.tangents import grow
from oracle import random_chain
from problems import problem_from
from replication.figure_diff import hashes

HASHES = {
    "taylor": "d82703b9513aa321",
    "dop853": "e8e9099053691165",
    "ode45": "904e22c26d8e69c2",
    "crank_nicolson": "8ecca50d5c4699f4",
    "delfour_fortin_payre": "0e3f799a9f5b9e0e",
    "pendula.taylor": "e4b45fbb3c95a240",
    "pendula.dop853": "c0e838f9c6b70666",
    "pendula.ode45": "4b213e23de37b7f1",
    "pendula.kahan_li": "3bc3bea5acb650fe",
    "long.taylor": "463ea4c6fdf638d9",
    "batch.taylor": "b123a7d0964282f3",
}
"""Bits that every machine must get. A change of the equations' or a solver's arithmetic changes
them: if it was meant, put here what `python tests/bits.py` prints, and say why in the commit."""

PROJECT = Path(__file__).resolve().parents[1]
PLACES = [
    str(PROJECT / place)
    for place in ("packages/latticode", "packages/latticode/tests", "scripts", "tests")
]
COMMITTED = {name: [value] for name, value in HASHES.items()}


def run(python, environment, cache, threads, *solvers):
    """Run the cases in a process of its own."""
    settings = {"LATTICODE_CACHE": str(cache)}
    return json.loads(output_of([python, bits.__file__, threads, *solvers], environment | settings))


def output_of(command, environment):
    """Return what a program prints that uses the library."""
    path = os.pathsep.join([*PLACES, environment.get("PYTHONPATH", "")])
    settings = environment | {"PYTHONPATH": path}
    done = subprocess.run([*map(str, command)], env=settings, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.fixture(scope="module")
def numbers_by(tmp_path_factory):
    """Return a function: the hashes of what some_numbers.py makes by some Python."""
    values = BASELINE / "unbounded"

    def make(python, environment):
        results = tmp_path_factory.mktemp("made")
        output_of([python, some_numbers.__file__, values, results], environment)
        return {path.stem: hashes.of(read(path)) for path in results.iterdir()}

    return make


CHOSEN = """
import ctypes, hashlib, json, math, numba, pathlib, numpy as np
folder = pathlib.Path(np.__file__).parents[1] / "numpy.libs"
core = ctypes.CDLL(next(folder.glob("*openblas*"))).scipy_openblas_get_corename64_
core.restype = ctypes.c_char_p
bits = np.array([f(k / 97) for f in (math.exp, math.sin, math.log) for k in range(1, 4001)])
found = np.show_config(mode="dicts")["SIMD Extensions"].get("found", [])
print(json.dumps([found, core().decode(), numba.config.CPU_NAME, bits.tobytes().hex()]))
"""


def need_time():
    if not os.environ.get("PENDULA_PLAYED"):
        skip("what is compiled anew takes minutes", "run .ci/elsewhere bits")


def need_machine(name):
    """Skip if PENDULA_PLAYED is not set, or if this computer cannot play the machine `name`."""
    need_time()
    if not machines.playable(name):
        skip(f"{name} cannot be played here", "run it on x86-64 with AVX-512, FMA and glibc")


@pytest.mark.parametrize("name", machines.PLAYED)
def test_each_library_chooses_the_code_of_the_machine(name):
    """Otherwise a comparison of two machines would compare one."""
    need_machine(name)
    command = [sys.executable, "-c", CHOSEN]
    native, second = (
        json.loads(output_of(command, entry))
        for entry in (dict(os.environ), machines.environment(name))
    )
    machine = machines.PLAYED[name]
    assert second[:3] == [list(machine.numpy), machine.openblas, machine.numba]
    assert (second[3] == native[3]) == (machine.numpy != ())


@pytest.mark.parametrize("machine", machines.PLAYED)
def test_code_for_another_processor_gives_the_same_bits_cold_warm_and_threaded(machine, tmp_path):
    need_machine(machine)
    played = machines.environment(machine)
    cold, warm = (run(sys.executable, played, tmp_path, threads) for threads in (1, 2))
    assert set(cold["cached"].values()) == {0} and min(warm["cached"].values()) > 0
    assert cold["hashes"] == warm["hashes"] == COMMITTED


def test_numba_alone_compiles_and_keeps_code_of_the_same_bits(tmp_path):
    need_time()
    environment, solvers = another_numba(tmp_path), ("pendula.kahan_li",)
    cold, warm = (run(sys.executable, environment, tmp_path, 1, *solvers) for _ in range(2))
    assert (set(cold["cached"].values()), set(warm["cached"].values())) == ({0}, {1})
    assert {file.suffix for file in tmp_path.rglob("*.nb*")} == {".nbi", ".nbc"}
    assert cold["hashes"] == warm["hashes"] == {name: COMMITTED[name] for name in solvers}


def test_a_kernel_made_of_a_traced_model_is_kept_for_other_processes():
    bits.run("taylor", even=True)
    actual = json.loads(output_of([sys.executable, bits.__file__, 1, "taylor"], dict(os.environ)))
    assert actual["cached"] == {"taylor": 1}


@pytest.fixture(scope="module")
def generic():
    """Return the machine of the most other bits; it stands before all that is made for it."""
    need_machine("generic")
    return "generic"


FOR_PEOPLE = "scripts/replication/words.py"
"""Rounds the numbers of pages, and stores none."""


def test_each_module_that_may_call_lapack_is_played():
    """Ruff lets only these call it: `banned-api` in pyproject.toml."""
    settings = tomllib.loads((PROJECT / "pyproject.toml").read_text())["tool"]["ruff"]["lint"]
    ignored = settings["per-file-ignores"].items()
    modules = {name for name, rules in ignored if "TID251" in rules and name.endswith(".py")}
    assert modules - {FOR_PEOPLE} == some_numbers.PLAYED.keys()


def test_oldest_and_newest_code_of_numpy_openblas_and_c_give_the_same_numbers(numbers_by):
    playable = [name for name in machines.PLAYED if machines.playable(name)]
    if len(playable) < 2:
        skip("there is no other code for this processor", "run it on x86-64 with FMA and glibc")
    pair = [machines.libraries(name) for name in (playable[0], playable[-1])]
    features, kernels, _, elementary = zip(
        *(json.loads(output_of([sys.executable, "-c", CHOSEN], each)) for each in pair),
        strict=True,
    )
    assert features[0] != features[1] and kernels[0] != kernels[1]
    assert elementary[0] != elementary[1]
    old, new = (numbers_by(sys.executable, each) for each in pair)
    assert old == new and new.keys() == set(some_numbers.NAMES)


def test_numbers_that_no_solver_gives_are_the_same_on_another_machine(generic, numbers_by):
    both = dict(os.environ), machines.environment(generic)
    first, second = (numbers_by(sys.executable, environment) for environment in both)
    assert first == second and second.keys() == set(some_numbers.NAMES)


@pytest.fixture
def python_of_another_family():
    return os.environ.get("PENDULA_PYTHON_OF_AARCH64") or skip(
        "there is no Python of another family of processors", "run .ci/elsewhere aarch64"
    )


def test_another_family_of_processors_gives_the_same_bits(python_of_another_family, tmp_path):
    actual = run(python_of_another_family, dict(os.environ), tmp_path, 1)
    assert actual["machine"] == "aarch64" and actual["hashes"] == COMMITTED


def test_another_family_gives_the_same_numbers(python_of_another_family, numbers_by):
    pythons = (sys.executable, python_of_another_family)
    first, second = (numbers_by(python, dict(os.environ)) for python in pythons)
    assert first == second


@pytest.mark.parametrize(("name", "even"), bits.RUNS)
def test_code_for_this_processor_gives_the_committed_bits(name, even):
    assert bits.run(name, even) == HASHES[name]


def test_the_growth_of_tangent_vectors_has_the_committed_bits():
    z, *vectors = (np.round(random_chain(2, even=True, seed=n), 3) for n in (4, 5, 6))
    growth = grow(problem_from(z, (0.7, 1.3, -2.1)), np.array(vectors), 3.0, even=True)
    actual = growth.log_growth.tobytes() + growth.size.tobytes()
    assert hashlib.sha256(actual).hexdigest()[:16] == "669dfa1c71eb6f7b"
