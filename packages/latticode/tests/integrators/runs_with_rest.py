"""Runs whose numbers fall to 1e-250, started as a program with the rule of rest or without it.

    python runs_with_rest.py FILE [without]

writes the norms and the final fields of each run to FILE (npz).
"""

import sys

import numpy as np


def drop_the_rule() -> None:
    """Let no number count as rest. All that copies these numbers is imported afterwards."""
    from latticode.kernels import simd

    simd.TINY = 0.0
    from latticode.integrators import rest

    rest.OF_SERIES = rest.OF_STAGES = 0.0


def models():
    """Return a cubic chain, one of degree five that starts at rest, and one of real fields."""
    from latticode import Model, abs2, lap, sin

    def quintic(p, u):
        return lap(u) + (abs2(u) * abs2(u)) * u - 0.2 * u + p.force

    def pendula(p, x):
        return 0.5 * lap(x) - sin(x) - 0.3 * x * x * x

    from dimers import DIMERS

    return {
        "cubic": DIMERS,
        "driven": Model(fields="u", parameters={"force": 0.0}, i_dt=quintic),
        "pendula": Model(fields="x", parameters={}, d2_dt2=pendula),
    }


TOLERANCES = {"rtol": 1e-9, "atol": 1e-9}
CONTROLS = {
    "taylor": TOLERANCES,
    "dop853": TOLERANCES,
    "ode45": TOLERANCES,
    "crank_nicolson": {"step": 0.02, "tolerance": 1e-12, "iterations": 50},
    "kahan_li": {"step": 0.1},
}
RUNS = {
    "cubic": ("taylor", "dop853", "ode45", "crank_nicolson"),
    "driven": ("taylor", "dop853"),
    "pendula": ("taylor", "kahan_li"),
}


def initial(name: str, half_width: int) -> dict[str, dict]:
    """Return the initial conditions of a model by their names."""
    rng = np.random.default_rng(63)
    fields = 2 if name == "cubic" else 1
    everywhere = rng.normal(size=(2 * half_width + 1, fields))
    noise = {n - half_width: values.tolist() for n, values in enumerate(everywhere)}
    localised = {0: [1.0, 0.1][:fields]}
    return {"localised": localised, "noise": noise} if name != "driven" else {"rest": {0: [0.0]}}


def main(file: str, *without: str) -> None:
    if without:
        drop_the_rule()
    from latticode import Case
    from latticode.simulation.simulate import simulate

    results, half_width = {}, 200
    force = [float(n == half_width) for n in range(2 * half_width + 1)]
    for name, model in models().items():
        for start, sites in initial(name, half_width).items():
            for solver in RUNS[name]:
                parameters = {"force": force} if name == "driven" else {}
                case = Case(
                    model=model,
                    parameters=parameters,
                    half_width=half_width,
                    initial=sites,
                    end_time=4.0,
                    output_step=1.0,
                    solver={"name": solver, **CONTROLS[solver]},
                )
                run = simulate(case.kind.of(case.problem()))
                norms = np.concatenate([run.linf, run.l2])
                results[f"{name}.{start}.{solver}.norms"] = norms
                results[f"{name}.{start}.{solver}.final"] = run.final
    np.savez(file, **results)


if __name__ == "__main__":
    main(*sys.argv[1:])
