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


rule certified:
    "The proofs of large and chaotic cases, which a full run takes as they are committed (long)"
    input:
        framed_curves(),
    message:
        "The proofs by frames are there"


rule certify_by_frames:
    "A case whose errors grow, with a proven bound of the error: {case}.nc"
    input:
        code=code("certified/certify_by_frames.py"),
        reference=lambda wildcards: references(wildcards.case),
    output:
        data="results/certified/{case}.nc",
    log:
        "results/logs/certified/{case}.log",
    wildcard_constraints:
        case=one_of(SETTINGS.certified.frames),
    conda:
        "../envs/pinned.yaml"
    params:
        name="{case}",
        problem=lambda wildcards: framed_problem(wildcards.case),
        proof=lambda wildcards: proof_by_frames(wildcards.case),
    message:
        "Proving by frames how far the curves of {wildcards.case} are from the true ones"
    script:
        "../../scripts/certified/certify_by_frames.py"


rule measure_lines:
    "Until when the printed lines of Figs 2 to 4 contain the true curves, as a theorem"
    input:
        code=code("certified/measure_lines.py"),
        trajectories=trajectories(),
        references=references(*PAPER_CASES),
        proved=[*proved_curves(), *committed_proofs()],
    output:
        data="results/certified/lines.nc",
    log:
        "results/logs/certified/lines.log",
    conda:
        "../envs/pinned.yaml"
    params:
        cases=PAPER_CASES,
        certified=[*SETTINGS.certified.curves.cases, *SETTINGS.certified.frames],
    message:
        "Finding until when the printed lines contain the true curves"
    script:
        "../../scripts/certified/measure_lines.py"


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


rule certified_curves:
    "Proven bounds of the error of curves, what they are due to, and the error that is known"
    input:
        code=code("certified/draw_curves.py"),
        curves=proved_curves(),
    output:
        **figure("certified_curves"),
    log:
        "results/logs/figures/certified_curves.log",
    conda:
        "../envs/pinned.yaml"
    params:
        differs=differs_of,
    message:
        "Drawing the proven bounds of curves"
    script:
        "../../scripts/certified/draw_curves.py"


rule prove_breathers:
    "Steady breathers that are proved to exist on the infinite chain, and spectra on a finite one"
    input:
        code=code("certified/prove_breathers.py"),
    output:
        data="results/certified/breathers.nc",
    log:
        "results/logs/certified/breathers.log",
    conda:
        "../envs/pinned.yaml"
    params:
        **SETTINGS.certified.breathers.model_dump(),
    message:
        "Proving that steady breathers exist, and which are stable"
    script:
        "../../scripts/certified/prove_breathers.py"


rule enclose_constants:
    "The constants of the theorems that the theory stores, between bounds"
    input:
        code=code("certified/enclose_constants.py"),
        datasets=checks(*ENCLOSED),
    output:
        data="results/certified/constants.nc",
    log:
        "results/logs/certified/constants.log",
    conda:
        "../envs/pinned.yaml"
    params:
        **constants_params(),
    message:
        "Enclosing the constants of the theorems"
    script:
        "../../scripts/certified/enclose_constants.py"


rule certificate:
    "The proof of a short case as a file that others can check: results/certified/short_case.json"
    input:
        code=code("certified/make_certificate.py"),
    output:
        certificate="results/certified/short_case.json",
    log:
        "results/logs/certified/certificate.log",
    conda:
        "../envs/pinned.yaml"
    params:
        problem=short_problem(SETTINGS.certified.certificate),
    message:
        "Making a certificate of a short case"
    script:
        "../../scripts/certified/make_certificate.py"
