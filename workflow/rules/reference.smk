# The paper's six cases in multiprecision arithmetic, to verify every other solver against; not
# part of the full run. Costs about 25 minutes of one core, half of them for fig3_large alone.
# The only rule that needs heyoka: `pip install heyoka==7.13.2` first. To accept what it made:
# `cp results/reference/*.nc tests/baseline/reference/` (the same code makes the same bytes).
# Omega = 0 is chaotic: how long does it matter that 0.1 is not a double?
LONGEST = "fig3_large"  # as long as all others: it starts first, beside them
REFERENCES = [*PAPER_CASES, "fig4_small.double"]


rule reference:
    "The references: cases of the paper in multiprecision (half an hour; needs heyoka)"
    input:
        expand("results/reference/{name}.nc", name=REFERENCES),
    message:
        "The references are there"


rule reference_case:
    "One case, integrated twice: {case}{numbers}.nc"
    input:
        code=code("reference/integrate_reference.py"),
    output:
        dataset="results/reference/{case}{numbers}.nc",
    log:
        "results/logs/reference/{case}{numbers}.log",
    wildcard_constraints:
        case=one_of([case for case in PAPER_CASES if case != LONGEST]),
        numbers=r"(\.double)?",
    conda:
        "../envs/reference.yaml"
    params:
        name="{case}",
        problem=lambda wildcards: reference_problem(wildcards.case),
        snapshots=SETTINGS.reference.snapshots,
        bits=lambda wildcards: SETTINGS.reference.bits[wildcards.case],
        decimal=lambda wildcards: not wildcards.numbers,
    message:
        "Integrating {wildcards.case}{wildcards.numbers} twice in multiprecision"
    script:
        "../../scripts/reference/integrate_reference.py"


use rule reference_case as longest_reference_case with:
    "The case that takes longest, integrated twice: {case}{numbers}.nc"
    wildcard_constraints:
        case=LONGEST,
        numbers=r"(\.double)?",
