"""What one process keeps, another must load as it was: by our cache, and by that of numba."""

import json
import os
import shutil
import subprocess
import sys

import pytest
from another_numba import another_numba
from latticode.kernels.sources import ROOTS

LONG = "\n".join(f"        x += inner(x, {i}.0) / (1.0 + x * x)" for i in range(30))
SOURCE = f"""
from latticode.kernels.compiled import kernel, uncached

def build(inner):
    @uncached
    def long(x):  # so long that it is called and not inlined
{LONG}
        return x
    return long

@uncached
def sums(x, y):
    return x + y

@uncached
def products(x, y):
    return x * y

long_sums, long_products = build(sums), build(products)

@kernel
def of_sums(x):
    return long_sums(x)

@kernel
def of_products(x):
    return long_products(x)
"""


FORKS = """
import os, sys
import numba

numba.njit(lambda x: x)(0.5)  # what every process does first; all number their functions from here
for names in sys.argv[1:]:
    if not os.fork():
        import made
        print([getattr(made, name)(0.5) for name in names.split()], flush=True)
        os._exit(0)
    os.wait()
"""


def test_a_run_without_compilation_is_refused_by_name():
    disabled = {**os.environ, "NUMBA_DISABLE_JIT": "1"}
    command = [sys.executable, "-c", "from latticode.integrators import taylor"]
    message = subprocess.run(command, env=disabled, capture_output=True, text=True).stderr
    assert "RuntimeError: NUMBA_DISABLE_JIT is set" in message


@pytest.fixture(params=["ours", "numba alone"])
def python(request, tmp_path):
    """Return a function: what a new Python says that finds a copy of the library, and each way."""
    shutil.copytree(ROOTS["latticode"] / "latticode", tmp_path / "latticode")
    alone = request.param == "numba alone"
    environment = another_numba(tmp_path) if alone else dict(os.environ)
    environment |= {"PYTHONPATH": str(tmp_path), "LATTICODE_CACHE": str(tmp_path)}

    def run(*arguments):
        command = [sys.executable, *arguments]
        done = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
        assert ("take several times as long to compile" in done.stderr) == alone
        return done.stdout

    return run


def test_kernels_that_two_processes_kept_stay_apart_in_a_third(python, tmp_path):
    """Each process numbers its functions alike, so `long` had the same name in both."""
    (tmp_path / "made.py").write_text(SOURCE)
    message = python("-c", FORKS, "of_sums", "of_products", "of_sums of_products")
    first, second, third = map(json.loads, message.splitlines())
    assert first != second and third == first + second


def test_an_edit_of_a_function_in_another_file_is_seen(python, tmp_path):
    inner, outer = (tmp_path / "latticode/kernels" / name for name in ("inner.py", "outer.py"))
    kernel = "from .compiled import kernel\n@kernel\ndef {}(x):\n    return {}\n"
    outer.write_text("from .inner import double\n" + kernel.format("twice", "double(double(x))"))
    computed = []
    for factor in (2, 300):  # of another length, see test_kernel_cache
        inner.write_text(kernel.format("double", f"{factor} * x"))
        computed.append(python("-c", "from latticode.kernels import outer; print(outer.twice(1))"))
    assert computed == ["4\n", "90000\n"]
