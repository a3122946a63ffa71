"""Compiled functions and their disk cache.

`compiled` has the decorators, `cache` the files on disk, and `sources` the hashes of code in their
names. `one_pass` translates generated functions. `simd` defines vectors of eight doubles. Only
`inside_numba` uses private parts of numba.
"""

DISABLED = "NUMBA_DISABLE_JIT is set, but kernels cannot run uncompiled: unset it"
"""The error message if NUMBA_DISABLE_JIT disables compilation."""
