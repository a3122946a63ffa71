# Numbers with a proof: curves with a bound of their distance to the true ones.
CERTIFIED = SETTINGS.certified


use rule dataset as certify_curve with:
    "A case whose linear flow keeps a norm, with a proven bound of the error: {case}.nc"
    pathvars:
        made=f"certified/{{case,{one_of([*CERTIFIED.curves.cases, *OWN_CASES])}}}",
    params:
        call=function("pendula.studies.certified.contents.curve_contents"),
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
        name="{case}",
        problem=lambda wildcards: framed_problem(wildcards.case),
        proof=lambda wildcards: values_of(
            CERTIFIED.frames[wildcards.case], "bits", "order", "outputs_per_frame"
        ),


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
        made_for=CERTIFIED.curves.wrong.model_dump(
            include={"epsilon", "gamma", "omega"}, exclude_none=True
        ),


use rule dataset as prove_breathers with:
    "Steady breathers that are proved to exist on the infinite chain, and spectra on a finite one"
    pathvars:
        made="certified/breathers",
    params:
        **values_of(CERTIFIED.breathers),
        call=function("pendula.studies.certified.proved_breathers.breathers_contents"),
