"""A chain with a random potential and a coupling that falls with the cube of the distance."""

from latticode import abs2, shift
from numpy.random import default_rng

fields = "u"
parameters = {"coupling": 1.0, "disorder": lambda n: default_rng(1).uniform(-1, 1, n.size)}


def i_dt(p, u):
    far = sum((shift(u, m) + shift(u, -m) - 2 * u) / m**3 for m in range(1, 6))
    return p.coupling * far + p.disorder * u + abs2(u) * u


def conserved(p, u):
    return {"P": abs2(u)}
