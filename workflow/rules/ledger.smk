# The ledger of the paper's claims. Each part is decided as soon as its datasets are there, and then the
# parts are joined: so an edit decides again only what rests on it.
LEDGER = {  # by part: the datasets that its claims rest on or its table shows, and where they are decided
    "figures": (
        [*TRAJECTORIES, *SWEEPS, *checks("not_shown", "ensembles")],
        claims_in("paper/claims_norms", "paper/claims_sweeps"),
    ),
    # Claims that compare the paper's solvers with others, too
    "solvers": (
        [
            *(*TRAJECTORIES, *runs_by("dop853"), *SWEEPS, *runs_by("crank_nicolson")),
            *(*SECOND_SWEEPS, *checks("cases", "lyapunov", "ensembles", "members")),
            *checks(*SOLVER_CHECKS),
        ],
        claims_in("paper/claims_energy", "paper/claims_regular", "paper/claims_second_solver"),
    ),
    "theory": (
        [*TRAJECTORIES, *checks("lyapunov", *THEORY_CHECKS, "sweeps", *WRONG_CHECKS)],
        claims_in("theory/claims"),
    ),
    "chaos": (
        [
            *datasets("sweeps", "fig5_left", "fig6_left"),
            *datasets("breathers", "sensitivity"),
            *checks("trust", *CHAOS_CHECKS),
        ],
        claims_in("chaos/claims"),
    ),
    "breathers": (rules.breathers.input.datasets, claims_in("breathers/claims")),
    "pendula": (
        [
            *rules.pendula.input.datasets,
            *(*datasets("unbounded", "thermal"), *checks("lyapunov")),
        ],
        claims_in("pendula/claims"),
    ),
    "unbounded": (
        [
            *datasets("breathers", "sensitivity"),
            *datasets("unbounded", "fig2_large", "fig3_small", "fig3_large", "fig4_small"),
            *datasets("unbounded", "omegas", "amplitudes", "thermal"),
            *datasets("unbounded", "map_fig5_left", "map_fig5_right", "map_fig6_left"),
        ],
        claims_in("unbounded/claims"),
    ),
    "certified": (
        [
            *(*PROVED_CURVES, *datasets("certified", "wrong/curve")),
            *datasets("trajectories", "fig2_small", "fig3_small"),
            *datasets("certified", "breathers"),
        ],
        claims_in("certified/claims"),
    ),
}
SHOWN_CHECKS = [
    *(*CHECKS, "lyapunov", "symmetry", "ensembles", "ensembles_uneven", "members"),
    *("lifetimes", "ensemble_runs", *SOLVER_CHECKS),
]


use rule job as decide_claims with:
    "A part of the ledger: its claims with their verdicts, and a table, tables/claims_{part}.md"
    input:
        datasets=lambda wildcards: LEDGER[wildcards.part][0],
    output:
        part="<results>/claims/{part}.json",
        table="<results>/tables/claims_{part}.md",
    pathvars:
        made="claims/{part}",
    wildcard_constraints:
        part=one_of(LEDGER),
    params:
        call=lambda wildcards: LEDGER[wildcards.part][1]["call"],
        modules=lambda wildcards: LEDGER[wildcards.part][1]["modules"],
        makers=lambda wildcards, input: {name_of(path): maker_of(path) for path in input.datasets},
        differs=lambda wildcards, input: concerning(DIFFERS, map(name_of, input.datasets)),
    message:
        "Deciding claims: {output.table}"


use rule job as claims with:
    "The ledger: each claim with its verdict, in results/claims.json and results/tables/claims.md"
    input:
        parts=expand("<results>/claims/{part}.json", part=LEDGER),
    output:
        ledger="<results>/claims.json",
        controls="<results>/controls.json",
        table="<results>/tables/claims.md",
    pathvars:
        made="claims",
    params:
        call=function("pendula.ledger.decide.join_claims"),
        names=[f"checks/{name}" for name in SHOWN_CHECKS],
