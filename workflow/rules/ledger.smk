# The ledger of the paper's claims. Each part is decided once its datasets exist, then the parts are joined, so that an
# edit re-decides only the parts that depend on it.
CLAIM_MODULES = parts_of_ledger()
DECIDING = {
    part: function("pendula.jobs.decide.decide_claims", modules=modules_of(modules))
    for part, modules in CLAIM_MODULES.items()
}


use rule job as decide_claims with:
    "A part of the ledger: its claims with their verdicts"
    input:
        datasets=lambda wildcards: expand(
            "<results>/{name}.nc",
            name=datasets_of_claims(CLAIM_MODULES[wildcards.part], DECIDING[wildcards.part][1]),
        ),
    output:
        part="<results>/claims/{part}.json",
    pathvars:
        made="claims/{part}",
    wildcard_constraints:
        part=any_of(CLAIM_MODULES),
    params:
        call=lambda wildcards: DECIDING[wildcards.part],
        modules=lambda wildcards: CLAIM_MODULES[wildcards.part],
        names=lambda wildcards, input: list(map(name_of, input.datasets)),
        differs=lambda wildcards, input: concerning(DIFFERS, map(name_of, input.datasets)),
    message:
        "Deciding claims: {output.part}"


use rule job as claims with:
    "The ledger: each claim with its verdict, in results/claims.json and results/tables/claims.md"
    input:
        parts=expand("<results>/claims/{part}.json", part=CLAIM_MODULES),
    output:
        ledger="<results>/claims.json",
        table="<results>/tables/claims.md",
    pathvars:
        made="claims",
    params:
        call=function("replication.ledger.decide.join_claims"),


use rule job as claims_on_figures with:
    "Only the claims on Figs 1 to 6, in results/tables/claims_figures.md"
    input:
        parts=["<results>/claims/figures.json"],
    output:
        table="<results>/tables/claims_figures.md",
    pathvars:
        made="claims_figures",
    params:
        call=function("replication.ledger.decide.tabulate_claims"),
