"""Other processors, played on this one: variables tell each library which code to take.

NumPy, OpenBLAS, numba and the C library take the fastest code that they hold for a processor, and
fused or wider operations round in another order.

    python packages/latticode/tests/machines.py generic snakemake --cores 1

runs a command on such a machine; without arguments it prints those that can be played here, each
after the number of its cores.
"""

import os
import platform
import sys
from typing import NamedTuple

from llvmlite import binding

GROUPS = ("X86_V3", "X86_V4", "AVX512_ICL", "AVX512_SPR")
"""The groups of features that NumPy chooses code by."""
UNFUSED = "glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4,-AVX512F,-AVX2_Usable,-FMA_Usable"
"""No fused operations in exp, log, sin and pow of C; names with _Usable are those of old glibc."""


class Machine(NamedTuple):
    """A processor by the names that each library gives to it."""

    numpy: tuple[str, ...]
    openblas: str
    numba: str
    features: str
    cores: int


PLAYED = {
    "core2": Machine((), "Katmai", "core2", "", 1),
    "generic": Machine((), "Nehalem", "generic", "", 1),
    "sandybridge": Machine((), "Sandybridge", "sandybridge", "+avx", 1),
    "avx2": Machine(GROUPS[:1], "Haswell", "haswell", "+avx2,+fma", 2),
    "zen": Machine(GROUPS[:1], "Haswell", "znver3", "+avx2,+fma", 1),
    "avx512": Machine(
        GROUPS[:2], "SkylakeX", "skylake-avx512", "+avx2,+fma,+avx512f,+avx512dq,+avx512vl", 1
    ),
    "icelake": Machine(
        GROUPS[:3],
        "SkylakeX",
        "icelake-server",
        "+avx2,+fma,+avx512f,+avx512dq,+avx512vl,+avx512vbmi,+avx512vpopcntdq",
        2,
    ),
}
"""Processors of the last twenty years, oldest first: three have no fused operations. OpenBLAS has
one of its five kernels for each, and calls the oldest of them Katmai."""


def libraries(name: str) -> dict[str, str]:
    """Return the environment in which NumPy, OpenBLAS and C take the code of a machine of PLAYED.

    The code that numba compiles stays that of this processor.
    """
    machine = PLAYED[name]
    return os.environ | {
        "NPY_DISABLE_CPU_FEATURES": ",".join(set(GROUPS) - set(machine.numpy)),
        "OPENBLAS_CORETYPE": machine.openblas,
        "OPENBLAS_NUM_THREADS": str(machine.cores),
        **({} if machine.numpy else {"GLIBC_TUNABLES": UNFUSED}),
    }


def environment(name: str) -> dict[str, str]:
    """Return the environment of a process on a machine of PLAYED."""
    machine = PLAYED[name]
    compiled_for = {"NUMBA_CPU_NAME": machine.numba, "NUMBA_CPU_FEATURES": machine.features}
    return libraries(name) | compiled_for


def playable(name: str) -> bool:
    """Return whether this machine can play another: fused operations show only where they are."""
    if platform.machine() != "x86_64" or platform.libc_ver()[0] != "glibc":
        return False
    features = binding.get_host_cpu_features()
    return all(
        features.get(word.strip("+")) for word in f"fma,{PLAYED[name].features}".split(",") if word
    )


if __name__ == "__main__":
    if command := sys.argv[2:]:
        os.execvpe(command[0], command, environment(sys.argv[1]))
    print(*(f"{PLAYED[name].cores} {name}" for name in PLAYED if playable(name)), sep="\n")
