# Cases into trajectories (the data of Figs 2-4).


rule compile_solver:
    input:
        code=code("trajectories/compile_solver.py"),
    output:
        kernels="results/kernels/{solver}.txt",
    params:
        solver=lambda wildcards: getattr(SETTINGS.solvers, wildcards.solver).model_dump(),
    log:
        "results/logs/kernels/{solver}.log",
    conda:
        "../envs/pinned.yaml"
    wildcard_constraints:
        solver="|".join(ALL_SOLVERS),
    message:
        "Compiling {wildcards.solver}"
    script:
        "../../scripts/trajectories/compile_solver.py"


rule trajectory:
    input:
        code=code("trajectories/simulate_case.py"),
        kernels=ancient(kernels_of_trajectory),
    output:
        trajectory="results/trajectories/{case}.nc",
    params:
        name="{case}",
        problem=trajectory_problem,
    log:
        "results/logs/trajectories/{case}.log",
    conda:
        "../envs/pinned.yaml"
    wildcard_constraints:
        case="|".join(SETTINGS.cases),
    message:
        "Integrating {wildcards.case} by its own solver"
    script:
        "../../scripts/trajectories/simulate_case.py"


use rule trajectory as trajectory_by_solver with:
    output:
        trajectory="results/trajectories/{case}.{solver}.nc",
    log:
        "results/logs/trajectories/{case}.{solver}.log",
    wildcard_constraints:
        case="|".join(SETTINGS.cases),
        solver="|".join(ALL_SOLVERS),
    message:
        "Integrating {wildcards.case} by {wildcards.solver}"
