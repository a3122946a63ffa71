"""The page's solver: ode45 on (4) that keeps the whole state at every output, not moduli alone.

The page then shows any time of a run without integrating again.

Started as a program it writes the WebAssembly of the solver.
"""

import os
import subprocess
import sys

import numpy as np
from latticode.equations.ends import DIRICHLET, MIRROR
from latticode.integrators.methods import METHODS
from latticode.kernels.compiled import kernel
from latticode.kernels.webassembly import WebAssemblyError, webassembly
from latticode.simulation.lattice import aligned
from latticode.simulation.observables import blank_record, observe_fields

from pendula.models.amplitudes import AmplitudeChain, energy_with_scratch, rates

ANY_PROCESSOR = {"NUMBA_CPU_NAME": "generic", "NUMBA_CPU_FEATURES": ""}
"""Variables that have numba compile for the features that all processors of a family share."""


@kernel
def observe_states(chain, y, i, record):
    """Keep the norms, the energy and all amplitudes of the state `y` at output `i`."""
    observe_fields(chain, y, i, record)
    record.conserved[0, i] = energy_with_scratch(chain, y, record.scratch)


ODE45 = METHODS["ode45"]
solve_keeping_states = ODE45.build(rates, observe_states)


@kernel
def run_keeping_states(chain, y, times, controls, work, record, stop):
    return solve_keeping_states(chain, y, times, controls, work, record, stop)


def compile_to_webassembly() -> bytes:
    """Return the WebAssembly of the solver on half a chain; its sizes are arguments of it."""
    y = np.zeros((4, 4))
    chain = AmplitudeChain(1.0, 1.0, 0.0, MIRROR, DIRICHLET)
    record = blank_record(2, 2, 2, 1, quantities=1, parts=2)
    controls, stop = (0.0,) * len(ODE45.controls), np.zeros(1, np.bool_)
    work = aligned((ODE45.work_arrays(y.shape[1] - 2, in_tiles=False), *y.shape))
    return webassembly(run_keeping_states, chain, y, np.zeros(2), controls, work, record, stop)


def compile_for_any_processor() -> bytes:
    """Return the WebAssembly that processors of all makes compile, byte by byte.

    numba orders operations for one processor, which it chooses once in a process: so this starts a
    Python of its own. Raises WebAssemblyError with the reason where that fails.
    """
    variables = os.environ | ANY_PROCESSOR | {"PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
    command = [sys.executable, "-m", __name__]
    finished = subprocess.run(command, env=variables, capture_output=True)
    if finished.returncode:
        raise WebAssemblyError(finished.stderr.decode(errors="replace").strip())
    return finished.stdout


if __name__ == "__main__":
    sys.stdout.buffer.write(compile_to_webassembly())
