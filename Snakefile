# The figures of Destyl, Nuiro, Pelinovsky and Poullet (2017), each from netCDF datasets.
# `snakemake` makes everything, `snakemake fig5` one figure, `snakemake --list` says what there is.


configfile: f"{workflow.basedir}/config/config.yaml"


include: "workflow/rules/common.smk"
include: "workflow/rules/base.smk"


CHAOS_FIGURES = [
    # How fast small errors grow, how evenness is lost, and what runs from almost equal data share
    *("lyapunov", "symmetry", "ensembles"),
    # How long a large amplitude keeps the central pendulum to itself
    "lifetimes",
]
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
    # How long the trajectories are the true ones, known in multiprecision
    "trust_horizons",
    # Lemma 1: where the chain at rest is unstable, and how fast it leaves
    *("stability_chart", "growth_rates"),
    # Theorems 1 to 3: observed norms against their bounds
    "bounds",
    *CHAOS_FIGURES,
    # What stays at one pair, which data reach it, and which spread
    *("breathers", "sensitivity", "fates"),
    # Newton's equations (1) beside the amplitude equations: Lemma 1 for the pendula, the expansion
    *("pendula_threshold", "pendula_remainder"),
    # The paper's phases in the real pendula; the sea, and who leaves it over the top
    *("pendula_phases", "pendula_over_the_top"),
    # How far computed curves can be from the true ones, as proved
    "certified_curves",
    # The paper's conjecture, on chains without ends: growth in time, the front, maxima over (M, T)
    *("growth_law", "front", "window_map"),
]


rule all:
    "Everything: datasets, figures, tables and the report (the target of `snakemake` alone)"
    input:
        expand("results/trajectories/{case}.nc", case=SETTINGS.cases),
        expand("results/trajectories/{case}.{solver}.nc", case=PAPER_CASES, solver=ALL_SOLVERS),
        expand("results/sweeps/{sweep}.nc", sweep=SETTINGS.sweeps),
        expand("results/sweeps/{sweep}.{solver}.nc", sweep=PAPER_SWEEPS, solver="crank_nicolson"),
        expand("results/figures/{name}.{kind}", name=FIGURES, kind=FIGURE_KINDS.values()),
        expand("results/checks/{name}.nc", name=[*CHECKS, *SOLVER_CHECKS, *CHAOS_CHECKS]),
        expand("results/certified/{case}.nc", case=SETTINGS.certified.curves.cases),
        "results/certified/lines.nc",
        expand("results/certified/{name}.nc", name=["breathers", "constants"]),
        "results/claims.json",
        "results/controls.json",
        "results/tables/solvers.md",
        "results/tables/claims.md",
        "results/tables/trust.md",
        "results/tables/hard_cases.md",
        "results/report.html",
    message:
        "All datasets, figures, tables and the report are there"


rule paper:
    "Figs 1 to 6 of the paper, and a table of the claims on them: results/tables/claims_figures.md"
    input:
        expand("results/figures/fig{n}.{kind}", n=range(1, 7), kind=FIGURE_KINDS.values()),
        "results/tables/claims_figures.md",
    message:
        "The paper's figures and the table of the claims on them are there"


rule figures:
    "All figures, each as PNG and PDF with the data that it shows"
    input:
        expand("results/figures/{name}.{kind}", name=FIGURES, kind=FIGURE_KINDS.values()),
    message:
        "All figures are there"


rule theory:
    "The checks of the paper's theory, the ledger of its claims, and their figures"
    input:
        expand("results/checks/{name}.nc", name=CHECKS),
        expand("results/figures/{name}.png", name=["stability_chart", "growth_rates", "bounds"]),
        "results/claims.json",
        "results/controls.json",
    message:
        "The checks of the theory and its figures are there"


rule chaos:
    "How fast small errors grow, how evenness is lost, and ensembles of the chaotic cases"
    input:
        expand("results/checks/{name}.nc", name=CHAOS_CHECKS),
        expand("results/figures/{name}.{kind}", name=CHAOS_FIGURES, kind=FIGURE_KINDS.values()),
    message:
        "What is measured of chaos, and its figures, are there"


include: "workflow/rules/inputs.smk"
include: "workflow/rules/trajectories.smk"
include: "workflow/rules/sweeps.smk"
include: "workflow/rules/own.smk"
include: "workflow/rules/paper.smk"
include: "workflow/rules/reference.smk"
include: "workflow/rules/unbounded.smk"
include: "workflow/rules/theory.smk"
include: "workflow/rules/hard_cases.smk"
include: "workflow/rules/chaos.smk"
include: "workflow/rules/breathers.smk"
include: "workflow/rules/pendula.smk"
include: "workflow/rules/certified.smk"
include: "workflow/rules/ledger.smk"
include: "benchmarks/benchmarks.smk"
include: "workflow/rules/baseline.smk"
include: "workflow/rules/figure_diff.smk"
include: "workflow/rules/report.smk"
include: "workflow/rules/archive.smk"
include: "workflow/rules/names.smk"


if workflow.is_main_process:
    misspelt = faults_of_targets(asked(), workflow.rules, [*OWN_CASES, *OWN_SWEEPS])
    if misspelt:
        stop("\n".join(misspelt))


# In place of Snakemake's own list, which has no groups and shows what cannot be called too
workflow.list_rules = lambda only_targets: print(list_targets(workflow.rules))


onstart:
    run_of_jobs = Run(
        expected(workflow.dag.needrun_jobs(), not workflow.overwrite_configfiles),
        workflow.cores if workflow.local_exec else None,
    )
    logger.info(what_it_takes(run_of_jobs))
    if SCREEN:
        SCREEN.begin(run_of_jobs)
    if workflow.local_exec:
        put_in_order(workflow.dag)
        begin_at_once(workflow.scheduler)
    warm.use(IMPORTED, workflow, RESULTS / "logs/imports.log")


# Said when Snakemake has ended, below its own last lines
onsuccess:
    if "figure_diff" in {job.rule.name for job in workflow.dag.jobs}:
        tell_faults()
    else:
        atexit.register(print, where_to_look(workflow.dag.targetjobs), file=sys.stderr)


onerror:
    atexit.register(print, what_failed(workflow.scheduler.failed), file=sys.stderr)
