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
        solver=one_of(ALL_SOLVERS),
    conda:
        "../envs/pinned.yaml"
    params:
        solver="{solver}",
    message:
        "Compiling {wildcards.solver}"
    script:
        "../../scripts/trajectories/compile_solver.py"


rule trajectory:
    "A case of the paper by its own solver: results/trajectories/{case}.nc"
    input:
        code=code("trajectories/simulate_case.py"),
        kernels=lambda wildcards: own_kernels(wildcards.case),
    output:
        datasets=["results/trajectories/{case}.nc"],
    log:
        "results/logs/trajectories/{case}.log",
    wildcard_constraints:
        case=one_of(PAPER_CASES),
    conda:
        "../envs/pinned.yaml"
    params:
        name="{case}",
        problems=lambda wildcards: [SETTINGS.shown_problem(wildcards.case)],
    message:
        "Integrating {wildcards.case} by its own solver"
    script:
        "../../scripts/trajectories/simulate_case.py"


# Apart from the rule above, since the paper's figures show none of these.
use rule trajectory as trajectory_by_solvers with:
    "A case of the paper by every solver: results/trajectories/{case}.{solver}.nc of each"
    input:
        code=code("trajectories/simulate_case.py"),
        kernels=kernels(*ALL_SOLVERS),
    output:
        datasets=by_solvers("results/trajectories/{case}", ALL_SOLVERS),
    log:
        "results/logs/trajectories/{case}.solvers.log",
    params:
        name="{case}",
        problems=lambda wildcards: [
            SETTINGS.problem(wildcards.case, solver) for solver in ALL_SOLVERS
        ],
    message:
        "Integrating {wildcards.case} by every solver"


use rule trajectory as own_trajectory with:
    "A case of your own, by its own solver: results/trajectories/{case}.nc"
    input:
        code=code("trajectories/simulate_case.py"),
        kernels=lambda wildcards: own_kernels(wildcards.case),
    output:
        datasets=["results/trajectories/{case}.nc"],
    wildcard_constraints:
        case=one_of(OWN_CASES),
    params:
        name="{case}",
        problems=lambda wildcards: [SETTINGS.shown_problem(wildcards.case)],
    message:
        "Integrating {wildcards.case} by its own solver"


use rule own_trajectory as own_trajectory_by_solver with:
    "A case of your own by another solver: results/trajectories/{case}.{solver}.nc"
    input:
        code=code("trajectories/simulate_case.py"),
        kernels=lambda wildcards: own_kernels(wildcards.case, wildcards.solver),
    output:
        datasets=["results/trajectories/{case}.{solver}.nc"],
    log:
        "results/logs/trajectories/{case}.{solver}.log",
    wildcard_constraints:
        case=one_of(OWN_CASES),
        solver=one_of([*ALL_SOLVERS, "auto", "kahan_li"]),
    params:
        name="{case}",
        problems=lambda wildcards: [SETTINGS.shown_problem(wildcards.case, wildcards.solver)],
    message:
        "Integrating {wildcards.case} by {wildcards.solver}"
