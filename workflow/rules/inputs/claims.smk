# What the parts of the ledger read, and the modules of their claims.
OTHER_STUDIES = ("theory", "chaos", "breathers", "pendula", "unbounded", "certified")
# The parts of the ledger, and the modules of claims in each, by the starts of their names
CLAIMS_OF = {
    "figures": ["paper/claims_norms", "paper/claims_sweeps"],
    "solvers": ["paper/claims_energy", "paper/claims_regular", "paper/claims_second_solver"],
    **{study: [f"{study}/claims"] for study in OTHER_STUDIES},
}


CLAIMED_RUNS = ["fig2_large", "fig3_small", "fig3_large", "fig4_small"]
CLAIMED_RUNS += ["omegas", "amplitudes", "thermal"]  # of chains without ends


def claims_need():
    """Return by part of the ledger the rule that makes each of the datasets that it reads.

    Beside what the claims rest on these are the checks of the part, which its table shows.
    """
    second = trajectories(".crank_nicolson"), sweeps(".crank_nicolson")
    of_theory = (*(name for names in GROUPS.values() for name in names), "sweeps")
    needs = {
        "figures": [*trajectories(), *sweeps(), *checks("not_shown", "ensembles")],
        "solvers": [
            *(*trajectories(), *trajectories(".dop853"), *sweeps(), *second[0], *second[1]),
            *checks("cases", "lyapunov", "ensembles", "members", *SOLVER_CHECKS),
        ],
        "theory": [
            *(*trajectories(), *checks("lyapunov", *of_theory)),
            *checks(*(f"wrong/{name}" for name in WRONG)),
        ],
        "chaos": [
            *below(["sweeps/fig5_left", "sweeps/fig6_left", "breathers/sensitivity"]),
            *checks("trust", *CHAOS_CHECKS),
        ],
        "breathers": below(f"breathers/{name}" for name in BREATHERS_PARTS),
        "pendula": [
            *below([*(f"pendula/{name}" for name in PENDULA), "unbounded/thermal"]),
            *checks("lyapunov"),
        ],
        "certified": [
            *(*proved_curves(), *below(["certified/wrong/curve"])),
            *below(["trajectories/fig2_small", "trajectories/fig3_small"]),
            *below(["certified/breathers"]),
        ],
        "unbounded": [
            *below(["breathers/sensitivity", *(f"unbounded/{name}" for name in CLAIMED_RUNS)]),
            *below(f"unbounded/map_{sweep}" for sweep in ("fig5_left", "fig5_right", "fig6_left")),
        ],
    }
    made_by = makers()
    named = {part: map(name_of, paths) for part, paths in needs.items()}
    return {part: {name: made_by[name] for name in names} for part, names in named.items()}


CLAIMS_NEED = claims_need()
CLAIMS_CODE = {
    part: code("ledger/decide_claims.py", *modules, of=part) for part, modules in CLAIMS_OF.items()
}
