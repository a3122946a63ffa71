# The paper's Figs 1 to 6, the chain in motion beside them, and its solvers side by side.
# Every figure is written as PNG and PDF, with the data that it shows as netCDF.


use rule figure as fig1 with:
    "Fig 1: the chain of coupled pendula pairs"
    pathvars:
        made="figures/fig1",
    params:
        call=function("pendula.studies.paper.chain_figure.draw"),


use rule figure as norms_in_time with:
    "Figs 2 to 4: norms against time for small and large amplitudes, and where the chain moves"
    input:
        runs=expand("<results>/trajectories/fig{{n}}_{size}.nc", size=["small", "large"]),
        ensembles=lambda wildcards: ensembles_of(*SHOWN[wildcards.n]),
    output:
        figure_files("<results>/figures/fig{n,[234]}"),
        figure_files("<results>/figures/fig{n,[234]}_spacetime"),
    pathvars:
        made="figures/fig{n,[234]}",
    params:
        call=function(
            "pendula.studies.paper.figures.draw_norms",
            "pendula.studies.paper.figures.draw_spacetime",
        ),
        committed=lambda wildcards: committed(references=references(*SHOWN[wildcards.n])),


use rule figure as norms_by_half_width with:
    "Figs 5 and 6: norms against half-width"
    input:
        left="<results>/sweeps/fig{n}_left.nc",
        right="<results>/sweeps/fig{n}_right.nc",
        ensembles=lambda wildcards: ensembles_of(*SHOWN[wildcards.n]),
    pathvars:
        made="figures/fig{n,[56]}",
    params:
        call=function("pendula.studies.paper.figures.draw_sweeps"),
        given=lambda wildcards: drawn_windows(f"fig{wildcards.n}_left"),
        norms=lambda wildcards: {"5": ["l2", "linf"], "6": ["l2"]}[wildcards.n],


use rule dataset as measure_solvers with:
    "How well each solver conserves the energy, and until when pairs of them agree"
    input:
        trajectories=runs_by(*COMPARED),
        first=SWEEPS,
        second=SECOND_SWEEPS,
    pathvars:
        made="checks/solvers",
    params:
        call=function("pendula.studies.paper.solvers.compare_solvers"),
        others=[case for case in PAPER_CASES if reason(DIFFERS, [f"trajectories/{case}.ode45"])],


use rule dataset as measure_second_solver with:
    "What depends on the scheme and the step of the second solver, which the paper hardly describes"
    input:
        kernels=kernels("crank_nicolson", "delfour_fortin_payre"),
        firsts=runs_by("ode45"),
    pathvars:
        made="checks/second_solver",
    priority: 1  # with all that it needs, because the report waits longest for it
    params:
        call=function("pendula.studies.paper.second_solver.measure"),
        problems={case: SETTINGS.problem(case, "crank_nicolson") for case in PAPER_CASES},
        swept_problem=SETTINGS.swept_problem("fig6_right", "crank_nicolson"),
        half_widths=SETTINGS.chaos.ensembles.sweeps["fig6_right"].half_widths,
        windows=SETTINGS.sweeps["fig6_right"].windows,
        ensemble=values_of(SETTINGS.chaos.ensembles, "size", "seed"),


use rule figure as solver_figures with:
    "The two figures energy_drift and solver_agreement: the solvers compared"
    input:
        solvers="<results>/checks/solvers.nc",
    output:
        figure_files("<results>/figures/energy_drift"),
        figure_files("<results>/figures/solver_agreement"),
    pathvars:
        made="figures/solvers",
    params:
        call=function(
            "pendula.studies.paper.figures.draw_drift",
            "pendula.studies.paper.figures.draw_agreement",
        ),


use rule dataset as measure_trust with:
    "When the norms of each solver leave those of the reference, and until when curves are proved"
    input:
        trajectories=runs_by(*ALL_SOLVERS),
        proved=PROVED_CURVES,
    pathvars:
        made="checks/trust",
    params:
        call=function("pendula.studies.paper.solvers.trust_solvers"),
        committed=committed(
            references=references(*PAPER_CASES),
            decimal=references("fig4_small", "fig4_small.double"),
            proofs=committed_proofs(),
        ),


use rule figure as trust_horizons with:
    "How long each solver stays with the true trajectory, that is with the reference"
    input:
        trust="<results>/checks/trust.nc",
    pathvars:
        made="figures/trust_horizons",
    params:
        call=function("pendula.studies.paper.figures.draw_trust"),


use rule job as solver_table with:
    "All that is measured of the solvers as tables to read: solvers.md, trust.md"
    input:
        solvers="<results>/checks/solvers.nc",
        trust="<results>/checks/trust.nc",
    output:
        table="<results>/tables/solvers.md",
        trust_table="<results>/tables/trust.md",
    pathvars:
        made="tables/solvers",
    params:
        call=function("pendula.studies.paper.tables.tabulate_solvers"),
