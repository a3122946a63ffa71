"""Compiled functions: how they are made and kept.

`compiled` makes them, `cache` keeps them on disk, and `sources` names them by their text. `simd`
has vectors of eight doubles; `inside_numba` is all that uses private parts of numba.
"""

DISABLED = "NUMBA_DISABLE_JIT is set, and kernels cannot run uncompiled: unset it"
"""The message where NUMBA_DISABLE_JIT switches compilation off."""
