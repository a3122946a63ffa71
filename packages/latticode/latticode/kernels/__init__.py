"""Compiled functions and their disk cache.

`compiled` has the decorators, `cache` the files on disk, and `sources` the hashes of code that name
them. `simd` defines vectors of eight doubles. Only `inside_numba` uses private parts of numba.
"""

DISABLED = "NUMBA_DISABLE_JIT is set, and kernels cannot run uncompiled: unset it"
"""The message where NUMBA_DISABLE_JIT switches compilation off."""
