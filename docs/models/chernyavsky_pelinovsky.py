"""A. Chernyavsky and D. E. Pelinovsky, arXiv 1605.06455."""

from latticode import abs2, conj, lap

fields = "u", "v"
parameters = {"epsilon": 0.1, "gamma": 0.5, "omega": 3.0}


def i_dt(p, u, v):
    cubic_u = 2 * ((2 * abs2(u) + abs2(v)) * v + u * u * conj(v))
    cubic_v = 2 * ((abs2(u) + 2 * abs2(v)) * u + conj(u) * v * v)
    return (
        p.epsilon * lap(v) + 1j * p.gamma * u + p.omega * v + cubic_u,
        p.epsilon * lap(u) - 1j * p.gamma * v + p.omega * u + cubic_v,
    )


def conserved(p, u, v):
    return {"Q": u * conj(v) + conj(u) * v}
