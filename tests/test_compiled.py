"""The cache of kernels: what one process keeps, another must load as it was."""

import json
import os
import subprocess
import sys

from pendula.compiled import FunctionIdentity
from pendula.sources import SCRIPTS

LONG = "\n".join(f"        x += inner(x, {i}.0) / (1.0 + x * x)" for i in range(30))
MADE = f"""
from pendula.compiled import kernel, uncached

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


def test_kernels_that_two_processes_kept_stay_apart_in_a_third(tmp_path):
    """Each process numbers its functions alike, so `long` had the same name in both."""
    (tmp_path / "made.py").write_text(MADE)
    settings = {"PYTHONPATH": f"{SCRIPTS}{os.pathsep}{tmp_path}", "PENDULA_CACHE": str(tmp_path)}
    command = [sys.executable, "-c", FORKS, "of_sums", "of_products", "of_sums of_products"]
    done = subprocess.run(command, env=os.environ | settings, capture_output=True, text=True)
    first, second, third = map(json.loads, done.stdout.splitlines())
    assert first != second and third == first + second


def test_the_forks_of_a_process_name_their_functions_apart():
    reads, writes = os.pipe()
    for _ in range(2):
        if not (child := os.fork()):
            os.write(writes, b"%d\n" % next(FunctionIdentity._unique_ids))
            os._exit(0)
        os.waitpid(child, 0)
    os.close(writes)
    with open(reads) as said:
        first, second = said.read().split()
    assert first != second
