"""Other people's integrators on the chain, each optional, in one calling convention."""

from typing import NamedTuple

import numpy as np


class Problem(NamedTuple):
    """What a peer is asked to solve; amplitudes are (component, site)."""

    constants: tuple[float, float, float]
    boundary: str
    amplitudes: np.ndarray
    end_time: float


PEERS: dict = {}
