"""This project's Taylor method once more, in C++ with vectors of four sites: see taylor.cpp."""

import ctypes
import shutil
import subprocess
import tempfile
from functools import cache, partial
from pathlib import Path

from pendula.simulation.lattice import pack, unpack

from .problem import HALF, Peer, Problem, Solve, check, timed

SOURCE = Path(__file__).with_name("taylor.cpp")
OPTIONS = ("-std=c++17", "-O3", "-march=native", "-shared", "-fPIC")


def why_absent() -> str | None:
    """Return what is missing."""
    return None if shutil.which("g++") else "g++ is not on the PATH"


@cache
def compiled(contract: str):
    """Return the C function `solve`; GCC joins a product and a sum where `contract` is "fast"."""
    with tempfile.TemporaryDirectory() as folder:
        library = Path(folder) / "taylor.so"
        command = ["g++", *OPTIONS, f"-ffp-contract={contract}", str(SOURCE), "-o", str(library)]
        subprocess.run(command, check=True, capture_output=True)
        function = ctypes.CDLL(str(library)).solve  # stays loaded when the folder goes
    number, integer = ctypes.c_double, ctypes.c_long
    function.restype = integer
    function.argtypes = [*[number] * 3, integer, ctypes.c_void_p, *[number] * 3]
    return function


def prepare(problem: Problem, contract: str) -> Solve:
    """Return the solver of half the chain, compiled into a temporary folder."""
    check(problem, even=True)
    function = compiled(contract)
    start = pack(problem.amplitudes, HALF)

    def solve(rtol):
        y = start[:, 1:-1].copy()
        where, sites = y.ctypes.data, y.shape[1]
        arguments = (*problem.constants, sites, where, problem.end_time, rtol, rtol)
        steps, seconds = timed(lambda: function(*arguments))
        if steps < 0:
            raise RuntimeError("the Taylor method in C++ gave up")
        end = start.copy()
        end[:, 1:-1] = y
        return unpack(end, HALF), seconds

    return solve


SEPARATE = Peer("Taylor in C++, no contraction", why_absent, partial(prepare, contract="off"))
FUSED = Peer("Taylor in C++, contracted", why_absent, partial(prepare, contract="fast"))
