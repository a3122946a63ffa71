# The paper's theory on numbers: the checks, the ledger of its claims, and figures that show them.


def checks(*names):
    return [f"results/checks/{name}.nc" for name in names]


def trajectories(solver=""):
    return [f"results/trajectories/{case}{solver}.nc" for case in PAPER_CASES]


def sweeps(solver=""):
    return [f"results/sweeps/{sweep}{solver}.nc" for sweep in PAPER_SWEEPS]


def makers():
    """Return the rule that makes each dataset below results/, by its name without the ending."""
    by_rule = {f"check_{group}": checks(*names) for group, names in GROUPS.items()} | {
        "check_observed": checks(*OBSERVED),
        "trajectory": trajectories(),
        "trajectory_by_solver": trajectories(".crank_nicolson"),
        "sweep": sweeps(),
        "sweep_by_solver": sweeps(".crank_nicolson"),
    }
    return {
        path.removeprefix("results/").removesuffix(".nc"): rule
        for rule, paths in by_rule.items()
        for path in paths
    }


def points_of_paper():
    """Return (Omega, gamma) of the paper's cases in units of epsilon, once each."""
    problems = [SETTINGS.problem(case) for case in PAPER_CASES if SETTINGS.problem(case)["epsilon"]]
    return sorted({(p["omega"] / p["epsilon"], p["gamma"] / p["epsilon"]) for p in problems})


rule check_model:
    "Section 2: Hamiltonian structure, symmetries, conservation, the expansion"
    input:
        code=code("theory/run_checks.py"),
        kernels=expand("results/kernels/{solver}.txt", solver=["ode45", "dop853"]),
    output:
        datasets=checks(*GROUPS["model"]),
    log:
        "results/logs/checks/model.log",
    conda:
        "../envs/pinned.yaml"
    params:
        checks=GROUPS["model"],
    message:
        "Checking the equations, their symmetries and their expansion"
    script:
        "../../scripts/theory/run_checks.py"


use rule check_model as check_stability with:
    output:
        datasets=checks(*GROUPS["stability"]),
    log:
        "results/logs/checks/stability.log",
    threads: 2
    params:
        checks=GROUPS["stability"],
    message:
        "Checking Lemma 1: dispersion, thresholds, measured growth rates"


use rule check_model as check_bounds with:
    output:
        datasets=checks(*GROUPS["bounds"]),
    log:
        "results/logs/checks/bounds.log",
    threads: 2
    params:
        checks=GROUPS["bounds"],
    message:
        "Checking Lemma 2 and Theorems 1 to 3 on random and on the worst data"


use rule check_model as check_errata with:
    output:
        datasets=checks(*GROUPS["errata"]),
    log:
        "results/logs/checks/errata.log",
    params:
        checks=GROUPS["errata"],
    message:
        "Checking the errors and gaps of the paper"


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


rule claims:
    "results/claims.json: every sentence of the paper that numbers can decide, with its verdict"
    input:
        code=code("theory/decide_claims.py"),
        datasets=expand("results/{name}.nc", name=makers()),
    output:
        ledger="results/claims.json",
        table="results/tables/claims.md",
    log:
        "results/logs/claims.log",
    conda:
        "../envs/pinned.yaml"
    params:
        names=list(makers()),
        makers=makers(),
    message:
        "Deciding the claims of the paper"
    script:
        "../../scripts/theory/decide_claims.py"


rule stability_chart:
    "Lemma 1: where the chain at rest is unstable, and how fast it leaves"
    input:
        code=code("figures/draw_stability.py"),
        chart="results/checks/chart.nc",
        short_chart="results/checks/short_chart.nc",
        windows="results/checks/windows.nc",
    output:
        **figure("stability_chart"),
    log:
        "results/logs/figures/stability_chart.log",
    conda:
        "../envs/pinned.yaml"
    params:
        points=points_of_paper(),
    message:
        "Drawing the stability chart"
    script:
        "../../scripts/figures/draw_stability.py"


rule growth_rates:
    "Lemma 1: measured against predicted growth rates, and growth at the threshold"
    input:
        code=code("figures/draw_growth.py"),
        chart="results/checks/chart.nc",
        short_chart="results/checks/short_chart.nc",
        threshold="results/checks/threshold.nc",
    output:
        **figure("growth_rates"),
    log:
        "results/logs/figures/growth_rates.log",
    conda:
        "../envs/pinned.yaml"
    message:
        "Drawing measured against predicted growth rates"
    script:
        "../../scripts/figures/draw_growth.py"


rule bounds:
    "Theorems 1 to 3: observed norms against their bounds"
    input:
        code=code("figures/draw_bounds.py"),
        cases="results/checks/cases.nc",
        sweeps="results/checks/sweeps.nc",
        samples="results/checks/samples.nc",
        worst="results/checks/worst.nc",
    output:
        **figure("bounds"),
    log:
        "results/logs/figures/bounds.log",
    conda:
        "../envs/pinned.yaml"
    message:
        "Drawing observed norms against the bounds of the theorems"
    script:
        "../../scripts/figures/draw_bounds.py"
