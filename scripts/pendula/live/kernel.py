"""The page's solver: ode45 on (4), which stores the full state at every output, not only moduli.

The page can then show any time of a run without integrating again. As a program, this module writes
the WebAssembly of the solver.
"""

import os
import subprocess
import sys

import numpy as np
from latticode.equations.ends import DIRICHLET, MIRROR
from latticode.integrators import Outcome
from latticode.integrators.methods import METHODS
from latticode.kernels.compiled import kernel
from latticode.kernels.webassembly import WebAssemblyError, webassembly
from latticode.simulation.lattice import aligned
from latticode.simulation.observables import ObservableRecord, blank_record, observe_fields

from pendula.models.amplitudes import AmplitudeChain, energy_with_scratch, rates

ANY_PROCESSOR = {"NUMBA_CPU_NAME": "generic", "NUMBA_CPU_FEATURES": ""}
"""Environment variables with which numba compiles for all processors of a family."""


@kernel
def observe_states(chain: AmplitudeChain, y: np.ndarray, i: int, record: ObservableRecord) -> None:
    """Store the norms, the energy and all amplitudes of the state `y` as output `i`."""
    observe_fields(chain, y, i, record)
    record.conserved[0, i] = energy_with_scratch(chain, y, record.scratch)


ODE45 = METHODS["ode45"]
solve_keeping_states = ODE45.build(rates, observe_states)


@kernel
def run_keeping_states(
    chain: AmplitudeChain,
    y: np.ndarray,
    times: np.ndarray,
    controls: tuple[float, ...],
    work: np.ndarray,
    record: ObservableRecord,
    stop: np.ndarray,
) -> Outcome:
    return solve_keeping_states(chain, y, times, controls, work, record, stop)


def compile_to_webassembly() -> bytes:
    """Return the WebAssembly of the solver on half a chain, which takes its sizes as arguments."""
    y = np.zeros((4, 4))
    chain = AmplitudeChain(1.0, 1.0, 0.0, MIRROR, DIRICHLET)
    record = blank_record(2, 2, 2, 1, quantities=1, parts=2)
    controls, stop = (0.0,) * len(ODE45.controls), np.zeros(1, np.bool_)
    work = aligned((ODE45.work_arrays(y.shape[1] - 2, in_tiles=False), *y.shape))
    return webassembly(run_keeping_states, chain, y, np.zeros(2), controls, work, record, stop)


def compile_for_any_processor() -> bytes:
    """Return the WebAssembly of the solver, with the same bytes on every processor.

    numba orders operations for one processor, chosen once per process. This function therefore
    starts another Python process. Raises WebAssemblyError with the reason if that process fails.
    """
    variables = os.environ | ANY_PROCESSOR | {"PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
    command = [sys.executable, "-m", __name__]
    finished = subprocess.run(command, env=variables, capture_output=True)
    if finished.returncode:
        raise WebAssemblyError(finished.stderr.decode(errors="replace").strip())
    return finished.stdout


if __name__ == "__main__":
    sys.stdout.buffer.write(compile_to_webassembly())
