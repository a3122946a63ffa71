"""Other people's integrators given this chain, to measure ours against.

None of their libraries is needed by the project: each is imported when a problem is prepared, and
`why_absent` says in words what a peer lacks.
"""

from . import heyoka_peers, numbalsoda_peers, octave, scipy_peers, sundials, taylor_cpp
from .problem import Peer, Problem

__all__ = ["PEERS", "Peer", "Problem"]

PEERS: dict[str, Peer] = {
    "scipy_rk45_numpy": scipy_peers.RK45_NUMPY,
    "scipy_dop853_numpy": scipy_peers.DOP853_NUMPY,
    "scipy_rk45": scipy_peers.RK45,
    "scipy_dop853": scipy_peers.DOP853,
    "scipy_lsoda": scipy_peers.LSODA,
    "scipy_radau": scipy_peers.RADAU,
    "heyoka_full": heyoka_peers.FULL_CHAIN,
    "heyoka_half": heyoka_peers.HALF_CHAIN,
    "cvode_adams": sundials.CVODE_ADAMS,
    "octave_ode45": octave.ODE45,
    "numbalsoda_dop853": numbalsoda_peers.WHOLE_CHAIN,
    "numbalsoda_dop853_half": numbalsoda_peers.HALF_CHAIN,
    "cpp_taylor": taylor_cpp.SEPARATE,
    "cpp_taylor_contracted": taylor_cpp.FUSED,
}
