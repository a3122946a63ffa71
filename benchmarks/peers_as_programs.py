"""Integrators that are programs of their own: GNU Octave's ode45, and a Taylor method in C++.

Octave is run as a program that reports its own time. The Taylor method is this project's once more,
by hand (taylor.cpp): it shows how near the compiled Python comes to it. It goes
through four sites at a time, and where the processor has AVX-512 also through eight.
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
from pendula.problem import Problem

from .peer import HALF, Peer, Solve, begin, final_of, with_ghosts
from .timing import timed


def needs(program: str) -> Callable[[], str | None]:
    """Return a function that says what is missing where a program is not on the PATH."""
    return lambda: None if shutil.which(program) else f"{program} is not on the PATH"


# GNU Octave

OCTAVE = """1;  % a script, not a function file
function slope = rates(tau, u, n, epsilon, gamma_, omega)
  z = reshape(u, n, 2);
  padded = [0, 0; z; 0, 0];
  coupling = epsilon * (padded(3:end, :) - 2 * z + padded(1:end-2, :));
  drive = gamma_ * (conj(fliplr(z)) - conj(z));
  slope = -1i * (coupling + omega * z + drive + 0.5 * abs(z) .^ 2 .* z)(:);
end
u = {start};
f = @(tau, u) rates(tau, u, {n}, {epsilon!r}, {gamma!r}, {omega!r});
options = odeset("RelTol", {rtol!r}, "AbsTol", {atol!r}, "Refine", 1);
[tau, y] = ode45(f, [0, {short!r}], u, options);
tic;
[tau, y] = ode45(f, [0, {end_time!r}], u, options);
seconds = toc;
printf("%.17g\\n", seconds, [real(y(end, :)); imag(y(end, :))]);
"""


def prepare_octave(problem: Problem) -> Solve:
    """Return ode45 with the absolute tolerance rtol / 100, as in the paper's pair."""
    _, _, end_time = begin(problem)
    z, constants = problem.amplitudes, problem.constants
    parts = ", ".join(f"{complex(u).real!r} + {complex(u).imag!r}i" for u in z.ravel())

    def solve(rtol):
        text = OCTAVE.format(
            start=f"complex([{parts}].')",
            n=z.shape[1],
            epsilon=float(constants.epsilon),
            gamma=float(constants.gamma),
            omega=float(constants.omega),
            rtol=float(rtol),
            atol=0.01 * rtol,
            short=0.01 * end_time,
            end_time=end_time,
        )
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "integrate.m").write_text(text)
            command = ["octave-cli", "--no-init-file", "--quiet", "integrate.m"]
            done = subprocess.run(command, cwd=folder, capture_output=True, text=True)
        if done.returncode:
            raise RuntimeError(f"Octave failed: {done.stderr.strip()}")
        seconds, *values = map(float, done.stdout.split())
        return np.array(values).view(complex).reshape(z.shape), seconds

    return solve


# The Taylor method in C++

SOURCE = Path(__file__).with_name("taylor.cpp")
OPTIONS = ("-std=c++17", "-O3", "-shared", "-fPIC")


def target() -> str:
    """Return the option that lets GCC compile for the processor that numba compiles for."""
    name = os.environ.get("NUMBA_CPU_NAME", "native")
    return f"-march={'x86-64' if name == 'generic' else name}"


@cache
def lacks_avx512() -> str | None:
    """Return in words why vectors of eight numbers are not compared."""
    if why := needs("g++")():
        return why
    asked = ["g++", target(), "-dM", "-E", "-x", "c++", os.devnull]
    done = subprocess.run(asked, capture_output=True, text=True)
    return None if "__AVX512F__" in done.stdout else "code for this processor has no AVX-512"


@cache
def compiled(contract: str, lanes: int):
    """Return the C function `solve` with vectors of `lanes` numbers.

    GCC joins a product and a sum where `contract` is "fast".
    """
    with tempfile.TemporaryDirectory() as folder:
        library = Path(folder) / "taylor.so"
        chosen = [target(), f"-DLANES={lanes}", f"-ffp-contract={contract}"]
        command = ["g++", *OPTIONS, *chosen, str(SOURCE), "-o", str(library)]
        subprocess.run(command, check=True, capture_output=True)
        function = ctypes.CDLL(str(library)).solve  # stays loaded when the folder goes
    number, integer = ctypes.c_double, ctypes.c_long
    function.restype = integer
    function.argtypes = [*[number] * 3, integer, ctypes.c_void_p, *[number] * 3]
    return function


def prepare_taylor(problem: Problem, contract: str, lanes: int = 4) -> Solve:
    """Return the solver of half the chain, compiled into a temporary folder."""
    _, start, end = begin(problem, HALF)
    function, numbers = compiled(contract, lanes), tuple(problem.constants)

    def solve(rtol):
        y = start[:, 1:-1].copy()
        where, sites = y.ctypes.data, y.shape[1]
        steps, seconds = timed(lambda: function(*numbers, sites, where, end, rtol, rtol))
        if steps < 0:
            raise RuntimeError("the Taylor method in C++ gave up")
        return final_of(problem, with_ghosts(y), HALF), seconds

    return solve


PEERS = {
    "octave_ode45": Peer("Octave ode45", needs("octave-cli"), prepare_octave),
    "cpp_taylor": Peer(
        "Taylor in C++, no contraction", needs("g++"), partial(prepare_taylor, contract="off")
    ),
    "cpp_taylor_contracted": Peer(
        "Taylor in C++, contracted", needs("g++"), partial(prepare_taylor, contract="fast")
    ),
    "cpp_taylor_eight": Peer(
        "Taylor in C++, no contraction, vectors of eight",
        lacks_avx512,
        partial(prepare_taylor, contract="off", lanes=8),
    ),
}
