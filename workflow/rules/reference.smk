# The paper's six cases in multiprecision arithmetic, to verify every other solver against; not
# part of the full run. Costs about 25 minutes of one core, half of them for fig3_large alone.
# The only rule that needs heyoka: `pip install heyoka==7.13.2` first. To accept what it made:
# `cp results/reference/*.nc tests/baseline/reference/` (the same code makes the same bytes).


rule reference:
    "The references: cases of the paper in multiprecision (half an hour; needs heyoka)"
    input:
        expand("<results>/reference/{name}.nc", name=PAPER_CASES),


use rule dataset as reference_case with:
    "One case, integrated twice: {case}.nc"
    pathvars:
        made="reference/<paper_case>",
    conda:
        "../envs/reference.yaml"
    resources:
        **asked(lambda wildcards: LONG),
    params:
        call=function("pendula.studies.reference.verified_run.reference_contents"),
        name="{case}",
        problem=lambda wildcards: reference_problem(wildcards.case),
        snapshots=SETTINGS.reference.snapshots,
        bits=lambda wildcards: SETTINGS.reference.bits[wildcards.case],
