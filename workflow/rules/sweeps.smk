# Cases repeated over half-widths (the data of Figs 5 and 6).


rule sweep:
    "results/sweeps/{sweep}.nc, and {sweep}.{solver}.nc by another solver"
    input:
        code=code("sweeps/sweep_case.py"),
        kernels=kernels_of_sweep,
    output:
        statistics="results/sweeps/{sweep}.nc",
    log:
        "results/logs/sweeps/{sweep}.log",
    wildcard_constraints:
        sweep="|".join(SETTINGS.sweeps),
    priority: 10
    conda:
        "../envs/pinned.yaml"
    params:
        name="{sweep}",
        problem=sweep_problem,
        half_widths=lambda wildcards: SETTINGS.sweeps[wildcards.sweep].half_widths,
        windows=lambda wildcards: SETTINGS.sweeps[wildcards.sweep].windows,
    message:
        "Sweeping {wildcards.sweep} over half-widths by its own solver"
    script:
        "../../scripts/sweeps/sweep_case.py"


use rule sweep as sweep_by_solver with:
    output:
        statistics="results/sweeps/{sweep}.{solver}.nc",
    log:
        "results/logs/sweeps/{sweep}.{solver}.log",
    wildcard_constraints:
        sweep="|".join(SETTINGS.sweeps),
        solver="|".join(ALL_SOLVERS),
    message:
        "Sweeping {wildcards.sweep} over half-widths by {wildcards.solver}"
