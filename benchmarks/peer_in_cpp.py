"""A Taylor method in C++: this project's method written by hand (taylor.cpp).

It shows how fast compiled Python is in comparison with C++. It computes four sites at a time, or
eight if the processor has AVX-512.
"""

import ctypes
import os
import shutil
import subprocess
import tempfile
from collections.abc import Callable
from functools import cache, partial
from pathlib import Path

import numpy as np
from pendula.problem import PaperProblem

from .peer import HALF, Peer, Solve, begin, final_of, with_ghosts
from .timing import timed


def lacks_compiler() -> str | None:
    """Return why C++ cannot be compiled on this machine, or None if it can."""
    return None if shutil.which("g++") else "g++ is not on the PATH"


SOURCE = Path(__file__).with_name("taylor.cpp")
OPTIONS = ("-std=c++17", "-O3", "-shared", "-fPIC")


def target() -> str:
    """Return the option by which GCC compiles for the same processor as numba."""
    name = os.environ.get("NUMBA_CPU_NAME", "native")
    return f"-march={'x86-64' if name == 'generic' else name}"


@cache
def lacks_avx512() -> str | None:
    """Return why vectors of eight numbers cannot be used on this machine, or None if they can."""
    if why := lacks_compiler():
        return why
    command = ["g++", target(), "-dM", "-E", "-x", "c++", os.devnull]
    done = subprocess.run(command, capture_output=True, text=True)
    return None if "__AVX512F__" in done.stdout else "code for this processor has no AVX-512"


@cache
def compiled(contract: str, lanes: int, rest: bool) -> Callable[..., int]:
    """Return the C function `solve` with vectors of `lanes` numbers.

    If `contract` is "fast", GCC fuses products and sums. With `rest`, tiny numbers count as zero,
    as in this project's solvers.
    """
    with tempfile.TemporaryDirectory() as folder:
        library = Path(folder) / "taylor.so"
        chosen = [target(), f"-DLANES={lanes}", f"-ffp-contract={contract}", *["-DREST"] * rest]
        command = ["g++", *OPTIONS, *chosen, str(SOURCE), "-o", str(library)]
        subprocess.run(command, check=True, capture_output=True)
        function = ctypes.CDLL(str(library)).solve  # stays loaded after the folder is deleted
    number, integer = ctypes.c_double, ctypes.c_long
    function.restype = integer
    function.argtypes = [*[number] * 3, integer, ctypes.c_void_p, *[number] * 3]
    return function


def prepare_taylor(
    problem: PaperProblem, contract: str, lanes: int = 4, rest: bool = False
) -> Solve:
    """Return the solver of half of the chain, compiled with these options of `compiled`."""
    _, start, end = begin(problem, HALF)
    function, numbers = compiled(contract, lanes, rest), tuple(problem.constants)

    def solve(rtol: float) -> tuple[np.ndarray, float]:
        y = start[:, 1:-1].copy()
        where, sites = y.ctypes.data, y.shape[1]
        steps, seconds = timed(lambda: function(*numbers, sites, where, end, rtol, rtol))
        if steps < 0:
            raise RuntimeError("the Taylor method in C++ failed: its step became too small")
        return final_of(problem, with_ghosts(y), HALF), seconds

    return solve


PEERS = {
    "cpp_taylor": Peer(
        "Taylor in C++, no contraction", lacks_compiler, partial(prepare_taylor, contract="off")
    ),
    "cpp_taylor_contracted": Peer(
        "Taylor in C++, contracted", lacks_compiler, partial(prepare_taylor, contract="fast")
    ),
    "cpp_taylor_eight": Peer(
        "Taylor in C++, no contraction, vectors of eight",
        lacks_avx512,
        partial(prepare_taylor, contract="off", lanes=8),
    ),
    "cpp_taylor_rest": Peer(
        "Taylor in C++, no contraction, tiny numbers as rest",
        lacks_compiler,
        partial(prepare_taylor, contract="off", rest=True),
    ),
    "cpp_taylor_eight_rest": Peer(
        "Taylor in C++, no contraction, vectors of eight, tiny numbers as rest",
        lacks_avx512,
        partial(prepare_taylor, contract="off", lanes=8, rest=True),
    ),
}
