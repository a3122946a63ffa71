# The paper's cases and sweeps, its Figs 1 to 6, where the chain moves, and a comparison of the solvers.


use rule job as compile_solver with:
    "Compiles a solver before the jobs that share it"
    output:
        kernels="<results>/<made>.txt",
    pathvars:
        made=f"kernels/{{solver,{any_of(COMPILED)}}}",
    priority: 1
    params:
        call=function("pendula.studies.paper.compile_solver.compile_solver"),
        solver="{solver}",


use rule dataset as trajectory with:
    "A case by its own solver: results/trajectories/{case}.nc"
    input:
        lambda wildcards: kernels_for(SETTINGS.problem(wildcards.case)),
    pathvars:
        made="trajectories/<any_case>",
    resources:
        **resources_for(lambda wildcards: SETTINGS.cost_of(wildcards.case)),
    params:
        call=function("pendula.studies.paper.runs.run_case"),
        name="{case}",
        problem=lambda wildcards: SETTINGS.shown_problem(wildcards.case),


use rule trajectory as trajectory_by_solver with:
    "A case by another solver than its own: results/trajectories/{case}.{solver}.nc"
    input:
        lambda wildcards: kernels_for(SETTINGS.problem(wildcards.case), wildcards.solver),
    pathvars:
        made="trajectories/<any_case>.<any_solver>",
    resources:
        **resources_for(lambda wildcards: SETTINGS.cost_of(*wildcards)),
    params:
        problem=lambda wildcards: SETTINGS.shown_problem(wildcards.case, wildcards.solver),


use rule dataset as sweep with:
    "A sweep by its own solver: results/sweeps/{sweep}.nc"
    input:
        lambda wildcards: kernels_for(SETTINGS.swept_problem(wildcards.sweep)),
        chunks=chunks_of("sweeps/{sweep}"),
    pathvars:
        made="sweeps/<any_sweep><chunk>",
    resources:
        **resources_for(lambda wildcards: SETTINGS.cost_of_sweep(wildcards.sweep)),
    params:
        call=function("pendula.studies.paper.runs.run_sweep"),
        name="{sweep}",
        problem=lambda wildcards: SETTINGS.swept_problem(wildcards.sweep),
        half_widths=lambda wildcards: SETTINGS.sweeps[wildcards.sweep].half_widths,
        windows=lambda wildcards: SETTINGS.sweeps[wildcards.sweep].windows,


# A separate rule: no figure of the paper shows these sweeps, and they take longer.
use rule sweep as sweep_by_second_solver with:
    "A sweep of the paper by its second solver: results/sweeps/{sweep}.crank_nicolson.nc"
    input:
        kernels("crank_nicolson"),
        chunks=chunks_of("sweeps/{sweep}.crank_nicolson"),
    pathvars:
        made="sweeps/<paper_sweep>.crank_nicolson<chunk>",
    params:
        problem=lambda wildcards: SETTINGS.swept_problem(wildcards.sweep, "crank_nicolson"),


use rule figure as fig1 with:
    "Fig 1: the chain of coupled pendula pairs"
    pathvars:
        made="figures/fig1",
    params:
        call=function("pendula.studies.paper.chain_figure.draw_chain"),


use rule figure as norms_in_time with:
    "Figs 2 to 4: norms against time for small and large amplitudes"
    input:
        runs=expand("<results>/trajectories/fig{{n}}_{size}.nc", size=["small", "large"]),
        # Fig 2 shows no ensembles, because its motion is regular
        ensembles=lambda wildcards: [] if wildcards.n == "2" else checks("members")[0],
    pathvars:
        made="figures/fig{n,[234]}",
    params:
        call=function("pendula.studies.paper.figures.draw_norms"),
        references=lambda wildcards: references(
            f"fig{wildcards.n}_small", f"fig{wildcards.n}_large"
        ),


use rule figure as spacetime with:
    "Where the chain moves in the cases of Figs 2 to 4"
    input:
        runs=expand("<results>/trajectories/fig{{n}}_{size}.nc", size=["small", "large"]),
        norms="<results>/figures/fig{n}.nc",
    pathvars:
        made="figures/fig{n,[234]}_spacetime",
    params:
        call=function("pendula.studies.paper.figures.draw_spacetime"),


use rule figure as norms_by_half_width with:
    "Figs 5 and 6: norms against half-width"
    input:
        left="<results>/sweeps/fig{n}_left.nc",
        right="<results>/sweeps/fig{n}_right.nc",
        ensembles=checks("ensembles")[0],
    pathvars:
        made="figures/fig{n,[56]}",
    params:
        call=function("pendula.studies.paper.figures.draw_sweeps"),
        text_window=lambda wildcards: SETTINGS.drawn_windows(f"fig{wildcards.n}_left")[
            "text_window"
        ],
        caption_window=lambda wildcards: SETTINGS.drawn_windows(f"fig{wildcards.n}_left")[
            "caption_window"
        ],
        norms=lambda wildcards: {"5": ["l2", "linf"], "6": ["l2"]}[wildcards.n],


use rule dataset as measure_solvers with:
    "How well each solver conserves the energy, how the paper's solvers differ, and how long each is accurate"
    input:
        kernels(*(name for name in COMPILED if name != "dop853")),
    output:
        dataset_outputs(*checks("solvers", "trust")),
    pathvars:
        made="checks/solvers",
    priority: 1  # as high as that of its inputs, because the ledger waits for it
    params:
        call=function("pendula.studies.paper.solvers.measure_solvers"),
        cases={case: without_solver(SETTINGS.problem(case)) for case in PAPER_CASES},
        solvers={
            name: getattr(SETTINGS.solvers, name).model_dump()
            for name in ALL_SOLVERS
            if name != "dop853"
        },
        user_cases=[case for case in PAPER_CASES if reason(DIFFERS, [f"trajectories/{case}.ode45"])],
        references=references(*PAPER_CASES),
        proofs=[committed(f"tests/baseline/proofs/{case}.nc") for case in PAPER_CASES],


use rule figure as energy_drift with:
    "How well each solver conserves the energy"
    input:
        solvers="<results>/checks/solvers.nc",
    pathvars:
        made="figures/energy_drift",
    params:
        call=function("pendula.studies.paper.figures.draw_drift"),


use rule figure as trust_horizons with:
    "How long each solver follows the reference, which is the true trajectory"
    input:
        trust="<results>/checks/trust.nc",
    pathvars:
        made="figures/trust_horizons",
    params:
        call=function("pendula.studies.paper.figures.draw_trust"),
