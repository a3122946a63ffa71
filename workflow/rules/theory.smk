# The paper's theory on numbers: the checks, and figures that show them.


use rule dataset as prove_identities with:
    "The identities and inequalities of the paper, as polynomials over the rationals"
    pathvars:
        made="checks/identities",
    params:
        call=function("pendula.studies.theory.identities.prove_identities"),


use rule dataset as check_not_shown with:
    "Section 5: the sweep for small amplitudes at Omega = 8, which the paper mentions and does not show"
    input:
        kernels=kernels("dop853", "taylor"),
    output:
        checks(*GROUPS["not_shown"]),
    pathvars:
        made="checks/not_shown",
    params:
        call=function("pendula.studies.theory.checks.run_checks"),
        checks=SETTINGS.theory.arguments("not_shown"),


use rule check_not_shown as check_stability with:
    "Lemma 1: dispersion, thresholds, and measured growth rates of the chain at rest"
    output:
        checks(*GROUPS["stability"]),
    pathvars:
        made="checks/stability",
    params:
        checks=SETTINGS.theory.arguments("stability"),


use rule check_not_shown as check_bounds with:
    "Lemma 2 and Theorems 1 to 3: errors of their proofs, and how near data come to their bounds"
    output:
        checks(*GROUPS["bounds"]),
    pathvars:
        made="checks/bounds",
    params:
        checks=SETTINGS.theory.arguments("bounds"),


use rule dataset as check_observed with:
    "The paper's own cases beside the bounds of its theorems"
    input:
        trajectories=TRAJECTORIES,
    pathvars:
        made="checks/cases",
    params:
        call=function("pendula.studies.theory.bounds.check_observed"),


use rule figure as stability_chart with:
    "Lemma 1: where the chain at rest is unstable, and the windows of stability of finite chains"
    input:
        chart="<results>/checks/chart.nc",
        short_chart="<results>/checks/short_chart.nc",
        windows="<results>/checks/windows.nc",
    pathvars:
        made="figures/stability_chart",
    params:
        call=function("pendula.studies.theory.figures.draw_chart"),
        points=points_of_cases(),
        of_paper=points_are_the_papers(),


use rule figure as bounds with:
    "Theorems 1 to 3: observed norms against their bounds"
    input:
        cases="<results>/checks/cases.nc",
        samples="<results>/checks/samples.nc",
        sharpness="<results>/checks/sharpness.nc",
        growth="<results>/checks/chain_growth.nc",
    pathvars:
        made="figures/bounds",
    params:
        call=function("pendula.studies.theory.bounds_figure.draw_bounds"),
