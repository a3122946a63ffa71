# The ledger of the paper's claims. Each part is decided as soon as its datasets are there, and then the
# parts are joined: so an edit decides again only what rests on it.
RESTS_ON = {  # by part: the datasets that its claims rest on
    "figures": [*TRAJECTORIES, *SWEEPS, *checks("not_shown")],
    "solvers": [
        *(*datasets("sweeps", "fig5_left", "fig6_left", "fig6_right"), *SECOND_SWEEPS),
        *checks("cases", "lyapunov", "second_solver", "members", "solvers"),
    ],
    "theory": checks("lyapunov", "identities", *THEORY_CHECKS),
    "chaos": [
        *datasets("sweeps", "fig6_left", "fig6_right"),
        *(*datasets("trajectories", "fig3_large"), *datasets("breathers", "sensitivity")),
        *checks("ensembles", "members", "lifetimes"),
    ],
    "breathers": rules.breathers.input.datasets,
    "newton": rules.newton.input.datasets,
    "unbounded": [
        *datasets("breathers", "sensitivity"),
        *datasets("unbounded", *SETTINGS.unbounded.names, "thermal"),
    ],
    "certified": [*checks("trust"), *datasets("certified", "breathers")],
}
DECIDED_IN = {part: [f"{part}/claims"] for part in RESTS_ON} | {
    "figures": ["paper/claims_norms", "paper/claims_sweeps"],
    "solvers": ["paper/claims_energy", "paper/claims_regular", "paper/claims_second_solver"],
    "pendula": ["newton/claims"],
}
DECIDING = {
    part: function("replication.ledger.decide.decide_claims", parts=modules)
    for part, modules in DECIDED_IN.items()
}


use rule job as decide_claims with:
    "A part of the ledger: its claims with their verdicts"
    input:
        datasets=lambda wildcards: RESTS_ON[wildcards.part],
    output:
        part="<results>/claims/{part}.json",
    pathvars:
        made="claims/{part}",
    wildcard_constraints:
        part=one_of(RESTS_ON),
    params:
        call=lambda wildcards: DECIDING[wildcards.part],
        modules=lambda wildcards: DECIDED_IN[wildcards.part],
        names=lambda wildcards, input: list(map(name_of, input.datasets)),
        differs=lambda wildcards, input: concerning(DIFFERS, map(name_of, input.datasets)),
    message:
        "Deciding claims: {output.part}"


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
        call=function("replication.ledger.decide.join_claims"),


use rule job as claims_on_figures with:
    "The claims on Figs 1 to 6 alone, in results/tables/claims_figures.md"
    input:
        parts=["<results>/claims/figures.json"],
    output:
        table="<results>/tables/claims_figures.md",
    pathvars:
        made="claims_figures",
    params:
        call=function("replication.ledger.decide.tabulate_claims"),
