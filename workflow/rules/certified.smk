# Numbers with a proof: curves with a bound of their distance to the true ones.
CERTIFIED = SETTINGS.certified


use rule dataset as certify_curve with:
    "A case whose linear flow keeps a norm, with a proven bound of the error: {case}.nc"
    pathvars:
        made=f"certified/{{case,{one_of([*CERTIFIED.curves.cases, *OWN_CASES])}}}",
    params:
        call=function("pendula.studies.certified.contents.curve_contents"),
        committed=lambda wildcards: committed(**reference_of(wildcards.case)),
        name="{case}",
        problem=lambda wildcards: certified_problem(wildcards.case),
        made_for={},


rule certified:
    "The proofs of large and chaotic cases, which a full run takes as they are committed (long)"
    input:
        datasets("certified", *CERTIFIED.frames),


use rule dataset as certify_by_frames with:
    "A case whose errors grow, with a proven bound of the error: {case}.nc"
    pathvars:
        made=f"certified/{{case,{one_of(CERTIFIED.frames)}}}",
    params:
        call=function("pendula.studies.certified.contents.frame_contents"),
        committed=lambda wildcards: committed(**reference_of(wildcards.case)),
        name="{case}",
        problem=lambda wildcards: framed_problem(wildcards.case),
        proof=lambda wildcards: values_of(
            CERTIFIED.frames[wildcards.case], "bits", "order", "outputs_per_frame"
        ),


use rule dataset as measure_lines with:
    "Until when the printed lines of Figs 2 to 4 contain the true curves, as a theorem"
    input:
        runs=TRAJECTORIES,
        proved=PROVED_CURVES,
    pathvars:
        made="certified/lines",
    params:
        call=function("pendula.studies.certified.lines.contain_curves"),
        committed=committed(references=references(*PAPER_CASES), proofs=committed_proofs()),


use rule certify_curve as certify_wrong_curve with:
    "A curve of an equation with a wrong constant, for the negative control of the proofs"
    pathvars:
        made="certified/wrong/curve",
    params:
        name=CERTIFIED.curves.wrong.case,
        problem={
            **certified_problem(CERTIFIED.curves.wrong.case),
            **values_of(CERTIFIED.curves.wrong, "end_time"),
        },
        committed={},
        made_for=CERTIFIED.curves.wrong.model_dump(
            include={"epsilon", "gamma", "omega"}, exclude_none=True
        ),


use rule figure as certified_curves with:
    "Proven bounds of the error of curves, what they are due to, and the error that is known"
    input:
        curves=PROVED_CURVES,
    pathvars:
        made="figures/certified_curves",
    params:
        call=function("pendula.studies.certified.figures.draw_curves"),


use rule dataset as prove_breathers with:
    "Steady breathers that are proved to exist on the infinite chain, and spectra on a finite one"
    pathvars:
        made="certified/breathers",
    params:
        **values_of(CERTIFIED.breathers),
        call=function("pendula.studies.certified.proved_breathers.breathers_contents"),


use rule dataset as enclose_constants with:
    "The constants of the theorems that the theory stores, between bounds"
    input:
        datasets=checks(*ENCLOSED),
    pathvars:
        made="certified/constants",
    params:
        call=function("pendula.studies.certified.constants.enclose_checks"),
        problems={case: SETTINGS.problem(case, snapshot_step=None) for case in PAPER_CASES},
        theory={
            name: arguments
            for group in GROUPS
            for name, arguments in SETTINGS.theory.arguments(group).items()
            if name in ENCLOSED
        },


use rule job as certificate with:
    "The proof of a short case as a file that others can check: results/certified/short_case.json"
    output:
        certificate="<results>/certified/short_case.json",
    pathvars:
        made="certified/certificate",
    params:
        call=function("pendula.studies.certified.certificate.write_certificate"),
        problem={
            **certified_problem(CERTIFIED.certificate.case),
            **values_of(CERTIFIED.certificate, "half_width", "end_time"),
        },
