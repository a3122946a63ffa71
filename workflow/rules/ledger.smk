# The ledger of the paper's claims. Each part is decided as soon as its datasets are there, and then the
# parts are joined: so an edit decides again only what rests on it.
RESTS_ON = {  # by part: the datasets that its claims rest on, and those that its table shows
    "figures": [*TRAJECTORIES, *SWEEPS, *checks("not_shown", "ensembles")],
    "solvers": [  # beside the paper's own, those that its sentences are compared with
        *(*TRAJECTORIES, *runs_by("dop853"), *SWEEPS, *runs_by("crank_nicolson"), *SECOND_SWEEPS),
        *checks("cases", "lyapunov", "ensembles", "members", *SOLVER_CHECKS),
    ],
    "theory": [*TRAJECTORIES, *checks("lyapunov", *THEORY_CHECKS, "sweeps", *WRONG_CHECKS)],
    "chaos": [
        *(*datasets("sweeps", "fig5_left", "fig6_left"), *datasets("breathers", "sensitivity")),
        *checks("trust", *CHAOS_CHECKS),
    ],
    "breathers": rules.breathers.input.datasets,
    "pendula": [
        *rules.pendula.input.datasets,
        *(*datasets("unbounded", "thermal"), *checks("lyapunov")),
    ],
    "unbounded": [
        *datasets("breathers", "sensitivity"),
        *datasets("unbounded", "fig2_large", "fig3_small", "fig3_large", "fig4_small"),
        *datasets("unbounded", "omegas", "amplitudes", "thermal"),
        *datasets("unbounded", "map_fig5_left", "map_fig5_right", "map_fig6_left"),
    ],
    "certified": [
        *(*PROVED_CURVES, *datasets("certified", "wrong/curve")),
        *datasets("trajectories", "fig2_small", "fig3_small"),
        *datasets("certified", "breathers"),
    ],
}
DECIDED_IN = {part: [f"{part}/claims"] for part in RESTS_ON} | {
    "figures": ["paper/claims_norms", "paper/claims_sweeps"],
    "solvers": ["paper/claims_energy", "paper/claims_regular", "paper/claims_second_solver"],
}
DECIDING = {
    part: function("pendula.ledger.decide.decide_claims", parts=modules)
    for part, modules in DECIDED_IN.items()
}


use rule job as decide_claims with:
    "A part of the ledger: its claims with their verdicts, and a table, tables/claims_{part}.md"
    input:
        datasets=lambda wildcards: RESTS_ON[wildcards.part],
    output:
        part="<results>/claims/{part}.json",
        table="<results>/tables/claims_{part}.md",
    pathvars:
        made="claims/{part}",
    wildcard_constraints:
        part=one_of(RESTS_ON),
    params:
        call=lambda wildcards: DECIDING[wildcards.part],
        modules=lambda wildcards: DECIDED_IN[wildcards.part],
        makers=lambda wildcards, input: {name_of(path): maker_of(path) for path in input.datasets},
        differs=lambda wildcards, input: concerning(DIFFERS, map(name_of, input.datasets)),
    message:
        "Deciding claims: {output.table}"


use rule job as claims with:
    "The ledger: each claim with its verdict, in results/claims.json and results/tables/claims.md"
    input:
        parts=expand("<results>/claims/{part}.json", part=RESTS_ON),
    output:
        ledger="<results>/claims.json",
        table="<results>/tables/claims.md",
    pathvars:
        made="claims",
    params:
        call=function("pendula.ledger.decide.join_claims"),
