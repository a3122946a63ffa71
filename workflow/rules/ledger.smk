# The ledger of the paper's claims. Its parts are decided each by itself, as soon as the datasets of a
# part are there, and then joined: so an edit decides again only what rests on it.


rule decide_claims:
    "A part of the ledger: its claims with their verdicts, in results/tables/claims_{part}.md"
    input:
        code=lambda wildcards: CLAIMS_CODE[wildcards.part],
        datasets=lambda wildcards: below(CLAIMS_NEED[wildcards.part]),
    output:
        part="results/claims/{part}.json",
        table="results/tables/claims_{part}.md",
    log:
        "results/logs/claims/{part}.log",
    wildcard_constraints:
        part=one_of(CLAIMS_OF),
    conda:
        "../envs/pinned.yaml"
    params:
        makers=lambda wildcards: CLAIMS_NEED[wildcards.part],
        modules=lambda wildcards: CLAIMS_OF[wildcards.part],
        differs=lambda wildcards: concerning(DIFFERS, CLAIMS_NEED[wildcards.part]),
    message:
        "Deciding the claims of the part {wildcards.part}"
    script:
        "../../scripts/ledger/decide_claims.py"


rule claims:
    "The ledger: each claim with its verdict, in results/claims.json and results/tables/claims.md"
    input:
        code=code("ledger/join_claims.py"),
        parts=expand("results/claims/{part}.json", part=CLAIMS_OF),
    output:
        ledger="results/claims.json",
        controls="results/controls.json",
        table="results/tables/claims.md",
    log:
        "results/logs/claims.log",
    conda:
        "../envs/pinned.yaml"
    params:
        names=list(makers()),
    message:
        "Joining the parts of the ledger"
    script:
        "../../scripts/ledger/join_claims.py"
