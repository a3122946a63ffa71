# Tests of the solvers: curves with proven error bounds, the paper's six cases in multiprecision, and cases
# where solvers are most likely to fail.
# The references are not part of the full run. They take about 25 minutes on one core, half of them for
# fig3_large, and need `pip install heyoka==7.13.2`, which no other rule needs. To accept new ones:
# `cp results/reference/*.nc tests/baseline/reference/` (the same code makes the same bytes).
CERTIFIED = SETTINGS.certified


rule certified:
    "Curves of the paper's cases with proven error bounds; a full run uses the committed ones (long)"
    input:
        datasets("certified", *PAPER_CASES),


use rule dataset as certify_curve with:
    "A curve of a case with a proven error bound: {case}.nc"
    pathvars:
        made="certified/<any_case>",
    params:
        call=function("pendula.studies.certified.contents.certify_curve"),
        name="{case}",
        problem=lambda wildcards: stopping(CERTIFIED.problem)(SETTINGS, wildcards.case),
        bits=lambda wildcards: CERTIFIED.frames_of(wildcards.case).bits,
        order=lambda wildcards: CERTIFIED.frames_of(wildcards.case).order,
        outputs_per_frame=lambda wildcards: CERTIFIED.frames_of(wildcards.case).outputs_per_frame,


use rule dataset as prove_breathers with:
    "Steady breathers that are proved to exist on the infinite chain"
    pathvars:
        made="certified/breathers",
    params:
        **values_of(CERTIFIED.breathers),
        call=function("pendula.studies.certified.proved_breathers.prove_breathers"),


use rule dataset as hard_cases with:
    "Hard cases: the error of each solver, or why it rejects the run"
    input:
        kernels(*ALL_SOLVERS),
    pathvars:
        made="checks/hard_cases",
    params:
        call=function("pendula.studies.hard_cases.outcomes.run_hard_cases"),
        cases=SETTINGS.hard_cases.plain_cases(),


rule reference:
    "The references: cases of the paper in multiprecision (half an hour; needs heyoka)"
    input:
        expand("<results>/reference/{name}.nc", name=PAPER_CASES),


use rule dataset as reference_case with:
    "The reference of a case, integrated twice: {case}.nc"
    pathvars:
        made="reference/<paper_case>",
    conda:
        environment("reference")
    resources:
        **resources_for(long_study),
    params:
        call=function("pendula.studies.reference.verified_run.make_reference"),
        name="{case}",
        problem=lambda wildcards: SETTINGS.reference.problem(SETTINGS, wildcards.case),
        snapshots=SETTINGS.reference.snapshots,
        bits=lambda wildcards: SETTINGS.reference.bits[wildcards.case],
