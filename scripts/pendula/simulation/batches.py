"""Many runs of short chains in one compiled call, a run to each lane of the processor's vectors."""

from typing import NamedTuple

import numpy as np

from pendula.compiled import kernel
from pendula.integrators import taylor_batch
from pendula.integrators.seats import ENDED
from pendula.integrators.taylor_lanes import make_workspace
from pendula.models.amplitudes import ENDS
from pendula.models.batch_series import Chains, chain_of, continue_batch, seat
from pendula.vectors import LANES

from .lattice import WHOLE, pack, require_centre
from .observables import blank_record, observe

solve_batch = taylor_batch.build(chain_of, seat, continue_batch, observe)


@kernel
def run_batch(chains, states, times, controls, work, record, ended):
    solve_batch(chains, states, times, controls, work, record, ended)


class Batch(NamedTuple):
    """What became of the runs."""

    linf: np.ndarray  # (component, run, time), as l2
    l2: np.ndarray
    energy: np.ndarray  # (run, time)
    final: np.ndarray  # (run, component, site): complex amplitudes at the last output reached
    ended: np.ndarray  # (run,), structured as ENDED


def integrate_batch(constants, boundary: str, amplitudes, times, rtol: float, atol: float) -> Batch:
    """Integrate amplitudes (run, 2, N) by the Taylor method, as `integrate` would one by one.

    `constants` is (run, 3): epsilon, gamma, Omega of each; the ends and the output times are
    common. The bits are those of `integrate` on the whole chain. A run that cannot go on leaves the
    others alone, its outputs from there on are not set; none is refused before it starts.
    """
    amplitudes = np.asarray(amplitudes, complex)
    runs, _, sites = amplitudes.shape
    require_centre(sites)
    times, states = np.asarray(times, float), np.array([pack(pair, WHOLE) for pair in amplitudes])
    constants = np.ascontiguousarray(constants, float)
    chains = Chains(constants, ENDS[boundary], np.zeros(3 * LANES))
    record = blank_record(2, sites, runs * len(times), 0)
    work, ended = make_workspace(*states.shape[1:]), np.zeros(runs, ENDED)
    run_batch(chains, states, times, (rtol, atol), work, record, ended)
    return Batch(
        record.linf.reshape(2, runs, -1),
        record.l2.reshape(2, runs, -1),
        record.energy.reshape(runs, -1),
        states[:, 0::2, 1:-1] + 1j * states[:, 1::2, 1:-1],
        ended,
    )
