"""The kernel for a batch of runs of the equations (4), generated from the traced model.

See latticode.generation.batches; surveys of many short runs import this module.
"""

from typing import Any

import numpy as np
from latticode.generation import batches
from latticode.generation.modules import load_series
from latticode.kernels.compiled import inlined_by_llvm, kernel
from latticode.kernels.simd import LANES, load
from latticode.simulation.observables import ObservableRecord, observe_moduli

from .amplitudes import AmplitudeChain
from .equations import AMPLITUDE_MODEL

_series = load_series(AMPLITUDE_MODEL, in_batch=True)
continue_in_waves, WORK = _series.continue_in_waves, _series.WORK


@inlined_by_llvm
def with_constants(chain: AmplitudeChain, constants: np.ndarray) -> Any:
    """Return the chain with vectors of the constants of all runs, (constant * run,)."""
    epsilon, gamma = load(constants, 0), load(constants, LANES)
    return AmplitudeChain(epsilon, gamma, load(constants, 2 * LANES), chain.left, chain.right)


solve = batches.build(continue_in_waves, with_constants, observe_moduli)


@kernel
def run_batch(
    system: AmplitudeChain,
    batch: batches.Batch,
    times: np.ndarray,
    controls: tuple[float, float],
    memory: np.ndarray,
    record: ObservableRecord,
    stop: np.ndarray,
) -> int:
    """Run a batch; see `batches.build`."""
    return solve(system, batch, times, controls, memory, record, stop)
