"""What the machine could do at best, and what a step of DOP853 asks of it.

Two limits bound the sites that a core can carry forward in a second: its arithmetic (measured on
numbers that stay in registers, without fused operations, since the kernels have none) and its
memory (measured by the triad a = b + s c on arrays that fit no cache). Operations and transfers of
a step are counted from the formulae; what stays in a cache is not transferred, so the second
limit is for chains that are longer than the caches.
"""

import os

import numpy as np
from pendula.compiled import kernel
from pendula.datasets.netcdf import Variable
from pendula.integrators import dop853
from pendula.integrators.dop853_coefficients import E3, E5
from pendula.sources import describe_machine

from .timing import clocked, repeat

DEGREE = 12
"""Operations in a row on a number in a register."""
LONG = 4_000_000
"""Numbers in an array that fits no cache."""
BYTES = 8
PARTS = 4
"""Real numbers of a site: the real and imaginary parts of A and of B."""
RATES = 13.5
"""Additions and multiplications for a real number of the right-hand side (4): 9 in the linear
terms, 3 in the cubic one, and 3 for a modulus that two of them share."""


@kernel
def churn(x, scale, shift):
    """Replace each x by scale x + shift, DEGREE times, in four independent strips."""
    strip = x.size // 4
    a, b, c, d = x[:strip], x[strip : 2 * strip], x[2 * strip : 3 * strip], x[3 * strip :]
    for i in range(strip):
        u, v, w, z = a[i], b[i], c[i], d[i]
        for _ in range(DEGREE):  # a constant: unrolled, so that the loop over i is vectorised
            u, v, w, z = scale * u + shift, scale * v + shift, scale * w + shift, scale * z + shift
        a[i], b[i], c[i], d[i] = u, v, w, z


@kernel
def triad(a, b, c, s):
    for i in range(a.size):
        a[i] = b[i] + s * c[i]


def describe() -> dict[str, str]:
    """Return the machine, and the processor that the code is made for where it is another one."""
    played = os.environ.get("NUMBA_CPU_NAME")
    return describe_machine() | ({"code_for": played} if played else {})


def measure() -> dict[str, Variable]:
    """Return the machine's limits and the needs of DOP853 as variables without dimensions."""
    operations, traffic = count_dop853()
    rows = {
        "arithmetic": (arithmetic(), "additions and multiplications a second", "s-1"),
        "bandwidth": (bandwidth(), "memory traffic of a triad", "byte s-1"),
        "operations": (operations, "operations of dop853 a site and step", "1"),
        "traffic": (traffic, "array traffic of dop853 a site and step", "byte"),
    }
    return {name: Variable((), *row) for name, row in rows.items()}


def arithmetic() -> float:
    """Return additions and multiplications a second of one core."""
    x = np.linspace(0.0, 1.0, 4096)
    return 2 * DEGREE * x.size / repeat(clocked(lambda: churn(x, 0.5, 0.25)), 50).least


def bandwidth() -> float:
    """Return bytes a second of one core: two arrays read, one written."""
    a, b, c = np.zeros(LONG), np.ones(LONG), np.ones(LONG)
    return 3 * BYTES * LONG / repeat(clocked(lambda: triad(a, b, c, 2.0)), 7).least


def count_dop853() -> tuple[float, float]:
    """Return the operations and the bytes of one step of DOP853 for one site."""
    matrix = np.zeros((16, 16))
    for stage in range(2, 14):
        dop853.combine(stage, np.zeros(16), 1.0, np.eye(16), matrix[stage - 1])
    weights = np.count_nonzero(matrix[:13])
    estimates = len(E3) + len(E5)
    operations = 12 * RATES + 2 * (weights + estimates) + 12
    # a tile reads the state and its slope, and writes both anew; the rest stays in the cache
    return PARTS * operations, PARTS * BYTES * 4
