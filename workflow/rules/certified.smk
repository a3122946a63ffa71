# Numbers with a proof: curves with a bound of their distance to the true ones.
CERTIFIED = SETTINGS.certified


rule certified:
    "Curves of the paper's cases, proved, which a full run takes as they are committed (long)"
    input:
        datasets("certified", *PAPER_CASES),


use rule dataset as certify_curve with:
    "A curve of a case with a proven bound of its distance to the true one: {case}.nc"
    pathvars:
        made="certified/<any_case>",
    params:
        call=function("pendula.studies.certified.contents.curve_contents"),
        name="{case}",
        problem=lambda wildcards: certified_problem(wildcards.case),
        given=lambda wildcards: CERTIFIED.frames.get(wildcards.case, CERTIFIED.own).model_dump(),


use rule dataset as prove_breathers with:
    "Steady breathers that are proved to exist on the infinite chain"
    pathvars:
        made="certified/breathers",
    params:
        **values_of(CERTIFIED.breathers),
        call=function("pendula.studies.certified.proved_breathers.breathers_contents"),
