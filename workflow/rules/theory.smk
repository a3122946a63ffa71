# The paper's theory: its checks by numbers, and figures that show them.


use rule dataset as prove_identities with:
    "The identities and inequalities of the paper, as polynomials over the rationals"
    pathvars:
        made="checks/identities",
    params:
        call=function("pendula.studies.theory.identities.prove_identities"),


use rule dataset as check_theory with:
    "Lemmas 1 and 2, the sharpness of Theorems 1 to 3, errors of their proofs, and a sweep that the paper does not show"
    input:
        kernels("taylor", "dop853"),
    output:
        dataset_outputs(*checks(*THEORY_CHECKS)),
    pathvars:
        made="checks/theory",
    params:
        call=function("pendula.studies.theory.checks.run_checks"),


use rule dataset as check_observed with:
    "The paper's cases compared with the bounds of its theorems"
    input:
        trajectories=TRAJECTORIES,
    pathvars:
        made="checks/cases",
    params:
        call=function("pendula.studies.theory.bounds.check_observed"),


use rule figure as stability_chart with:
    "Lemma 1: where the chain at rest is unstable"
    input:
        chart="<results>/checks/chart.nc",
    pathvars:
        made="figures/stability_chart",
    params:
        call=function("pendula.studies.theory.figures.draw_chart"),
        points=SETTINGS.points_of_cases(),
        of_paper=not constants_differ(DIFFERS, PAPER_CASES),


use rule figure as bounds with:
    "Theorems 1 to 3: observed norms against their bounds"
    input:
        cases="<results>/checks/cases.nc",
    pathvars:
        made="figures/bounds",
    params:
        call=function("pendula.studies.theory.figures.draw_bounds"),
