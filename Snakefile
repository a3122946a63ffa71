# The figures of Destyl, Nuiro, Pelinovsky and Poullet (2017), each from netCDF datasets.
# `snakemake` makes everything, `snakemake fig5` one figure, `snakemake --list` says what there is.


configfile: f"{workflow.basedir}/config/config.yaml"


include: "workflow/rules/common.smk"


FIGURES = [
    # Fig 1: the chain of coupled pendula pairs
    "fig1",
    # Figs 2, 3 and 4: norms against time at Omega = 8, -4 and 0; beside each, where the chain moves
    *("fig2", "fig2_spacetime"),
    *("fig3", "fig3_spacetime"),
    *("fig4", "fig4_spacetime"),
    # Figs 5 and 6: maximal norms against the half-width of the chain
    *("fig5", "fig6"),
    # The paper's second solver, and its claim that the energy is conserved
    *("solver_agreement", "energy_drift"),
]


rule all:
    "Everything: datasets, figures and tables"
    input:
        expand("results/trajectories/{case}.nc", case=SETTINGS.cases),
        trajectories_by_all_solvers(),
        expand("results/sweeps/{sweep}.nc", sweep=SETTINGS.sweeps),
        expand("results/sweeps/{sweep}.{solver}.nc", sweep=PAPER_SWEEPS, solver="crank_nicolson"),
        expand("results/figures/{name}.{kind}", name=FIGURES, kind=["png", "pdf", "nc"]),
        "results/tables/solvers.md",


rule figures:
    "All figures"
    input:
        expand("results/figures/{name}.{kind}", name=FIGURES, kind=["png", "pdf", "nc"]),


include: "workflow/rules/trajectories.smk"
include: "workflow/rules/sweeps.smk"
include: "workflow/rules/figures.smk"
include: "workflow/rules/solvers.smk"
include: "workflow/rules/benchmarks.smk"
