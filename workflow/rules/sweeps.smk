# Cases repeated over half-widths (the data of Figs 5 and 6).


rule sweep:
    "A sweep of the paper by its own solver: results/sweeps/{sweep}.nc"
    input:
        code=code("sweeps/sweep_case.py"),
        kernels=lambda wildcards: kernels(own_sweep_solver(wildcards)),
    output:
        datasets=["results/sweeps/{sweep}.nc"],
    log:
        "results/logs/sweeps/{sweep}.log",
    wildcard_constraints:
        sweep=one_of(PAPER_SWEEPS),
    conda:
        "../envs/pinned.yaml"
    params:
        name="{sweep}",
        problems=lambda wildcards: [SETTINGS.swept_problem(wildcards.sweep)],
        half_widths=lambda wildcards: SETTINGS.sweeps[wildcards.sweep].half_widths,
        windows=lambda wildcards: SETTINGS.sweeps[wildcards.sweep].windows,
    message:
        "Sweeping {wildcards.sweep} over half-widths by its own solver"
    script:
        "../../scripts/sweeps/sweep_case.py"


# Apart from the rule above, since the paper's figures show none of these, which take longer.
use rule sweep as sweep_by_second_solver with:
    "A sweep of the paper by its second solver: results/sweeps/{sweep}.crank_nicolson.nc"
    input:
        code=code("sweeps/sweep_case.py"),
        kernels=kernels("crank_nicolson"),
    output:
        datasets=by_solvers("results/sweeps/{sweep}", ["crank_nicolson"]),
    log:
        "results/logs/sweeps/{sweep}.crank_nicolson.log",
    params:
        name="{sweep}",
        problems=lambda wildcards: [SETTINGS.swept_problem(wildcards.sweep, "crank_nicolson")],
        half_widths=lambda wildcards: SETTINGS.sweeps[wildcards.sweep].half_widths,
        windows=lambda wildcards: SETTINGS.sweeps[wildcards.sweep].windows,
    message:
        "Sweeping {wildcards.sweep} over half-widths by the second solver of the paper"


use rule sweep as own_sweep with:
    "A sweep of your own, by its own solver: results/sweeps/{sweep}.nc"
    input:
        code=code("sweeps/sweep_case.py"),
        kernels=lambda wildcards: own_kernels(
            SETTINGS.sweeps[wildcards.sweep].case, own_sweep_solver(wildcards)
        ),
    output:
        datasets=["results/sweeps/{sweep}.nc"],
    wildcard_constraints:
        sweep=one_of(OWN_SWEEPS),
    params:
        name="{sweep}",
        problems=lambda wildcards: [SETTINGS.swept_problem(wildcards.sweep)],
        half_widths=lambda wildcards: SETTINGS.sweeps[wildcards.sweep].half_widths,
        windows=lambda wildcards: SETTINGS.sweeps[wildcards.sweep].windows,
    message:
        "Sweeping {wildcards.sweep} over half-widths by its own solver"
