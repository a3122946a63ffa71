# The paper's theory on numbers: the checks, and figures that show them.


use rule dataset as check_equations with:
    "Section 2: structure, symmetries and expansion of the equations; errors and gaps of the paper"
    input:
        kernels=kernels("ode45", "dop853", "taylor"),
    output:
        checks(*GROUPS["equations"]),
    pathvars:
        made="checks/equations",
    params:
        call=function("pendula.studies.theory.checks.run_checks"),
        checks=SETTINGS.theory.arguments("equations"),


use rule check_equations as check_not_shown with:
    "Section 5: the sweep for small amplitudes at Omega = 8, which the paper mentions and does not show"
    output:
        checks(*GROUPS["not_shown"]),
    pathvars:
        made="checks/not_shown",
    params:
        checks=SETTINGS.theory.arguments("not_shown"),


use rule check_equations as check_stability with:
    "Lemma 1: dispersion, thresholds, and measured growth rates of the chain at rest"
    output:
        checks(*GROUPS["stability"]),
    pathvars:
        made="checks/stability",
    params:
        checks=SETTINGS.theory.arguments("stability"),


use rule check_equations as check_bounds with:
    "Lemma 2 and Theorems 1 to 3: their bounds on random and on the worst data"
    output:
        checks(*GROUPS["bounds"]),
    pathvars:
        made="checks/bounds",
    params:
        checks=SETTINGS.theory.arguments("bounds"),


use rule check_equations as check_wrong with:
    "The same checks of wrong statements, which the claims must refuse"
    output:
        checks(*WRONG_CHECKS),
    pathvars:
        made="checks/wrong",
    params:
        checks=SETTINGS.theory.wrong_arguments(),


use rule dataset as check_observed with:
    "The paper's own cases and sweeps beside the bounds of its theorems"
    input:
        trajectories=TRAJECTORIES,
        sweeps=SWEEPS,
    output:
        checks(*OBSERVED),
    pathvars:
        made="checks/observed",
    params:
        call=function("pendula.studies.theory.bounds.check_observed"),


use rule figure as stability_figures with:
    "The two figures stability_chart and growth_rates, on Lemma 1"
    input:
        chart="<results>/checks/chart.nc",
        short_chart="<results>/checks/short_chart.nc",
        windows="<results>/checks/windows.nc",
        threshold="<results>/checks/threshold.nc",
    output:
        figure_files("<results>/figures/stability_chart"),
        figure_files("<results>/figures/growth_rates"),
    pathvars:
        made="figures/stability",
    params:
        call=function(
            "pendula.studies.theory.figures.draw_chart",
            "pendula.studies.theory.figures.draw_rates",
        ),
        points=points_of_cases(),
        of_paper=points_are_the_papers(),


use rule figure as bounds with:
    "Theorems 1 to 3: observed norms against their bounds"
    input:
        cases="<results>/checks/cases.nc",
        sweeps="<results>/checks/sweeps.nc",
        samples="<results>/checks/samples.nc",
        worst="<results>/checks/worst.nc",
        sharpness="<results>/checks/sharpness.nc",
        growth="<results>/checks/chain_growth.nc",
    pathvars:
        made="figures/bounds",
    params:
        call=function("pendula.studies.theory.bounds_figure.draw_bounds"),
