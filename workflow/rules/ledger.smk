# The ledger of the paper's claims. Its parts are decided each by itself, as soon as the datasets of a
# part are there, and then joined: so an edit decides again only what rests on it. Each study says in
# its own file what its claims rest on, and which checks their table shows beside.
SHOWN_CHECKS = [
    *(name for names in GROUPS.values() for name in names),
    *(*OBSERVED, "lyapunov", "symmetry", "ensembles", "ensembles_uneven", "members"),
    *("lifetimes", "ensemble_runs", *SOLVER_CHECKS),
]


use rule job as claims with:
    "The ledger: each claim with its verdict, in results/claims.json and results/tables/claims.md"
    input:
        parts=expand("<results>/claims/{part}.json", part=PARTS_OF_LEDGER),
    output:
        ledger="<results>/claims.json",
        controls="<results>/controls.json",
        table="<results>/tables/claims.md",
    pathvars:
        made="claims",
    params:
        call=function("pendula.ledger.decide.join_claims"),
        names=[f"checks/{name}" for name in SHOWN_CHECKS],
