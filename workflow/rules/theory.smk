# The paper's theory on numbers: the checks, and figures that show them.


rule check_equations:
    "Section 2: structure, symmetries and expansion of the equations; errors and gaps of the paper"
    input:
        code=code("theory/run_checks.py"),
        kernels=kernels("ode45", "dop853", "taylor"),
    output:
        datasets=checks(*GROUPS["equations"]),
    log:
        "results/logs/checks/equations.log",
    conda:
        "../envs/pinned.yaml"
    params:
        checks=SETTINGS.theory.arguments("equations"),
    message:
        "Checking the equations, their symmetries and their expansion"
    script:
        "../../scripts/theory/run_checks.py"


use rule check_equations as check_not_shown with:
    "Section 5: the sweep for small data that the paper mentions and does not show"
    output:
        datasets=checks(*GROUPS["not_shown"]),
    log:
        "results/logs/checks/not_shown.log",
    params:
        checks=SETTINGS.theory.arguments("not_shown"),
    message:
        "Sweeping the half-width where the paper shows no figure"


use rule check_equations as check_stability with:
    "Lemma 1: dispersion, thresholds, and measured growth rates of the chain at rest"
    output:
        datasets=checks(*GROUPS["stability"]),
    log:
        "results/logs/checks/stability.log",
    params:
        checks=SETTINGS.theory.arguments("stability"),
    message:
        "Checking Lemma 1: dispersion, thresholds, measured growth rates"


use rule check_equations as check_bounds with:
    "Lemma 2 and Theorems 1 to 3: their bounds on random and on the worst data"
    output:
        datasets=checks(*GROUPS["bounds"]),
    log:
        "results/logs/checks/bounds.log",
    params:
        checks=SETTINGS.theory.arguments("bounds"),
    message:
        "Checking Lemma 2 and Theorems 1 to 3 on random and on the worst data"


use rule check_equations as check_wrong with:
    "The same checks of wrong statements, which the claims must refuse"
    output:
        datasets=checks(*(f"wrong/{name}" for name in WRONG)),
    log:
        "results/logs/checks/wrong.log",
    params:
        checks=SETTINGS.theory.wrong_arguments(),
    message:
        "Asking the checks about wrong statements, for the negative controls"


rule check_observed:
    "The paper's own cases and sweeps beside the bounds of its theorems"
    input:
        code=code("theory/check_observed.py"),
        trajectories=trajectories(),
        sweeps=sweeps(),
    output:
        cases_check="results/checks/cases.nc",
        sweeps_check="results/checks/sweeps.nc",
    log:
        "results/logs/checks/observed.log",
    conda:
        "../envs/pinned.yaml"
    params:
        cases=PAPER_CASES,
        swept=PAPER_SWEEPS,
    message:
        "Setting the cases and sweeps beside the bounds of the theorems"
    script:
        "../../scripts/theory/check_observed.py"


rule stability_figures:
    "The two figures stability_chart and growth_rates, on Lemma 1"
    input:
        code=code("theory/draw_stability.py"),
        chart="results/checks/chart.nc",
        short_chart="results/checks/short_chart.nc",
        windows="results/checks/windows.nc",
        threshold="results/checks/threshold.nc",
    output:
        stability=files_of("results/figures/stability_chart"),
        growth=files_of("results/figures/growth_rates"),
    log:
        "results/logs/figures/stability.log",
    conda:
        "../envs/pinned.yaml"
    params:
        differs=differs_of,
        points=points_of_cases(),
        of_paper=points_are_the_papers(),
    message:
        "Drawing the stability chart and the growth rates"
    script:
        "../../scripts/theory/draw_stability.py"


rule bounds:
    "Theorems 1 to 3: observed norms against their bounds"
    input:
        code=code("theory/draw_bounds.py"),
        cases="results/checks/cases.nc",
        sweeps="results/checks/sweeps.nc",
        samples="results/checks/samples.nc",
        worst="results/checks/worst.nc",
        sharpness="results/checks/sharpness.nc",
        growth="results/checks/chain_growth.nc",
    output:
        **figure("bounds"),
    log:
        "results/logs/figures/bounds.log",
    conda:
        "../envs/pinned.yaml"
    params:
        differs=differs_of,
    message:
        "Drawing observed norms against the bounds of the theorems"
    script:
        "../../scripts/theory/draw_bounds.py"
