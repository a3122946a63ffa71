"""The paper's equations (4) where each pair of pendula has a frequency of its own."""

from numpy.random import default_rng
from pendula.models import equations

fields = "A", "B"
parameters = {
    "epsilon": 1.0,
    "gamma": 1.0,
    "omega": -4.0,
    "disorder": lambda n: default_rng(1).uniform(-0.5, 0.5, n.size),
}


def i_dt(p, a, b):
    in_a, in_b = equations.i_dt(p, a, b)
    return in_a + p.disorder * a, in_b + p.disorder * b
