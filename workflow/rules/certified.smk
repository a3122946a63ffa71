# Numbers with a proof: curves with a bound of their distance to the true ones.


rule certify_curve:
    "A case whose linear flow keeps a norm, with a proven bound of the error: {case}.nc"
    input:
        code=code("certified/certify_curve.py"),
        reference=lambda wildcards: known_reference(wildcards.case),
    output:
        data="results/certified/{case}.nc",
    log:
        "results/logs/certified/{case}.log",
    wildcard_constraints:
        case=one_of([*SETTINGS.certified.curves.cases, *OWN_CASES]),
    conda:
        "../envs/pinned.yaml"
    params:
        name="{case}",
        problem=lambda wildcards: certified_problem(wildcards.case),
        made_for={},
    message:
        "Proving how far the curves of {wildcards.case} are from the true ones"
    script:
        "../../scripts/certified/certify_curve.py"


use rule certify_curve as certify_wrong_curve with:
    "A curve of an equation with a wrong constant, for the negative control of the proofs"
    input:
        code=code("certified/certify_curve.py"),
        reference=[],
    output:
        data="results/certified/wrong/curve.nc",
    log:
        "results/logs/certified/wrong_curve.log",
    params:
        **wrong_curve_params(SETTINGS.certified.curves.wrong),
    message:
        "Asking the proof about a curve of another equation"
