"""Machines to be played on one: which code NumPy, OpenBLAS, numba and the C library choose here.

Each of them looks at the processor and takes the fastest code that it holds for it, and fused or
wider operations round in another order. Environment variables tell each to take older code. So one
machine with a new x86-64 processor gets the bits of most others, without owning them.

    python tests/machines.py generic snakemake --cores 1

runs a command on such a machine, and without a command prints what a program finds there;
--playable in place of a name prints the machines that this one can play, with their cores.
"""

import ctypes
import hashlib
import json
import math
import os
import platform
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import numba
import numpy as np
import scipy
from llvmlite import binding


@dataclass(frozen=True)
class Machine:
    """A processor by the names that each library gives to what it can do."""

    numpy: frozenset[str]
    """The groups of features that NumPy may choose code by; all others that it knows are off."""
    openblas: str
    numba: tuple[str, str]
    """The processor and the features that numba compiles for."""
    needs: tuple[str, ...]
    """What the processor of this machine must have, by LLVM's names."""
    fused: bool
    """Whether the C library may use fused operations, as it does in exp, log, sin and pow."""
    cores: int


PLAYED = {
    "generic": Machine(frozenset(), "Nehalem", ("generic", ""), (), False, 1),
    "avx2": Machine(
        frozenset({"X86_V3"}), "Haswell", ("haswell", "+avx2,+fma"), ("avx2", "fma"), True, 2
    ),
    "avx512": Machine(
        frozenset({"X86_V3", "X86_V4"}),
        "SkylakeX",
        ("skylake-avx512", "+avx2,+fma,+avx512f,+avx512dq,+avx512vl"),
        ("avx2", "fma", "avx512f", "avx512dq", "avx512vl", "avx512bw", "avx512cd"),
        True,
        1,
    ),
}
"""Two to four processors of the last fifteen years; numba's name for the first is `generic`."""

THIS_ONE = "this one"
VARIABLES = (
    *("NPY_DISABLE_CPU_FEATURES", "NPY_ENABLE_CPU_FEATURES", "OPENBLAS_CORETYPE"),
    *("NUMBA_CPU_NAME", "NUMBA_CPU_FEATURES", "GLIBC_TUNABLES"),
    *("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS"),
)
UNFUSED = "glibc.cpu.hwcaps=" + ",".join(
    # the names with _Usable are those of glibc 2.32 and older
    ["-AVX2", "-FMA", "-FMA4", "-AVX512F", "-AVX2_Usable", "-FMA_Usable"]
)


def environment(name: str) -> dict[str, str]:
    """Return the environment of a process on a machine of PLAYED, or on THIS_ONE as it is."""
    here = {key: value for key, value in os.environ.items() if key not in VARIABLES}
    return here if name == THIS_ONE else here | settings(PLAYED[name])


def settings(machine: Machine) -> dict[str, str]:
    """Return the variables that play the machine; a group that NumPy lacks raises ValueError."""
    processor, features = machine.numba
    threads = str(machine.cores)
    chosen = {
        "NPY_DISABLE_CPU_FEATURES": ",".join(_off(machine.numpy)),
        "OPENBLAS_CORETYPE": machine.openblas,
        "NUMBA_CPU_NAME": processor,
        "NUMBA_CPU_FEATURES": features,
        "OPENBLAS_NUM_THREADS": threads,
        "OMP_NUM_THREADS": threads,
    }
    return chosen if machine.fused else chosen | {"GLIBC_TUNABLES": UNFUSED}


def _off(kept: frozenset[str]) -> list[str]:
    """Return the groups that NumPy must not use, of all that it chooses code by."""
    used, others = _groups_of_numpy()
    known = used + others
    if unknown := sorted(kept - set(known)):
        raise ValueError(
            f"NumPy {np.__version__} knows no features {', '.join(unknown)}, but {', '.join(known)}"
            ": name those of each machine in tests/machines.py"
        )
    return [group for group in known if group not in kept]


ELSEWHERE = "run it on an x86-64 processor that has AVX-512 and FMA, with glibc"
"""Where every machine of PLAYED can be played."""


def why_not(name: str) -> str:
    """Return in words why this machine cannot play another; nothing where it can."""
    if platform.machine() != "x86_64" or platform.libc_ver()[0] != "glibc":
        return "machines are played on an x86-64 processor with glibc"
    here = binding.get_host_cpu_features()
    # fused operations can only be seen to be off where the processor has them
    lacking = [feature for feature in (*PLAYED[name].needs, "fma") if not here.get(feature)]
    if lacking:
        return f"this processor has no {', '.join(lacking)}"
    return ""


def found() -> dict:
    """Return what the libraries of this process chose, and a hash of the C library's bits."""
    name = numba.config.CPU_NAME or binding.get_host_cpu_name()
    points = [k / 97 for k in range(1, 4001)]
    bits = [f(x) for f in (math.exp, math.sin, math.log) for x in points]
    return {
        "numpy": _groups_of_numpy()[0],
        "openblas": sorted({_core_of_openblas(package) for package in (np, scipy)}),
        "numba": name,
        "libm": hashlib.sha256(np.array(bits).tobytes()).hexdigest()[:16],
    }


def _groups_of_numpy() -> tuple[list[str], list[str]]:
    """Return the groups of features that NumPy chooses code by, and those that it could."""
    groups = np.show_config(mode="dicts")["SIMD Extensions"]
    return groups.get("found", []), groups.get("not found", [])


def _core_of_openblas(package) -> str:
    """Return the processor for which the OpenBLAS in a package's wheel chose its code."""
    folder = Path(package.__file__).parents[1] / f"{package.__name__}.libs"
    library = ctypes.CDLL(next(folder.glob("*openblas*")))
    plain = "scipy_openblas_get_corename"
    ask = getattr(library, f"{plain}64_" if hasattr(library, f"{plain}64_") else plain)
    ask.restype = ctypes.c_char_p
    return ask().decode()


def found_on(name: str) -> dict:
    """Return what a process on that machine finds."""
    command = [sys.executable, __file__, name]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def playable() -> list[str]:
    """Return the machines that this one can play, itself first; say of the others why not."""
    for name in PLAYED:
        if why := why_not(name):
            print(f"{name} is left out: {why}", file=sys.stderr)
    return [THIS_ONE, *(name for name in PLAYED if not why_not(name))]


def main(name: str, *command: str) -> None:
    if name == "--playable":
        for each in playable():
            print(PLAYED[each].cores if each in PLAYED else "all", each)
    elif name == "--found":
        print(json.dumps(found()))
    else:
        words = command or (sys.executable, __file__, "--found")
        os.execvpe(words[0], words, environment(name))


if __name__ == "__main__":
    main(*sys.argv[1:])
