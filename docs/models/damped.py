"""The discrete nonlinear Schroedinger equation with damping."""

from latticode import abs2, lap

fields = "u"
parameters = {"epsilon": 1.0, "gamma": 0.1}


def i_dt(p, u):
    return p.epsilon * lap(u) + abs2(u) * u - 1j * p.gamma * u
