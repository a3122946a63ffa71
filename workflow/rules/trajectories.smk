# Cases into trajectories (the data of Figs 2-4).


rule compile_solver:
    "Compile a solver before the jobs that share it"
    input:
        code=code("trajectories/compile_solver.py"),
    output:
        kernels="results/kernels/{solver}.txt",
    log:
        "results/logs/kernels/{solver}.log",
    wildcard_constraints:
        solver="|".join(ALL_SOLVERS),
    conda:
        "../envs/pinned.yaml"
    params:
        solver=lambda wildcards: getattr(SETTINGS.solvers, wildcards.solver).model_dump(),
    message:
        "Compiling {wildcards.solver}"
    script:
        "../../scripts/trajectories/compile_solver.py"


rule trajectory:
    "results/trajectories/{case}.nc, and {case}.{solver}.nc by another solver"
    input:
        code=code("trajectories/simulate_case.py"),
        kernels=kernels_of_trajectory,
    output:
        trajectory="results/trajectories/{case}.nc",
    log:
        "results/logs/trajectories/{case}.log",
    wildcard_constraints:
        case="|".join(SETTINGS.cases),
    conda:
        "../envs/pinned.yaml"
    params:
        name="{case}",
        problem=trajectory_problem,
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
