# Cases into trajectories (the data of Figs 2-4), and cases repeated over half-widths (Figs 5 and 6).


use rule job as compile_solver with:
    "Compile a solver before the jobs that share it"
    output:
        kernels="<results>/<made>.txt",
    pathvars:
        made=f"kernels/{{solver,{one_of(COMPILED)}}}",
    priority: 1
    params:
        call=function("pendula.studies.paper.compile_solver.compile_solver"),
        solver="{solver}",


use rule dataset as trajectory with:
    "A case by its own solver: results/trajectories/{case}.nc"
    input:
        kernels=lambda wildcards: kernels_of(SETTINGS.problem(wildcards.case)),
    pathvars:
        made="trajectories/<any_case>",
    resources:
        **asked(lambda wildcards: SETTINGS.cost_of(wildcards.case)),
    params:
        call=function("pendula.studies.paper.runs.run_case"),
        name="{case}",
        problem=lambda wildcards: SETTINGS.shown_problem(wildcards.case),


use rule trajectory as trajectory_by_solver with:
    "A case by another solver than its own: results/trajectories/{case}.{solver}.nc"
    input:
        kernels=lambda wildcards: kernels_of(SETTINGS.problem(wildcards.case), wildcards.solver),
    pathvars:
        made="trajectories/<any_case>.<any_solver>",
    resources:
        **asked(lambda wildcards: SETTINGS.cost_of(*wildcards)),
    params:
        problem=lambda wildcards: SETTINGS.shown_problem(wildcards.case, wildcards.solver),


use rule dataset as sweep with:
    "A sweep by its own solver: results/sweeps/{sweep}.nc"
    input:
        kernels=lambda wildcards: kernels_of(SETTINGS.swept_problem(wildcards.sweep)),
        chunks=parts_of("sweeps/{sweep}"),
    pathvars:
        made="sweeps/<any_sweep>",
    resources:
        **asked(lambda wildcards: SETTINGS.cost_of_sweep(wildcards.sweep)),
    params:
        call=function("pendula.studies.paper.runs.run_sweep"),
        name="{sweep}",
        problem=lambda wildcards: SETTINGS.swept_problem(wildcards.sweep),
        half_widths=lambda wildcards: SETTINGS.sweeps[wildcards.sweep].half_widths,
        windows=lambda wildcards: SETTINGS.sweeps[wildcards.sweep].windows,


# Apart from the rule above, since the paper's figures show none of these, which take longer.
use rule sweep as sweep_by_second_solver with:
    "A sweep of the paper by its second solver: results/sweeps/{sweep}.crank_nicolson.nc"
    input:
        kernels=kernels("crank_nicolson"),
        chunks=parts_of("sweeps/{sweep}.crank_nicolson{step}"),
    pathvars:
        made="sweeps/<paper_sweep>.crank_nicolson{step,(_coarse)?}",
    params:
        problem=lambda wildcards: by_second_solver(wildcards.sweep, wildcards.step),
        half_widths=lambda wildcards: half_widths_of(wildcards.sweep),
