"""M. Syafwan, H. Susanto and S. M. Cox, Phys. Rev. E 81 (2010) 026207."""

from latticode import abs2, conj, lap

fields = "u"
parameters = {"epsilon": 0.1, "gamma": 0.5, "detuning": 1.0}


def i_dt(p, u):
    return -p.epsilon * lap(u) + p.detuning * u + p.gamma * conj(u) - abs2(u) * u
