"""The page's solver: ode45 on (4) that keeps the whole state at every output, not moduli alone.

The page then shows any time of a run without integrating again.
"""

import numpy as np
from latticode.equations.ends import DIRICHLET, MIRROR
from latticode.integrators import ode45
from latticode.kernels.compiled import kernel
from latticode.kernels.webassembly import webassembly
from latticode.simulation.observables import blank_record, observe_fields

from pendula.models.amplitudes import Chain, energy_with_scratch, rates
from pendula.models.solvers import SOLVERS

ODE45 = SOLVERS["ode45"]


@kernel
def observe_states(chain, y, i, record):
    """Keep the norms, the energy and all amplitudes of the state `y` at output `i`."""
    observe_fields(chain, y, i, record)
    record.energy[i] = energy_with_scratch(chain, y, record.scratch)


solve_keeping_states = ode45.build(rates, observe_states)


@kernel
def run_keeping_states(chain, y, times, controls, work, record, stop):
    return solve_keeping_states(chain, y, times, controls, work, record, stop)


def compile_to_webassembly() -> bytes:
    """Return the WebAssembly of the solver on half a chain; its sizes are arguments of it."""
    y = np.zeros((4, 4))
    chain = Chain(1.0, 1.0, 0.0, MIRROR, DIRICHLET)
    record = blank_record(2, 2, 2, 1)
    record = record._replace(kept=np.empty((2, *record.kept.shape)))
    controls, stop = (0.0,) * len(ODE45.controls), np.zeros(1, np.bool_)
    work = ODE45.room_for(None, y)
    return webassembly(run_keeping_states, chain, y, np.zeros(2), controls, work, record, stop)
