"""The equations (4) of the paper as a traced model, and their power series, generated from it."""

from pendula.model import Model, Value, abs2, conj, lap

from .generated import load_text, series_text


def i_dt(p, a: Value, b: Value) -> list[Value]:
    """Return i dA_n/dtau and i dB_n/dtau, see `amplitudes`."""
    return [
        p.epsilon * lap(u) + p.omega * u + p.gamma * (conj(v) - conj(u)) + 0.5 * abs2(u) * u
        for u, v in ((a, b), (b, a))
    ]


EQUATIONS = Model(
    fields=("A", "B"), parameters=dict.fromkeys(("epsilon", "gamma", "omega"), 1.0), i_dt=i_dt
)
continue_series = load_text(series_text(EQUATIONS)).continue_series
